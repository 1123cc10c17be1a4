#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "updating/weighing.hpp"

/// What a weighed update found, in words: agreement, parameters with their deviations, and what cannot be told apart.
namespace twindeck::updating {

/// A measured row beside what the updated model computes for it.
struct WeighedRow {
  Eigen::Index at = 0;                           ///< position among the rows
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
/// Eq. (5) gives their values as exactly as any other.
/// @param posterior  of `posterior_of_frequencies`
void say_flat_frequencies(Reporter& reporter, const Weighed& weighed, const Posterior& posterior);

}  // namespace twindeck::updating
