#include "updating/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "updating/optimality.hpp"
#include "updating/problem.hpp"

namespace twindeck::updating {

namespace {

using SharedSystem = std::shared_ptr<const fe::ParametricSystem>;

ResidualFunction as_function(ModalResiduals& residuals) {
  return [&residuals](const Eigen::VectorXd& x, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    const Evaluation& evaluation = residuals.at(x, jacobian != nullptr);
    if (!evaluation.valid) return false;
    residual = evaluation.residual;
    if (jacobian != nullptr) *jacobian = evaluation.jacobian;
    return true;
  };
}

SharedSystem refreshed(const Search& search, const Eigen::VectorXd& x) {
  if (const auto& start = search.definition.start; start && search.definition.theta(x) == start->theta) return start->system;
  return std::make_shared<const fe::ParametricSystem>(search.refresh(search.definition.theta(x)));
}

// Options of a search that begins with `jacobian` and measures its gradient relative to `reference`.
BoundedOptions bounded_options(const Search& search, double reference, const Eigen::MatrixXd& jacobian) {
  return {search.options.trust_radius, search.options.max_iterations, search.options.optimality_tolerance * reference,
          search.options.bound_tolerance, search.definition.residual_unit(jacobian)};
}

void search_full(const Search& search, Eigen::VectorXd x, SharedSystem system, double reference, int start, SearchEnd& out) {
  const int n_residuals = search.definition.n_residuals();
  StartResult& result = out.result;
  const int before = result.outer;
  for (int outer = 0;; ++outer) {
    result.outer = before + outer + 1;
    ModalResiduals residuals(system, search.definition);
    const Evaluation& begin = residuals.at(x, true);
    if (outer == 0 && reference == 0.0 && begin.valid)
      reference = gradient_reference(begin.gradient(), begin.jacobian, search.definition.negligible_residual());
    const BoundedOptions options = bounded_options(search, reference, begin.jacobian);
    const BoundedResult inner =
        minimise_on_box(as_function(residuals), n_residuals, x, search.box, options, [&](const AcceptedStep& step) {
          out.history.push_back(
              {start, before + outer, step.iteration, step.cost, step.projected_gradient, step.step, step.radius, step.x});
        });
    const double change = (inner.x - x).cwiseAbs().maxCoeff();
    x = inner.x;
    result.iterations += inner.iterations;
    result.solves += residuals.solves();
    result.cost = inner.cost;
    result.projected_gradient = inner.projected_gradient;
    result.relative_projected_gradient = reference > 0.0 ? inner.projected_gradient / reference : 0.0;
    result.message = inner.message;
    const bool settled = !search.refresh || (outer > 0 && change < search.options.outer_tolerance);
    if (settled || !inner.converged || outer + 1 >= search.options.outer_iterations) {
      result.converged = inner.converged && settled;
      if (inner.converged && !result.converged)
        result.message = fmt::format("parameters still change by {:.1e} after {} prestress states", change, outer + 1);
      const bool evaluable = residuals.at(x, true).valid;
      out.evaluation = residuals.at(x, evaluable);
      break;
    }
    system = refreshed(search, x);
  }
  result.theta = x.cwiseProduct(search.definition.scale);
  out.end = {x, result.cost, result.converged, out.evaluation.jacobian, out.evaluation.residual};
}

// Box of half width `reach` about x inside the search's.
Box box_about(const Eigen::VectorXd& x, const Box& box, double reach) {
  return {box.lower.cwiseMax((x.array() - reach).matrix()), box.upper.cwiseMin((x.array() + reach).matrix())};
}

// The optimum of the reduced system inside a box, corrected to agree with the full system at `full`. The prestress is computed
// anew once, at a first optimum, so that it hardly changes at the second. A full solution costs several times a new prestress.
// Empty if the reduced system lacks a mode.
std::optional<Eigen::VectorXd> reduced_optimum(const Search& search, const SharedSystem& system, const Evaluation& full,
                                               const Box& box, const BoundedOptions& options) {
  const int n_residuals = search.definition.n_residuals();
  const ReducedSystem reduced(system, search.surrogate.basis, search.surrogate.initial.get());
  const CorrectedResiduals corrected(reduced, search.definition, search.surrogate, full);
  if (!corrected.valid()) return {};
  const Eigen::VectorXd first = minimise_on_box(corrected, n_residuals, full.x, box, options, {}).x;
  if (!search.refresh || first == full.x) return first;
  const ReducedSystem followed(refreshed(search, first), search.surrogate.basis, search.surrogate.initial.get());
  return minimise_on_box(corrected.of(followed), n_residuals, first, box, options, {}).x;
}

// Search on the corrected reduced system. Leaves x at the best point so far. @return whether it has converged there
bool search_reduced(const Search& search, Eigen::VectorXd& x, double& reference, int start, SearchEnd& out) {
  StartResult& result = out.result;
  Eigen::VectorXd next = x;
  double cost = std::numeric_limits<double>::infinity(), reach = std::numeric_limits<double>::infinity();
  for (int outer = 0; outer < 3 * search.options.outer_iterations; ++outer) {
    // 1. The full system at the new point, with the prestress of that point.
    const SharedSystem system = search.refresh ? refreshed(search, next) : search.initial_system;
    ModalResiduals residuals(system, search.definition);
    const Evaluation& full = residuals.at(next, true);
    result.solves += residuals.solves();
    result.outer = outer + 1;
    // The prestress changes with the parameters, so that the cost may rise slightly near the end.
    const bool better = full.valid && full.cost() <= cost * (1.0 + 1e-3) + 1e-12;
    if (!better) {
      if (outer == 0) return false;
      reach = 0.25 * std::min(reach, (next - x).cwiseAbs().maxCoeff());
      if (reach < 1e-8) return false;
      next = box_about(x, search.box, reach).lower.cwiseMax(next).cwiseMin(box_about(x, search.box, reach).upper);
      continue;
    }
    const double step = (next - x).norm();
    x = next;
    reach *= 2.0;
    cost = full.cost();
    out.evaluation = full;
    if (reference == 0.0)
      reference = gradient_reference(full.gradient(), full.jacobian, search.definition.negligible_residual());
    result.cost = cost;
    result.projected_gradient = projected_gradient(x, full.gradient(), search.box, search.options.bound_tolerance).norm();
    result.relative_projected_gradient = result.projected_gradient / reference;
    result.iterations = outer;
    out.history.push_back({start, outer, 0, cost, result.projected_gradient, step, search.options.trust_radius, x});
    if (result.relative_projected_gradient <= search.options.optimality_tolerance) {
      result.converged = true;
      result.message = "projected gradient below its tolerance";
      return true;
    }
    // 2. The next point from the reduced system, corrected to agree with the full one here.
    const Box box = std::isfinite(reach) ? box_about(x, search.box, reach) : search.box;
    const auto optimum = reduced_optimum(search, system, full, box, bounded_options(search, 0.1 * reference, full.jacobian));
    if (!optimum || *optimum == x) return false;
    next = *optimum;
  }
  return false;
}

}  // namespace

Surrogate make_surrogate(const Search& search, const Eigen::MatrixXd& points) {
  Surrogate out;
  out.basis = modal_basis(search.initial_system, search.definition, points);
  if (!out.basis) return out;
  out.initial = std::make_shared<const ReducedSystem>(search.initial_system, out.basis, nullptr);
  out.mass_reference = out.basis->transpose() * search.definition.follower->mass_reference();
  out.mass = out.initial->mass(search.definition.initial);
  if (const auto& weighted = search.definition.weighted; weighted && weighted->has_shapes())
    out.channels = out.basis->transpose() * weighted->measured().channels;
  return out;
}

SearchEnd run_start(const Search& search, const Eigen::VectorXd& first, int start) {
  SearchEnd out;
  out.result.initial = first.cwiseProduct(search.definition.scale);
  Eigen::VectorXd x = first.cwiseMax(search.box.lower).cwiseMin(search.box.upper);
  double reference = 0.0;
  SharedSystem system = search.initial_system;
  if (search.surrogate.basis) {
    if (search_reduced(search, x, reference, start, out)) {
      out.result.theta = x.cwiseProduct(search.definition.scale);
      out.end = {x, out.result.cost, true, out.evaluation.jacobian, out.evaluation.residual};
      return out;
    }
    if (search.refresh && reference > 0.0) system = refreshed(search, x);
  }
  search_full(search, x, system, reference, start, out);
  return out;
}

Evaluation evaluate_in_balance(const Search& search, const Eigen::VectorXd& x) {
  const SharedSystem system = search.refresh ? refreshed(search, x) : search.initial_system;
  ModalResiduals residuals(system, search.definition);
  return residuals.at(x, false);
}

Evaluation evaluate_at_start(const Search& search, const Eigen::VectorXd& x) {
  ModalResiduals residuals(search.initial_system, search.definition);
  return residuals.at(x, true);
}

SmoothCheck check_by_smooth_map(const Search& search, const SearchEnd& ended) {
  const int n_residuals = search.definition.n_residuals();
  const SharedSystem system = search.refresh ? refreshed(search, ended.end.x) : search.initial_system;
  ModalResiduals residuals(system, search.definition);
  const Evaluation full = residuals.at(ended.end.x, true);
  SmoothCheck check;
  if (!full.valid) return check;
  const Eigen::VectorXd first = ended.result.initial.cwiseQuotient(search.definition.scale);
  BoundedOptions options = bounded_options(
      search, gradient_reference(full.gradient(), full.jacobian, search.definition.negligible_residual()), full.jacobian);
  options.max_iterations *= 3;
  BoundedResult found;
  if (search.surrogate.basis) {
    const ReducedSystem reduced(system, search.surrogate.basis, search.surrogate.initial.get());
    const CorrectedResiduals corrected(reduced, search.definition, search.surrogate, full);
    if (!corrected.valid()) return check;
    found = minimise_by_smooth_map(corrected, n_residuals, first, search.box, options);
  } else {
    found = minimise_by_smooth_map(as_function(residuals), n_residuals, first, search.box, options);
  }
  check.theta = found.x.cwiseProduct(search.definition.scale);
  check.cost = found.cost;
  check.iterations = found.iterations;
  check.largest_difference = ((found.x - ended.end.x).array().abs() / (search.box.upper - search.box.lower).array()).maxCoeff();
  return check;
}

}  // namespace twindeck::updating
