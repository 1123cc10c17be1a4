#include "updating/problem.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "updating/bounded_quadratic.hpp"

namespace twindeck::updating {
namespace {

constexpr double rounding_of_cost = 1e-10;  // relative; computed frequencies differ by 1e-12 from one processor to another
constexpr double ridge = 1e-8;              // on the linearised problem's normal matrix, as Ceres' own smallest damping

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Point {
  Eigen::VectorXd x, residual;
  Eigen::MatrixXd jacobian;
  bool valid = false;
  [[nodiscard]] double cost() const { return 0.5 * residual.squaredNorm(); }
  [[nodiscard]] Eigen::VectorXd gradient() const { return jacobian.transpose() * residual; }
};

Point evaluate(const ResidualFunction& function, int n_residuals, const Eigen::VectorXd& x) {
  Point point{x, Eigen::VectorXd(n_residuals), {}, false};
  point.valid = function(x, point.residual, &point.jacobian);
  return point;
}

class Residuals : public ceres::CostFunction {
 public:
  Residuals(const ResidualFunction& function, int n_residuals, int n) : function_(function) {
    set_num_residuals(n_residuals);
    mutable_parameter_block_sizes()->push_back(n);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Index n = parameter_block_sizes()[0];
    const bool wants_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(parameters[0], n);
    Eigen::VectorXd residual(num_residuals());
    Eigen::MatrixXd jacobian;
    if (!function_(x, residual, wants_jacobian ? &jacobian : nullptr)) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = residual;
    if (!wants_jacobian) return true;
    Eigen::Map<RowMajor>(jacobians[0], num_residuals(), n) = jacobian;
    last_x_ = x;
    last_gradient_ = jacobian.transpose() * residual;
    return true;
  }

  // Gradient of the cost. Ceres asks for the Jacobian at each accepted step, so the gradient there is known.
  [[nodiscard]] Eigen::VectorXd gradient(const Eigen::VectorXd& x) const {
    if (last_x_.size() == x.size() && last_x_ == x) return last_gradient_;
    return evaluate(function_, num_residuals(), x).gradient();
  }

 private:
  const ResidualFunction& function_;
  mutable Eigen::VectorXd last_x_, last_gradient_;
};

// Whether a step was refused although the linearised problem expected a change below the rounding of the cost.
bool is_lost_in_rounding(const ceres::IterationSummary& step) {
  if (!step.step_is_valid || step.relative_decrease == 0.0) return false;
  return std::abs(step.cost_change / step.relative_decrease) <= rounding_of_cost * step.cost;
}

struct Round {
  const Box& box;
  const BoundedOptions& options;
  const std::vector<bool>& is_held;
  int used;  // iterations of earlier rounds
  const std::function<void(const AcceptedStep&)>& accepted;
};

// Reports accepted steps. Ends the round if a component meets a new bound, if rounding refuses a step, or if the projected
// gradient of the free components is below its tolerance. Ceres' own gradient test is off: it uses the length of x - P(x - g),
// which never exceeds the distance to the bounds, however steep the cost is.
class RoundWatcher : public ceres::IterationCallback {
 public:
  RoundWatcher(const Eigen::VectorXd& x, const Residuals& residuals, const Round& round)
      : x_(x), residuals_(residuals), round_(round), side_(on_bound(x, round.box, round.options.bound_tolerance)) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    tried = summary.iteration;
    if (summary.iteration > 0 && !summary.step_is_successful)
      return is_lost_in_rounding(summary) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    const Eigen::VectorXd projected =
        projected_gradient(x_, residuals_.gradient(x_), round_.box, round_.options.bound_tolerance);
    if (summary.iteration > 0) {
      ++accepted_steps;
      if (round_.accepted)
        round_.accepted({round_.used + summary.iteration, summary.cost, projected.norm(), summary.step_norm,
                         summary.trust_region_radius, x_});
    }
    return meets_a_bound() || is_flat(projected) ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  int tried = 0, accepted_steps = 0;

 private:
  [[nodiscard]] bool meets_a_bound() const {
    const std::vector<int> side = on_bound(x_, round_.box, round_.options.bound_tolerance);
    for (std::size_t i = 0; i < side.size(); ++i)
      if (side[i] != 0 && side[i] != side_[i]) return true;
    return false;
  }
  [[nodiscard]] bool is_flat(const Eigen::VectorXd& projected) const {
    const double most = round_.options.gradient_tolerance / std::sqrt(static_cast<double>(projected.size()));
    for (Eigen::Index i = 0; i < projected.size(); ++i)
      if (!round_.is_held[static_cast<std::size_t>(i)] && std::abs(projected(i)) > most) return false;
    return true;
  }

  const Eigen::VectorXd& x_;
  const Residuals& residuals_;
  const Round& round_;
  std::vector<int> side_;
};

ceres::Solver::Options solver_options(const BoundedOptions& options, int iterations_left) {
  ceres::Solver::Options solver;
  solver.trust_region_strategy_type = ceres::DOGLEG;
  solver.dogleg_type = ceres::TRADITIONAL_DOGLEG;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.initial_trust_region_radius = options.trust_radius;
  solver.max_trust_region_radius = std::max(1e3, options.trust_radius);
  // Ceres measures the region in units of the Jacobian's column norms; equal limits make it the sphere of the paper.
  solver.min_lm_diagonal = solver.max_lm_diagonal = 1.0;
  solver.jacobi_scaling = false;
  solver.max_num_iterations = iterations_left;
  solver.gradient_tolerance = 0.0;  // RoundWatcher judges
  solver.function_tolerance = 0.0;
  solver.parameter_tolerance = 1e-10;
  solver.max_num_consecutive_invalid_steps = 20;
  solver.max_num_line_search_step_size_iterations = 6;
  solver.num_threads = 1;
  solver.update_state_every_iteration = true;
  solver.logging_type = ceres::SILENT;
  return solver;
}

// One Ceres solve with the held components constant; `x` moves. Returns accepted and tried steps.
std::pair<int, int> run_round(const ResidualFunction& function, int n_residuals, Eigen::VectorXd& x, const Round& round) {
  const auto n = static_cast<int>(x.size());
  ceres::Problem problem;
  problem.AddParameterBlock(x.data(), n);
  std::vector<int> constant;
  for (int i = 0; i < n; ++i) {
    problem.SetParameterLowerBound(x.data(), i, round.box.lower(i));
    problem.SetParameterUpperBound(x.data(), i, round.box.upper(i));
    if (round.is_held[static_cast<std::size_t>(i)]) constant.push_back(i);
  }
  if (!constant.empty()) problem.SetManifold(x.data(), new ceres::SubsetManifold(n, constant));
  auto* residuals = new Residuals(function, n_residuals, n);
  problem.AddResidualBlock(residuals, nullptr, x.data());  // which owns them
  RoundWatcher watcher(x, *residuals, round);
  ceres::Solver::Options solver = solver_options(round.options, round.options.max_iterations - round.used);
  solver.callbacks.push_back(&watcher);
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return {watcher.accepted_steps, std::max(watcher.tried, 1)};
}

// Components that stay on a bound during the next round: those on a bound that the linearised problem also leaves there. The
// sign of the gradient alone would release too many. A component with a small inward gradient may stay in place in the bounded
// Gauss-Newton step. If it is free, it spoils each projected dogleg step and the trust region collapses.
std::vector<bool> stay_on_bound(const Point& point, const Box& box, double tolerance) {
  const std::vector<int> now = on_bound(point.x, box, tolerance);
  const Eigen::VectorXd step = bounded_gauss_newton_step(point.residual, point.jacobian, point.x, box, ridge);
  const std::vector<int> then = on_bound(point.x + step, box, tolerance);
  std::vector<bool> stays(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) stays[i] = now[i] != 0 && then[i] == now[i];
  return stays;
}

void snap_to_bounds(Eigen::VectorXd& x, const std::vector<bool>& is_held, const Box& box) {
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (!is_held[static_cast<std::size_t>(i)]) continue;
    x(i) = x(i) - box.lower(i) < box.upper(i) - x(i) ? box.lower(i) : box.upper(i);
  }
}

// The next point if the bounded Gauss-Newton step would gain less than the rounding of the cost, where a trust region would
// collapse on noise. The step is accepted if it at least halves the projected gradient. Empty if the cost can still judge the
// step, or if the step does not help.
std::optional<Point> step_below_rounding(const ResidualFunction& function, const Point& from, double projected, const Box& box,
                                         double bound_tolerance) {
  const Eigen::VectorXd step = bounded_gauss_newton_step(from.residual, from.jacobian, from.x, box, ridge);
  const double gain = -(from.gradient().dot(step) + 0.5 * (from.jacobian * step).squaredNorm());
  if (gain > rounding_of_cost * from.cost()) return {};
  Point to =
      evaluate(function, static_cast<int>(from.residual.size()), (from.x + step).cwiseMax(box.lower).cwiseMin(box.upper));
  if (!to.valid || to.cost() > (1.0 + rounding_of_cost) * from.cost()) return {};
  if (projected_gradient(to.x, to.gradient(), box, bound_tolerance).norm() > 0.5 * projected) return {};
  return to;
}

BoundedResult run_rounds(const ResidualFunction& function, int n_residuals, const Eigen::VectorXd& start, const Box& box,
                         const BoundedOptions& options, const std::function<void(const AcceptedStep&)>& accepted) {
  BoundedResult result;
  result.x = start.cwiseMax(box.lower).cwiseMin(box.upper);
  bool predict = true;  // false after a round without progress: the sign of the gradient decides
  int last_accepted = 1;
  for (bool first = true;; first = false) {
    const Point point = evaluate(function, n_residuals, result.x);
    if (!point.valid) {
      result.message = "the residuals cannot be evaluated at the starting point";
      return result;
    }
    const Eigen::VectorXd gradient = point.gradient();
    result.cost = point.cost();
    result.projected_gradient = projected_gradient(result.x, gradient, box, options.bound_tolerance).norm();
    if (first && accepted) accepted({0, result.cost, result.projected_gradient, 0.0, options.trust_radius, result.x});
    if (result.projected_gradient <= options.gradient_tolerance) {
      result.converged = true;
      result.message = "projected gradient below its tolerance";
      return result;
    }
    if (const auto next = step_below_rounding(function, point, result.projected_gradient, box, options.bound_tolerance);
        next && result.iterations < options.max_iterations) {
      const double length = (next->x - result.x).norm();
      result.x = next->x;
      ++result.iterations;
      const double gradient_there = projected_gradient(next->x, next->gradient(), box, options.bound_tolerance).norm();
      if (accepted) accepted({result.iterations, next->cost(), gradient_there, length, options.trust_radius, next->x});
      continue;
    }
    if (last_accepted == 0 && !predict) {
      result.message = "no step lowers the cost although the projected gradient is above its tolerance";
      return result;
    }
    if (result.iterations >= options.max_iterations) {
      result.message = "iteration limit reached with the projected gradient above its tolerance";
      return result;
    }
    predict = last_accepted > 0;
    const std::vector<bool> is_held =
        predict ? stay_on_bound(point, box, options.bound_tolerance) : held(result.x, gradient, box, options.bound_tolerance);
    if (std::ranges::all_of(is_held, [](bool h) { return h; })) {
      last_accepted = 0;
      continue;
    }
    snap_to_bounds(result.x, is_held, box);
    const auto [steps, tried] =
        run_round(function, n_residuals, result.x, {box, options, is_held, result.iterations, accepted});
    last_accepted = steps;
    result.iterations += tried;
  }
}

}  // namespace

BoundedResult minimise_on_box(const ResidualFunction& function, int n_residuals, const Eigen::VectorXd& start, const Box& box,
                              const BoundedOptions& options, const std::function<void(const AcceptedStep&)>& accepted) {
  TWINDECK_ASSERT(start.size() == box.lower.size() && start.size() == box.upper.size());
  TWINDECK_ASSERT((box.lower.array() < box.upper.array()).all() && options.residual_unit > 0.0);
  const double unit = options.residual_unit, squared = unit * unit;
  const ResidualFunction in_units = [&](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    if (!function(x, residual, jacobian)) return false;
    residual /= unit;
    if (jacobian != nullptr) *jacobian /= unit;
    return true;
  };
  BoundedOptions options_in_units = options;
  options_in_units.gradient_tolerance /= squared;
  std::function<void(const AcceptedStep&)> tell;
  if (accepted) {
    tell = [&](AcceptedStep step) {
      step.cost *= squared;
      step.projected_gradient *= squared;
      accepted(step);
    };
  }
  BoundedResult result = run_rounds(in_units, n_residuals, start, box, options_in_units, tell);
  result.cost *= squared;
  result.projected_gradient *= squared;
  return result;
}

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
