#include "updating/leave_one_out.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace twindeck::updating {
namespace {

Search without(const Search& search, std::size_t target) {
  Search left = search;
  left.definition.targets[target].fitted = false;
  if (left.definition.weighted) left.definition.weighted = left.definition.weighted->without(target);
  if (left.definition.prior.given()) left.definition.prior = left.definition.prior.without(static_cast<Eigen::Index>(target));
  return left;
}

LeftOut predicted(const Search& search, std::size_t target, const SearchEnd& end) {
  const auto at = static_cast<Eigen::Index>(target);
  LeftOut out{.theta = end.result.theta, .cost = end.result.cost, .converged = end.result.converged};
  if (!end.evaluation.valid) return out;
  out.frequency_Hz = end.evaluation.frequency_Hz(at);
  out.followed_mac = end.evaluation.mac(at);
  const std::vector<int> side = on_bound(end.end.x, search.box, search.options.bound_tolerance);
  out.on_bounds = static_cast<int>(std::ranges::count_if(side, [](int s) { return s != 0; }));
  return out;
}

}  // namespace

std::vector<LeftOut> leave_each_out(const Search& search, const Eigen::VectorXd& initial) {
  const std::size_t count = search.definition.targets.size();
  if (count < 2) return {};
  std::vector<LeftOut> out(count);
  parallel_for(count, [&](std::size_t target) {
    out[target] = predicted(search, target, run_start(without(search, target), initial, static_cast<int>(target)));
  });
  return out;
}

std::optional<PredictionErrors> prediction_errors(const UpdatingResult& result, const std::vector<FrequencyTarget>& targets) {
  if (result.left_out.size() != targets.size() || targets.empty()) return std::nullopt;
  PredictionErrors out;
  const auto n = static_cast<double>(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!(result.left_out[i].frequency_Hz > 0.0)) return std::nullopt;
    out.before += std::abs(result.frequency_before_Hz(static_cast<Eigen::Index>(i)) / targets[i].measured_Hz - 1.0) / n;
    out.left_out += std::abs(result.left_out[i].frequency_Hz / targets[i].measured_Hz - 1.0) / n;
  }
  return out;
}

std::shared_ptr<const UpdatingResult> regularised_where_worse(const UpdatingResult& found, const fe::ParametricSystem& start,
                                                              const Refresh& refresh, const std::vector<int>& active,
                                                              const std::vector<FrequencyTarget>& targets,
                                                              UpdatingOptions options, const MeasuredRows& rows) {
  const auto errors = prediction_errors(found, targets);
  if (!errors || errors->left_out <= errors->before) return nullptr;
  options.prior = true;
  options.starts = 1;
  options.elsewhere.clear();
  const auto out = std::make_shared<const UpdatingResult>(update(start, refresh, active, targets, options, {}, rows));
  return out->status.converged && prediction_errors(*out, targets) ? out : nullptr;
}

}  // namespace twindeck::updating
