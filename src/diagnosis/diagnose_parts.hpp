#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"

/// Private to src/diagnosis: what a diagnosis says beside its verdict, however the verdict was reached.
namespace twindeck::diagnosis {

/// The measurement that would tell the first two members of a set apart: the node where their mode shapes differ most, or
/// another condition. Empty for a set of one.
[[nodiscard]] std::string splitting_measurement(const Inference& inference, const Fit& base,
                                                const std::vector<const Scored*>& members);

/// Where the model is pulled: scores of every fine-scale parameter and of the screened entries' places.
[[nodiscard]] std::vector<LocationScore> location_map(const Inference& inference, const Fit& fit,
                                                      const std::vector<Scored>& ranking);

/// The members of a cluster beside its first, with what the search that found them knows of their magnitudes.
/// @param probability  (n_members)
/// @param misfit       chi² per degree of freedom that the best account leaves, at least 1: it widens intervals (Birge 1932)
[[nodiscard]] std::vector<Rival> rivals_of(const std::vector<const Scored*>& members, const std::vector<double>& probability,
                                           double misfit);

/// The hypothesis' sentence with its numbers.
[[nodiscard]] std::string sentence_of(const Effect& effect);

}  // namespace twindeck::diagnosis
