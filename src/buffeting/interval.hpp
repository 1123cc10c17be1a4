#pragma once

#include <Eigen/Core>

namespace twindeck::buffeting {

/// Mean of replicates with its confidence interval, mean ± t s / sqrt(n).
struct Interval {
  double mean = 0.0, low = 0.0, high = 0.0;
  double deviation = 0.0;  ///< s: of one replicate
};
/// @param level  e.g. 0.95 @throws InputError for fewer than two replicates
[[nodiscard]] Interval confidence_interval(const Eigen::Ref<const Eigen::VectorXd>& replicates, double level);

}  // namespace twindeck::buffeting
