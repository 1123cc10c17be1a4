#include "updating/smooth_bounds.hpp"

namespace twindeck::updating {

BoundedResult minimise_by_smooth_map(const ResidualFunction& function, int n_residuals, const Eigen::VectorXd& start,
                                     const Box& box, const BoundedOptions& options) {
  constexpr double inside = 1e-3, beyond = 1e6;
  const Eigen::ArrayXd middle = 0.5 * (box.lower + box.upper).array(), half = 0.5 * (box.upper - box.lower).array();
  const auto x_of = [&](const Eigen::VectorXd& u) { return Eigen::VectorXd(middle + half * u.array().sin()); };
  const ResidualFunction without_bounds = [&](const Eigen::VectorXd& u, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    if (!function(x_of(u), residual, jacobian)) return false;
    if (jacobian != nullptr) *jacobian *= (half * u.array().cos()).matrix().asDiagonal();
    return true;
  };
  const double most = 1.0 - 2.0 * inside;
  const Eigen::VectorXd u0 = ((start.array() - middle) / half).max(-most).min(most).asin();
  const Box everywhere{Eigen::VectorXd::Constant(u0.size(), -beyond), Eigen::VectorXd::Constant(u0.size(), beyond)};
  BoundedResult result = minimise_on_box(without_bounds, n_residuals, u0, everywhere, options, {});
  result.x = x_of(result.x);
  Eigen::VectorXd residual(n_residuals);
  Eigen::MatrixXd jacobian;
  if (function(result.x, residual, &jacobian))
    result.projected_gradient =
        projected_gradient(result.x, jacobian.transpose() * residual, box, options.bound_tolerance).norm();
  return result;
}

}  // namespace twindeck::updating
