#pragma once

#include <map>
#include <string>
#include <vector>

#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/reduced_model.hpp"
#include "dynamics/unit_slips.hpp"

namespace twindeck::steps {

/// Measured frequencies of each condition, for the checks of units.
/// @param reduced  the computed modes that shapes are compared with; null where they are not
/// @param bound    positions of computed modes that the configuration gives to measured ones, by the mode's name in rows.csv
[[nodiscard]] std::vector<dynamics::MeasuredFrequencies> frequencies_of(const diagnosis::FeatureSet& features,
                                                                        const diagnosis::ReducedModel* reduced = nullptr,
                                                                        const std::map<std::string, int>& bound = {});

}  // namespace twindeck::steps
