#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "matching/comparison.hpp"
#include "updating/weighing.hpp"

/// What a weighed update found, in words: agreement, parameters with their deviations, and what cannot be told apart.
namespace twindeck::updating {

/// A measured row beside what the updated model computes for it.
struct WeighedRow {
  Eigen::Index at = 0;                           ///< position among all rows
  std::size_t target = 0;                        ///< position of its pair
  std::string type;                              ///< frequency_Hz, shape, shape_imag
  std::string channel;                           ///< of a shape, else empty
  double value = 0.0, std = 0.0, updated = 0.0;  ///< [Hz] or [-]
  [[nodiscard]] double difference_std() const { return (updated - value) / std; }
};
[[nodiscard]] std::vector<WeighedRow> weighed_row_list(const Weighed& weighed);

/// Agreement, deviations, parameters that the rows cannot tell apart, directions that they hardly limit and other optima that
/// they cannot rule out, as lines and warnings.
void say_weighing(Reporter& reporter, const Weighed& weighed, const Posterior& posterior);

/// Covariance of the parameters of an update by Eq. (5), whose rows weigh alike: the frequencies count by the standard
/// deviations that are stated for them, what the bounds hold is that of the update.
/// @return nothing where a paired frequency has no standard deviation
[[nodiscard]] std::optional<Posterior> posterior_of_frequencies(const Weighed& weighed);

/// Directions that relative frequencies hardly limit, counted in the frequencies' standard deviations, as lines: an update by
/// Eq. (5) does not show by itself that their values are uncertain.
/// @param posterior  of `posterior_of_frequencies`
void say_flat_frequencies(Reporter& reporter, const Weighed& weighed, const Posterior& posterior);

/// Sentences on what the data do not determine at the published end (UpdatingResult::flat): one for each parameter without any
/// effect, and one for all parameters that have no effect together.
[[nodiscard]] std::vector<std::string> undetermined_sentences(const Weighed& weighed);

/// Warns of undetermined parameters, with any weights.
void warn_of_undetermined(Reporter& reporter, const Weighed& weighed);

/// Parameters that the paired frequencies cannot tell apart at the model's initial values, in sets as those of
/// indistinct_sets. An example is the two halves of a symmetric structure. Exact derivatives (sensitivity::frequency_jacobian),
/// in the scaling of step 5's selection.
/// @param active  positions of the updated parameters
/// @return names, each set in the order of the model; empty where all can be told apart
[[nodiscard]] std::vector<std::vector<std::string>> indistinct_parameters(const dynamics::LoadedModel& loaded,
                                                                          const dynamics::EigenModes& modes,
                                                                          const std::vector<int>& active,
                                                                          const matching::Measured& measured,
                                                                          const matching::Pairing& pairing);

/// Names of sets of positions among the updated parameters.
[[nodiscard]] std::vector<std::vector<std::string>> named_sets(const dynamics::LoadedModel& loaded,
                                                               const std::vector<int>& active,
                                                               const std::vector<std::vector<int>>& sets);

/// Warns of each set that frequencies cannot tell apart. @param has_shapes  whether shapes were measured, which may help
void warn_of_twins(Reporter& reporter, const std::vector<std::vector<std::string>>& sets, bool has_shapes);

}  // namespace twindeck::updating
