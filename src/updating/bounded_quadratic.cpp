#include "updating/bounded_quadratic.hpp"

#include <Eigen/Cholesky>
#include <vector>

#include "core/error.hpp"

namespace twindeck::updating {
namespace {

// The first bound met on the way from s to s + fraction · direction.
struct Stop {
  double fraction = 1.0;
  Eigen::Index component = -1;  // -1: none is met
  int side = 0;
};

Stop first_bound(const Eigen::VectorXd& s, const Eigen::VectorXd& direction, const Eigen::VectorXd& lower,
                 const Eigen::VectorXd& upper) {
  Stop stop;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    if (direction(i) == 0.0) continue;
    const int side = direction(i) < 0.0 ? -1 : 1;
    const double fraction = ((side < 0 ? lower(i) : upper(i)) - s(i)) / direction(i);
    if (fraction < stop.fraction) stop = {std::max(fraction, 0.0), i, side};
  }
  return stop;
}

// Held component whose multiplier has the wrong sign by the largest amount; -1 if all signs are right, then s is the solution.
Eigen::Index wrongly_held(const Eigen::VectorXd& gradient, const std::vector<int>& side, double tolerance) {
  Eigen::Index worst = -1;
  double most = tolerance;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const double inward = side[static_cast<std::size_t>(i)] * gradient(i);
    if (inward > most) most = inward, worst = i;
  }
  return worst;
}

}  // namespace

Eigen::VectorXd bounded_gauss_newton_step(const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                                          const Eigen::VectorXd& x, const Box& box, double ridge) {
  TWINDECK_ASSERT(ridge > 0.0);
  const Eigen::Index n = x.size();
  const Eigen::VectorXd lower = box.lower - x, upper = box.upper - x, slope = jacobian.transpose() * residual;
  Eigen::MatrixXd hessian = jacobian.transpose() * jacobian;
  hessian.diagonal().array() += ridge;
  const double tolerance = 1e-14 * (slope.norm() + hessian.norm());
  Eigen::VectorXd s = Eigen::VectorXd::Zero(n);
  std::vector<int> side(static_cast<std::size_t>(n), 0);  // -1, +1: held on that bound
  // Each pass holds one more component or releases one. Between releases the cost falls strictly.
  for (Eigen::Index pass = 0; pass < 20 * (n + 1); ++pass) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < n; ++i)
      if (side[static_cast<std::size_t>(i)] == 0) free.push_back(i);
    const Eigen::VectorXd gradient = slope + hessian * s;
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(n);
    if (!free.empty()) {
      const Eigen::MatrixXd free_hessian = hessian(free, free);
      direction(free) = -free_hessian.llt().solve(Eigen::VectorXd(gradient(free)));
    }
    const Stop stop = first_bound(s, direction, lower, upper);
    s += stop.fraction * direction;
    if (stop.component >= 0) {
      side[static_cast<std::size_t>(stop.component)] = stop.side;
      s(stop.component) = stop.side < 0 ? lower(stop.component) : upper(stop.component);
      continue;
    }
    const Eigen::Index released = wrongly_held(slope + hessian * s, side, tolerance);
    if (released < 0) break;
    side[static_cast<std::size_t>(released)] = 0;
  }
  return s;
}

}  // namespace twindeck::updating
