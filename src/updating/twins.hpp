#pragma once

#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "matching/comparison.hpp"

namespace twindeck::updating {

/// Parameters that the paired frequencies cannot tell apart at the model's initial values, in sets: what one of a set does to
/// the frequencies over half its allowed range, another does as well (or undoes) to within one standard deviation of all of
/// them together. The two halves of a symmetric structure are the plainest case. A parameter that moves the frequencies by less
/// than one deviation is in no set: it is not seen at all. Exact derivatives (sensitivity::frequency_jacobian), in the scaling
/// of step 5's selection.
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
