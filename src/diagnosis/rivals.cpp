#include <algorithm>
#include <cmath>

#include "core/statistics.hpp"
#include "diagnosis/diagnose_parts.hpp"

namespace twindeck::diagnosis {

namespace {

/// Magnitudes of an entry by the curvature of its likelihood; an end beyond its bounds is the bound.
std::vector<EffectParameter> by_curvature(const Scored& scored, double misfit) {
  const Candidate& candidate = *scored.candidate;
  std::vector<EffectParameter> out;
  if (scored.a.size() == 0 || scored.a_covariance.rows() != scored.a.size()) return out;
  for (Eigen::Index i = 0; i < scored.a.size(); ++i) {
    const UnknownSpec& spec = candidate.hypothesis->unknowns[static_cast<std::size_t>(i)];
    const double reach = kReachOfNinety * std::sqrt(misfit * std::max(scored.a_covariance(i, i), 0.0));
    EffectParameter p{spec.name, spec.unit, candidate.physical(scored.a, i), 0.0, 0.0, false, false};
    p.at_low_bound = scored.a[i] - reach <= candidate.low[i];
    p.at_high_bound = scored.a[i] + reach >= candidate.high[i];
    Eigen::VectorXd end = scored.a;
    end[i] = std::max(scored.a[i] - reach, candidate.low[i]);
    p.low = candidate.physical(end, i);
    end[i] = std::min(scored.a[i] + reach, candidate.high[i]);
    p.high = candidate.physical(end, i);
    out.push_back(p);
  }
  return out;
}

}  // namespace

std::vector<Rival> rivals_of(const std::vector<const Scored*>& members, const std::vector<double>& probability, double misfit) {
  std::vector<Rival> out;
  for (std::size_t i = 1; i < members.size(); ++i)
    out.push_back({members[i]->candidate->id(), members[i]->candidate, probability[i], by_curvature(*members[i], misfit)});
  return out;
}

}  // namespace twindeck::diagnosis
