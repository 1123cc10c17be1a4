#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// Largest log odds and residual statistic of `count` null data sets drawn from the prior (x ~ N(0, I) inside its bounds,
/// errors from Sigma_id). @param progress may be empty @param bound as of FeatureMap::bind_modes
struct NullCalibration {
  std::vector<double> log_odds, chi_squared;
};
[[nodiscard]] NullCalibration run_null_calibration(const ReducedModel& model, const FeatureSet& features,
                                                   const ScatterOptions& scatter, const std::vector<Hypothesis>& catalogue,
                                                   const SearchOptions& search, int count, std::uint64_t seed,
                                                   const std::function<void(int)>& progress,
                                                   const std::map<std::string, int>& bound = {});

}  // namespace twindeck::diagnosis
