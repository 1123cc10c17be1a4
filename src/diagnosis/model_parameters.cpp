#include "diagnosis/model_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;

/// @param j  position among the nuisances
ParameterEstimate estimate(const Inference& inference, const Fit& fit, std::size_t j) {
  const Nuisance& v = inference.map().nuisances()[j];
  const auto column = static_cast<Index>(j);
  const auto l = fit.total_factor.triangularView<Eigen::Lower>();
  const Eigen::VectorXd seen = l.solve(fit.map.jacobian.col(column));
  const double left = std::clamp(1.0 - seen.squaredNorm(), 0.0, 1.0);  // remaining share of the prior's variance
  const double misfit = std::max(1.0, fit.chi_squared / inference.dof());
  const double x = fit.map.x[column], reach = kReachOfNinety * std::sqrt(misfit * left);
  const auto physical = [&](double u) { return v.mean + v.deviation * std::clamp(u, v.lower, v.upper); };
  return {physical(x), physical(x - reach), physical(x + reach)};
}

/// Applies accepted causes to a parameter: its value times the factor of a cause at its group.
void scale_by_causes(const Diagnosis& result, const fe::Parameter& parameter, ParameterEstimate& after) {
  for (const Effect& effect : result.effects) {
    const Candidate& candidate = *effect.cause.candidate;
    const bool factor = effect.parameters.size() == 1 && effect.parameters[0].name == "factor";
    if (candidate.hypothesis->set != "groups" || candidate.location != "group:" + parameter.name || !factor) continue;
    const EffectParameter& p = effect.parameters[0];
    if (after.value == 0.0 || parameter.initial == 0.0 ||
        !(p.low > 0.0)) {  // a correction term that starts at zero, in its own unit
      after = {after.value + p.value - 1.0, after.low + p.low - 1.0, after.high + p.high - 1.0};
      continue;
    }
    const double value = after.value * p.value;
    const auto deviation = [&](double end, double end_of_factor) {  // of logarithms, in quadrature
      const double own = end / after.value > 0.0 ? std::log(end / after.value) : 0.0;
      return std::hypot(own, std::log(end_of_factor / p.value));
    };
    after = {value, value * std::exp(-deviation(after.low, p.low)), value * std::exp(deviation(after.high, p.high))};
  }
}

}  // namespace

std::vector<ModelParameter> model_parameters(const Inference& inference, const Diagnosis& result) {
  std::vector<ModelParameter> out;
  if (result.before.total_factor.size() == 0 || result.after.total_factor.size() == 0) return out;
  const auto& nuisances = inference.map().nuisances();
  for (std::size_t j = 0; j < nuisances.size(); ++j) {
    if (nuisances[j].kind != Nuisance::Kind::parameter) continue;
    const fe::Parameter& parameter = inference.map().model().parameters[static_cast<std::size_t>(nuisances[j].index)];
    ModelParameter one{parameter.name, parameter.unit, estimate(inference, result.before, j),
                       estimate(inference, result.after, j)};
    scale_by_causes(result, parameter, one.after);
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace twindeck::diagnosis
