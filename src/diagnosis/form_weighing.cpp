#include "diagnosis/form_weighing.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/statistics.hpp"
#include "diagnosis/diagnose_parts.hpp"
#include "diagnosis/splitting_measurement.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Extra deviation of ln (size of an effect): a size is in units of a model that is wrong.
constexpr double kSizeError = 0.1, kSizePerForm = 5.0, kMostSizeError = 0.4;

/// The same for the intervals of sizes. With it 90 % of 211 hidden sizes lie inside (blind trials 68001 to 68200, 69001 to
/// 69440).
constexpr double kSizeErrorOfIntervals = 0.15;

double size_error(double form_error, double least = kSizeError) {
  return std::min(least + kSizePerForm * form_error, kMostSizeError);
}

/// Odds of something else to the leader. A generic change has no signature, and what the catalogue lacks often acts like an
/// entry: what is else_within behind the leader is as probable as an entry that is set_within behind.
double odds_of_something_else(const FormSearch& search, double misfit) {
  const RuleOptions rules;
  double sum = 0.0;
  for (const double w : search.else_weight) {
    const double behind = (search.entries.front().log_weight - w) / misfit;
    sum += std::exp(-(behind > 0.0 ? rules.set_within / rules.else_within * behind : behind));
  }
  return sum;
}

/// Posterior of the leader over the catalogue, nothing and something else, the likelihoods widened by the misfit.
double probability_of_leader(const FormSearch& search, double misfit) {
  const double leader = search.entries.front().log_weight;
  double sum = std::exp((search.none_weight - leader) / misfit) + odds_of_something_else(search, misfit);
  for (const FormEntry& entry : search.entries) sum += std::exp((entry.log_weight - leader) / misfit);
  return 1.0 / sum;
}

/// The others of a cluster; magnitudes of those that were linearised with the entry in the model.
std::vector<Rival> form_rivals(const FormSearch& search, const Weighing& weighing, const std::vector<const Scored*>& members,
                               double probability_of_leader, const FormSetting& setting) {
  const double misfit = std::max(1.0, weighing.weighed.chi_squared_ratio), leader = search.entries.front().log_weight;
  std::vector<double> probability;
  for (const std::size_t i : weighing.members)
    probability.push_back(probability_of_leader * std::exp((search.entries[i].log_weight - leader) / misfit));
  std::vector<Rival> out = rivals_of(members, probability, misfit);
  for (std::size_t m = 1; m < weighing.members.size(); ++m) {
    const FormEntry& entry = search.entries[weighing.members[m]];
    if (entry.refined && !entry.with.causes.empty() && entry.with.causes.back().candidate == entry.candidate)
      out[m - 1].parameters = effect_parameters(setting.informed, entry.with, entry.with.causes.size() - 1);
  }
  return out;
}

}  // namespace

Scored scored_of(const FormSearch& search, const FormEntry& entry, const Inference& informed) {
  Scored out;
  out.candidate = entry.candidate;
  out.a = entry.a;
  out.log_odds = entry.log_weight - search.none_weight;
  out.screen = std::max(0.0, 2.0 * (entry.evidence.log_evidence - search.none.log_evidence));
  out.chi_squared = out.remaining = entry.evidence.best.chi_squared;
  out.stage = entry.refined ? 3 : 1;
  if (entry.a.size() == entry.candidate->low.size()) out.signature = informed.signature(search.base, *entry.candidate, entry.a);
  if (out.signature.size() == 0) out.signature = VectorXd::Zero(std::ssize(informed.training()));
  if (entry.refined) out.x = entry.with.map.x.head(static_cast<Index>(informed.map().nuisances().size()));
  return out;
}

Weighing weighing_of(const FormSearch& search, const std::vector<Scored>& ranking, const FormSetting& setting,
                     const DiagnoseOptions& options) {
  const int dof = setting.dof;
  Weighing out;
  out.weighed.none = search.none_weight;
  for (const double w : search.else_weight) out.weighed.something_else = std::max(out.weighed.something_else, w);
  out.weighed.none_chi_squared_ratio = search.none.best.chi_squared / dof;
  if (search.entries.empty()) return out;
  const FormEntry& leader = search.entries.front();
  out.weighed.leader = leader.log_weight;
  out.weighed.chi_squared_ratio = leader.evidence.best.chi_squared / dof;
  out.weighed.in_all_conditions = leader.contrast < 0;
  out.weighed.kappa = leader.contrast < 0 ? 0.0 : leader.evidence.kappa;
  out.weighed.effect = leader.effect;
  out.weighed.size_error =
      size_error(setting.grid.frequency[setting.grid.points[static_cast<std::size_t>(leader.evidence.best.point)].frequency]);
  out.weighed.between_states = !leader.candidate->state.empty();
  out.weighed.tuned = leader.candidate->tuned >= 0;
  const double misfit = std::max(1.0, out.weighed.chi_squared_ratio);
  for (std::size_t i = 0; i < search.entries.size(); ++i) {
    const double gap = (leader.log_weight - search.entries[i].log_weight) / misfit;
    if (gap >= std::max(options.either_within, options.same_within)) break;
    const double norms = ranking[0].signature.norm() * ranking[i].signature.norm();
    const double cosine = norms > 0.0 ? std::abs(ranking[0].signature.dot(ranking[i].signature)) / norms : 0.0;
    if (gap < options.either_within || (gap < options.same_within && cosine > options.same_direction)) out.members.push_back(i);
  }
  out.weighed.members = static_cast<int>(out.members.size());
  return out;
}

Effect effect_from(const FormSearch& search, const std::vector<Scored>& ranking, const Weighing& weighing, const Ruling& ruling,
                   const FormSetting& setting) {
  Effect effect;
  effect.cause = {search.entries.front().candidate, search.entries.front().a};
  effect.state = effect.cause.candidate->state;
  effect.log_odds = ruling.against_none;
  const double misfit = std::max(1.0, weighing.weighed.chi_squared_ratio);
  effect.probability = probability_of_leader(search, misfit);
  std::vector<const Scored*> members;
  for (const std::size_t i : weighing.members) members.push_back(&ranking[i]);
  for (const Scored* member : members) effect.cluster.push_back(member->candidate->id());
  effect.rivals = form_rivals(search, weighing, members, effect.probability, setting);
  if (ruling.something_else_in_set) {
    effect.cluster.emplace_back("other@global");
    effect.rivals.push_back({"other@global", nullptr, effect.probability * odds_of_something_else(search, misfit), {}});
  }
  effect.split_by = splitting_measurement(setting.plain, search.base, members);
  return effect;
}

void widen_for_form(std::vector<EffectParameter>& parameters, double form_error) {
  widen_sizes(parameters, size_error(form_error, kSizeErrorOfIntervals));
}

void widen_sizes(std::vector<EffectParameter>& parameters, double deviation) {
  const double reach = kReachOfNinety * deviation;
  static const std::set<std::string> no_size = {"Hz", "deg", "degC", "C", "s", "m"};
  for (EffectParameter& p : parameters) {
    if (no_size.contains(p.unit)) continue;
    const bool factor = p.name == "factor";
    const auto size = [&](double v) { return factor ? std::log(v) : v; };
    const auto back = [&](double z) { return factor ? std::exp(z) : z; };
    const double z = size(p.value), low = size(p.low), high = size(p.high);
    const auto end = [&](double of) {
      if (of * z > 0.0) return z * std::exp(std::copysign(std::hypot(std::log(of / z), reach), std::abs(of) - std::abs(z)));
      return z + std::copysign(std::hypot(of - z, reach * z), of - z);
    };
    if (!(z != 0.0) || !std::isfinite(z)) continue;
    if (!p.at_low_bound) p.low = back(low == z ? z - std::abs(z) * reach : end(low));
    if (!p.at_high_bound) p.high = back(high == z ? z + std::abs(z) * reach : end(high));
  }
}

}  // namespace twindeck::diagnosis
