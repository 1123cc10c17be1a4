#pragma once

#include <Eigen/Core>

namespace twindeck::buffeting {

/// Quantile of Student's t: the value below which a share of the distribution lies.
/// @param degrees  of freedom, >= 1  @param share  in ]0.5, 1[
/// Reference: Abramowitz and Stegun (1964), 26.7.3 and 26.7.4 (finite sums for whole degrees of freedom), inverted by
/// bisection.
[[nodiscard]] double student_quantile(int degrees, double share);

/// Mean of replicates with its confidence interval, mean ± t s / sqrt(n).
struct Interval {
  double mean = 0.0, low = 0.0, high = 0.0;
  double deviation = 0.0;  ///< s: of one replicate
};
/// @param level  e.g. 0.95 @throws InputError for fewer than two replicates
[[nodiscard]] Interval confidence_interval(const Eigen::Ref<const Eigen::VectorXd>& replicates, double level);

}  // namespace twindeck::buffeting
