#include "updating/updating.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/lists.hpp"
#include "core/parallel.hpp"
#include "updating/leave_one_out.hpp"
#include "updating/multi_start.hpp"
#include "updating/residuals.hpp"
#include "updating/search.hpp"
#include "updating/valley_walk.hpp"

namespace twindeck::updating {
namespace {

void check_input(const fe::ParametricSystem& system, const std::vector<int>& active,
                 const std::vector<FrequencyTarget>& targets) {
  if (active.empty()) throw InputError({}, "no parameter to update", "name at least one parameter of the model");
  if (targets.empty()) throw InputError({}, "no frequency to update against", "give at least one pair of modes");
  for (const int p : active) {
    TWINDECK_ASSERT(p >= 0 && p < static_cast<int>(system.parameters.size()));
    const fe::Parameter& parameter = system.parameters[static_cast<std::size_t>(p)];
    if (!(std::isfinite(parameter.lower) && std::isfinite(parameter.upper) && parameter.lower < parameter.upper))
      throw InputError({"", 0, parameter.name},
                       fmt::format("has the bounds [{}, {}], expected a finite lower bound below the upper one",
                                   parameter.lower, parameter.upper),
                       "give it a range in the model, or leave it out of the update");
    if (parameter.initial < parameter.lower || parameter.initial > parameter.upper)
      throw InputError(
          {"", 0, parameter.name},
          fmt::format("starts at {}, outside its bounds [{}, {}]", parameter.initial, parameter.lower, parameter.upper),
          "move the initial value or the bounds");
  }
  for (const FrequencyTarget& target : targets) {
    if (!(target.measured_Hz > 0.0))
      throw InputError({"", 0, target.label}, fmt::format("is {} Hz, expected a frequency above 0", target.measured_Hz));
    if (target.reference_mode < 0 || target.reference_mode >= system.size())
      throw InputError({"", 0, target.label}, fmt::format("asks for mode {} of a model with {} degrees of freedom",
                                                          target.reference_mode + 1, system.size()));
  }
}

int highest_reference(const std::vector<FrequencyTarget>& targets) {
  int highest = 0;
  for (const FrequencyTarget& target : targets) highest = std::max(highest, target.reference_mode);
  return highest;
}

ResidualDefinition define_residuals(const fe::ParametricSystem& system, const std::vector<int>& active,
                                    const std::vector<FrequencyTarget>& targets, const UpdatingOptions& options) {
  ResidualDefinition definition;
  definition.targets = targets;
  definition.active = active;
  definition.initial = system.initial();
  definition.scale.resize(static_cast<Eigen::Index>(active.size()));
  for (std::size_t j = 0; j < active.size(); ++j) {
    const fe::Parameter& parameter = system.parameters[static_cast<std::size_t>(active[j])];
    const double size = std::abs(parameter.initial);
    definition.scale(static_cast<Eigen::Index>(j)) = size > 0.0 ? size : parameter.upper - parameter.lower;
  }
  definition.n_modes = std::min(std::max(options.n_modes, highest_reference(targets) + 1), static_cast<int>(system.size()));
  return definition;
}

// (n_active) normalised bounds or initial values.
Eigen::VectorXd normalised(const fe::ParametricSystem& system, const ResidualDefinition& definition,
                           double fe::Parameter::*member) {
  Eigen::VectorXd x(definition.scale.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const int p = definition.active[static_cast<std::size_t>(j)];
    x(j) = system.parameters[static_cast<std::size_t>(p)].*member / definition.scale(j);
  }
  return x;
}

std::vector<SearchEnd> run_starts(const Search& search, const Eigen::MatrixXd& points,
                                  const std::function<void(int, int)>& progress) {
  const auto starts = static_cast<int>(points.cols());
  std::vector<SearchEnd> ends(static_cast<std::size_t>(starts));
  parallel_for_told(
      starts, [&](int k) { ends[static_cast<std::size_t>(k)] = run_start(search, points.col(k), k); },
      [&](int done, int of) {
        if (progress) progress(done, of);
      });
  return ends;
}

int best_start(const std::vector<SearchEnd>& ends) {
  const auto better = [](const SearchEnd& a, const SearchEnd& b) {
    if (a.evaluation.valid != b.evaluation.valid) return a.evaluation.valid;
    if (a.result.converged != b.result.converged) return a.result.converged;
    return a.result.cost < b.result.cost;
  };
  return static_cast<int>(std::min_element(ends.begin(), ends.end(), better) - ends.begin());
}

// Chooses the start to publish and walks along its valley. @return the optimum of each start
std::vector<int> choose(const Search& search, std::vector<SearchEnd>& ends, const Eigen::VectorXd& x0, UpdatingResult& result) {
  const auto end_points = each_of(ends, &SearchEnd::end);
  const std::vector<int> optimum = distinct_optima(end_points, search.box, search.definition.negligible_residual());
  result.best = best_start(ends);
  if (!ends[static_cast<std::size_t>(result.best)].result.converged) return optimum;
  result.best = preferred_end(end_points, optimum, result.best, x0, search.box, sight_of(search));
  SearchEnd& best = ends[static_cast<std::size_t>(result.best)];
  best = walk_towards(search, best, x0, result.best);
  result.flat = directions_of_valley(search, best);
  return optimum;
}

void collect(const Search& search, std::vector<SearchEnd>& ends, const Eigen::VectorXd& x0, UpdatingResult& result) {
  const std::vector<int> optimum = choose(search, ends, x0, result);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    ends[k].result.optimum = optimum[k];
    if (optimum[k] == static_cast<int>(k)) result.optima.push_back(static_cast<int>(k));
    result.starts.push_back(ends[k].result);
    result.history.insert(result.history.end(), ends[k].history.begin(), ends[k].history.end());
  }
  const int published = optimum[static_cast<std::size_t>(result.best)];
  std::ranges::stable_sort(result.optima, [&](int a, int b) {
    if ((a == published) != (b == published)) return a == published;
    return ends[static_cast<std::size_t>(a)].result.cost < ends[static_cast<std::size_t>(b)].result.cost;
  });
  const SearchEnd& best = ends[static_cast<std::size_t>(result.best)];
  result.theta = search.definition.theta(best.end.x);
  result.on_bound = on_bound(best.end.x, search.box, search.options.bound_tolerance);
  result.frequency_after_Hz = best.evaluation.frequency_Hz;
  result.mode_after = best.evaluation.mode;
  result.followed_mac = best.evaluation.mac;
  result.at_optimum = best.evaluation;
  if (best.result.converged) result.smooth = check_by_smooth_map(search, best);
  if (!best.result.converged)
    result.status = {
        false, fmt::format("none of {} starts converged; the best (start {}) stopped with a relative projected gradient of "
                           "{:.1e}: {}",
                           ends.size(), result.best, best.result.relative_projected_gradient, best.result.message)};
}

// Sets residuals in standard deviations instead of relative frequencies, and records them at the start.
void weigh(Search& search, const MeasuredRows& rows, const Eigen::VectorXd& x0, UpdatingResult& result) {
  ResidualDefinition& definition = search.definition;
  Eigen::VectorXd measured_Hz(static_cast<Eigen::Index>(definition.targets.size()));
  std::vector<bool> fitted;
  for (const FrequencyTarget& target : definition.targets) {
    measured_Hz(static_cast<Eigen::Index>(fitted.size())) = target.measured_Hz;
    fitted.push_back(target.fitted);
  }
  definition.weighted =
      std::make_shared<const WeightedRows>(std::make_shared<const MeasuredRows>(rows), measured_Hz, std::move(fitted));
  const Evaluation start = evaluate_at_start(search, x0);
  if (!start.valid) return;
  result.cost_before = start.cost();
  result.at_start = start;
}

// Sets the prior of the ranges. For relative frequencies it estimates the model error from the residual at the start.
void hold_to_ranges(Search& search, const Eigen::VectorXd& x0, UpdatingResult& result) {
  Evaluation start;
  if (!search.definition.weighted) start = evaluate_at_start(search, x0);
  if (!search.definition.weighted && !start.valid) return;
  search.definition.prior = prior_of_ranges(search.box, x0, start.residual, start.jacobian);
  if (!search.definition.weighted) result.model_error = search.definition.prior.model_error;
}

}  // namespace

UpdatingResult update(const fe::ParametricSystem& start, const Refresh& refresh, const std::vector<int>& active,
                      const std::vector<FrequencyTarget>& targets, const UpdatingOptions& options,
                      const std::function<void(int done, int of)>& progress, const MeasuredRows& rows) {
  TWINDECK_ASSERT(options.starts >= 1 && options.outer_iterations >= 1 && options.max_iterations >= 1);
  check_input(start, active, targets);
  Search search{refresh, options, define_residuals(start, active, targets, options),
                std::make_shared<const fe::ParametricSystem>(start)};
  ResidualDefinition& definition = search.definition;
  search.box = {normalised(start, definition, &fe::Parameter::lower), normalised(start, definition, &fe::Parameter::upper)};
  const Eigen::VectorXd x0 = normalised(start, definition, &fe::Parameter::initial);

  // Modes of the start model; all later modes are followed from them.
  UpdatingResult result;
  result.scale = definition.scale;
  result.box = search.box;
  dynamics::ModalSolver solver(*search.initial_system);
  dynamics::EigenModes reference = solver.solve(definition.initial, definition.n_modes);
  const auto found = static_cast<int>(reference.frequency_Hz.size());
  if (!reference.status.converged && found > highest_reference(targets) && found < definition.n_modes) {
    definition.n_modes = found;  // a small structure has fewer modes than asked for; they include those of the targets
    reference = solver.solve(definition.initial, found);
  }
  if (!reference.status.converged) {
    result.theta = definition.initial;
    result.status = {false, "modes of the start model: " + reference.status.message};
    return result;
  }
  definition.follower = std::make_shared<const matching::ModeFollower>(solver.mass(), reference);
  definition.start = std::make_shared<const StartModes>(StartModes{search.initial_system, definition.initial, reference});
  result.frequency_before_Hz.resize(static_cast<Eigen::Index>(targets.size()));
  for (std::size_t i = 0; i < targets.size(); ++i)
    result.frequency_before_Hz(static_cast<Eigen::Index>(i)) = reference.frequency_Hz(targets[i].reference_mode);

  if (rows.given()) weigh(search, rows, x0, result);
  if (options.prior) hold_to_ranges(search, x0, result);

  const Eigen::MatrixXd points = starting_points(x0, search.box, options.starts, options.seed);
  if (start.size() >= options.surrogate_from_size) search.surrogate = make_surrogate(search, points);
  std::vector<SearchEnd> ends = run_starts(search, points, progress);
  collect(search, ends, x0, result);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double residual = result.frequency_before_Hz(static_cast<Eigen::Index>(i)) / targets[i].measured_Hz - 1.0;
    if (!rows.given()) result.cost_before += targets[i].fitted ? 0.5 * residual * residual : 0.0;
  }
  for (const Eigen::VectorXd& values : options.elsewhere) {
    const Evaluation there = evaluate_in_balance(search, values.cwiseQuotient(definition.scale));
    result.elsewhere.push_back({there.valid ? there.cost() : 0.0, there.frequency_Hz, there.valid});
  }
  const SearchEnd& best = ends[static_cast<std::size_t>(result.best)];
  if (options.leave_one_out && best.result.converged) result.left_out = leave_each_out(search, x0);
  if (options.regularised && !options.prior)
    result.regularised = regularised_where_worse(result, start, refresh, active, targets, options, rows);
  return result;
}

}  // namespace twindeck::updating
