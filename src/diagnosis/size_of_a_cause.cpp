#include "diagnosis/size_of_a_cause.hpp"

#include "diagnosis/form_magnitudes.hpp"

namespace twindeck::diagnosis {

using Eigen::Index;

namespace {

/// [-] of the range of an unknown, in logarithms; a bounded search ends on the bound to within this rounding
constexpr double kOnLowerBound = 1e-3;

}  // namespace

bool may_be_zero(const std::vector<EffectParameter>& parameters, const Candidate& candidate) {
  if (parameters.size() != 1) return false;
  if (candidate.hypothesis->unknowns[0].name == "factor") return parameters[0].low < 1.0 && parameters[0].high > 1.0;
  if (!is_a_size(candidate) || candidate.log[0]) return false;
  const bool either_sign = candidate.low[0] < 0.0 && candidate.high[0] > 0.0;
  return either_sign && parameters[0].low < 0.0 && parameters[0].high > 0.0;
}

bool at_its_least(const Cause& cause) {
  const Candidate& candidate = *cause.candidate;
  for (Index i = 0; i < cause.a.size(); ++i) {
    const auto unknown = static_cast<std::size_t>(i);
    const bool size =
        candidate.log[unknown] && i != candidate.tuned && candidate.hypothesis->unknowns[unknown].name != "factor";
    if (size && cause.a[i] - candidate.low[i] < kOnLowerBound * (candidate.high[i] - candidate.low[i])) return true;
  }
  return false;
}

std::string objection_to_size(const Cause& cause, const std::vector<EffectParameter>& parameters) {
  if (may_be_zero(parameters, *cause.candidate)) return "the size of the best cause cannot be told from zero";
  if (at_its_least(cause))
    return "the best cause fits best where it is as small as it can be: something outside the catalogue acts like it";
  return {};
}

}  // namespace twindeck::diagnosis
