#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

/// Limit states with known probabilities, in standard normal space.
namespace twindeck::reliability::published {

/// R - S with R of (7, 1) and S of (2, 1), both normal: beta 5/sqrt(2).
inline double resistance_less_load(const Eigen::VectorXd& u) { return 5.0 + u[0] - u[1]; }

/// Series system of four branches, k = 7: 2.2228e-3 (Waarts 2000; Schueremans and Van Gemert 2005).
inline double four_branches(const Eigen::VectorXd& u) {
  const double bend = 3.0 + 0.1 * (u[0] - u[1]) * (u[0] - u[1]), sum = (u[0] + u[1]) / std::numbers::sqrt2;
  const double end = 7.0 / std::numbers::sqrt2;
  return std::min({bend - sum, bend + sum, u[0] - u[1] + end, u[1] - u[0] + end});
}

/// Problems 22, 25 and 31 of the reliability benchmark (Rozsas and Slobbe 2019): 4.2073e-3, 4.1486e-5, 3.2267e-3.
inline double rp22(const Eigen::VectorXd& u) {
  return 2.5 - (u[0] + u[1]) / std::numbers::sqrt2 + 0.1 * (u[0] - u[1]) * (u[0] - u[1]);
}
inline double rp25(const Eigen::VectorXd& u) { return std::max(u[0] * u[0] - 8.0 * u[1] + 16.0, -16.0 * u[0] + u[1] + 32.0); }
inline double rp31(const Eigen::VectorXd& u) { return 2.0 - u[1] + 256.0 * std::pow(u[0], 4); }

/// Linear limit state at a distance beta from the origin in any dimension: Phi(-beta).
inline std::function<double(const Eigen::VectorXd&)> linear(double beta) {
  return [beta](const Eigen::VectorXd& u) { return beta - u.sum() / std::sqrt(static_cast<double>(u.size())); };
}

/// Two regions of which the slope of g at the origin hides the more probable one: Phi(-4) + Phi(-5), 3.2e-5 (Breitung 2019).
inline double hidden_region(const Eigen::VectorXd& u) {
  const double first = u[0] > 3.5 ? 4.0 - u[0] : 0.85 - 0.1 * u[0], second = u[1] > 2.0 ? 0.5 - 0.1 * u[1] : 2.3 - u[1];
  return std::min(first, second);
}

}  // namespace twindeck::reliability::published
