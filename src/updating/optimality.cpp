#include "updating/optimality.hpp"

#include <algorithm>

namespace twindeck::updating {

std::vector<int> on_bound(const Eigen::VectorXd& x, const Box& box, double tolerance) {
  std::vector<int> side(static_cast<std::size_t>(x.size()), 0);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double reach = tolerance * (box.upper(i) - box.lower(i));
    if (x(i) <= box.lower(i) + reach)
      side[static_cast<std::size_t>(i)] = -1;
    else if (x(i) >= box.upper(i) - reach)
      side[static_cast<std::size_t>(i)] = 1;
  }
  return side;
}

std::vector<bool> held(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Box& box, double tolerance) {
  const std::vector<int> side = on_bound(x, box, tolerance);
  std::vector<bool> is_held(side.size(), false);
  for (std::size_t i = 0; i < side.size(); ++i)
    is_held[i] = static_cast<double>(side[i]) * gradient(static_cast<Eigen::Index>(i)) < 0.0;
  return is_held;
}

Eigen::VectorXd projected_gradient(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Box& box,
                                   double tolerance) {
  const std::vector<bool> is_held = held(x, gradient, box, tolerance);
  Eigen::VectorXd projected = gradient;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (is_held[static_cast<std::size_t>(i)]) projected(i) = 0.0;
  return projected;
}

double gradient_reference(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& jacobian, double negligible) {
  return std::max(gradient.norm(), negligible * jacobian.norm());
}

}  // namespace twindeck::updating
