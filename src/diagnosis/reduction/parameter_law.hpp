#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "fe/parametric_system.hpp"

namespace twindeck::diagnosis {

/// Adds the parameters that a coefficient goes with to a set.
void add_parameters_of(const fe::Coefficient& coefficient, std::set<int>& parameters);

/// How the matrix K of a place goes with the parameters of the model:
///   K(theta) = ratio(theta) K + sum_s (ratio_s(theta) - held_s ratio(theta)) K_s,
/// where K is the matrix as the model stands. Parts are what goes with another ratio than the rest: a place whose elements all
/// go with one parameter, or with none, has no parts.
template <typename Matrix>
struct ParameterLaw {
  struct Part {
    fe::Coefficient ratio;
    double held = 1.0;  ///< times of K_s that K holds: 0 of a correction term that starts at zero
    Matrix matrix;
  };
  fe::Coefficient ratio;  ///< 1 as the model stands
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

/// A coefficient over its value as the model stands. @pre that value is not zero @param theta  of the model as it stands
[[nodiscard]] fe::Coefficient ratio_of(const fe::Coefficient& coefficient, const Eigen::VectorXd& theta);
/// Whether two ratios are the same function of the parameters.
[[nodiscard]] bool same_ratio(const fe::Coefficient& a, const fe::Coefficient& b);

}  // namespace twindeck::diagnosis
