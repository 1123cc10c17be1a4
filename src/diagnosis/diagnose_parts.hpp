#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"

/// Private to src/diagnosis: what a diagnosis says beside its verdict, however the verdict was reached.
namespace twindeck::diagnosis {

/// The members of a cluster beside its first, with what the search that found them knows of their magnitudes.
/// @param probability  (n_members)
/// @param misfit       chi² per degree of freedom that the best account leaves, at least 1: it widens intervals (Birge 1932)
[[nodiscard]] std::vector<Rival> rivals_of(const std::vector<const Scored*>& members, const std::vector<double>& probability,
                                           double misfit);

/// Parameters of the model that a fit puts on one of their bounds, by name.
[[nodiscard]] std::vector<std::string> parameters_on_bounds(const FeatureMap& map, const Fit& fit);

/// The hypothesis' sentence with its numbers.
[[nodiscard]] std::string sentence_of(const Effect& effect);

}  // namespace twindeck::diagnosis
