#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "fe/parametric_system.hpp"

namespace twindeck::diagnosis {

/// Adds the parameters of a coefficient to a set.
void add_parameters_of(const fe::Coefficient& coefficient, std::set<int>& parameters);

/// Dependence of a location's matrix K on the parameters of the model:
///   K(theta) = ratio(theta) K + sum_s (ratio_s(theta) - held_s ratio(theta)) K_s,
/// where K is the matrix of the unchanged model. `parts` are the terms K_s whose ratio differs from that of the rest. A
/// location whose elements all depend on one parameter, or on none, has no parts.
template <typename Matrix>
struct ParameterLaw {
  struct Part {
    fe::Coefficient ratio;
    double held = 1.0;  ///< factor of K_s within K: 0 for a correction term that starts at zero
    Matrix matrix;
  };
  fe::Coefficient ratio;  ///< 1 for the unchanged model
  std::vector<Part> parts;

  /// K(theta) as a sum: use(amount, matrix).
  template <typename Use>
  void each(const Matrix& whole, const Eigen::VectorXd& theta, Use use) const {
    const double common = ratio.value(theta);
    use(common, whole);
    for (const Part& part : parts) use(part.ratio.value(theta) - part.held * common, part.matrix);
  }
  /// dK/dtheta likewise: use(parameter, amount, matrix).
  template <typename Use>
  void each_slope(const Matrix& whole, const Eigen::VectorXd& theta, Use use) const {
    std::set<int> parameters;
    add_parameters_of(ratio, parameters);
    for (const Part& part : parts) add_parameters_of(part.ratio, parameters);
    for (const int p : parameters) {
      const double common = ratio.derivative(theta, p);
      if (common != 0.0) use(p, common, whole);
      for (const Part& part : parts)
        if (const double slope = part.ratio.derivative(theta, p) - part.held * common; slope != 0.0) use(p, slope, part.matrix);
    }
  }
};

/// A coefficient divided by its value in the unchanged model. @pre that value is not zero @param theta  of the unchanged model
[[nodiscard]] fe::Coefficient ratio_of(const fe::Coefficient& coefficient, const Eigen::VectorXd& theta);
/// Whether two ratios are the same function of the parameters.
[[nodiscard]] bool same_ratio(const fe::Coefficient& a, const fe::Coefficient& b);
/// Position of a ratio in a list; a new one is appended.
[[nodiscard]] std::size_t position_of(const fe::Coefficient& ratio, std::vector<fe::Coefficient>& ratios);

}  // namespace twindeck::diagnosis
