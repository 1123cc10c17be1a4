#include "diagnosis/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "diagnosis/diagnose_parts.hpp"
#include "diagnosis/refinement.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// What misfit is left even with the best cause widens every likelihood (Birge 1932), so that a badly stated noise names
/// nothing. Up to a factor: misfit beyond any honest mistake about the noise is a further cause, and must not hide the first.
double birge(const Scored& best, int dof) { return std::clamp(best.remaining / std::max(1, dof), 1.0, 3.0); }

double tempered(const Scored& scored, double ratio) {
  const double prior = scored.candidate->log_prior;
  return scored.log_odds < -1e299 ? -1e300 : (scored.log_odds - prior) / ratio + prior;
}

/// The ranking as it is told: one number an entry, the same as that of an effect or of the detection. The leader stays the
/// first.
std::vector<Scored> with_widened_odds(std::vector<Scored> ranking, double ratio) {
  for (Scored& scored : ranking) scored.log_odds = tempered(scored, ratio);
  std::stable_sort(ranking.begin() + 1, ranking.end(),
                   [](const Scored& a, const Scored& b) { return a.log_odds > b.log_odds; });
  return ranking;
}

/// What is known beforehand does not widen with the misfit: an entry to which a study gives more weight than the catalogue does
/// leads where its odds are the largest once the likelihoods are widened.
void prefer_stated_priors(std::vector<Scored>& ranking, double ratio) {
  auto best = ranking.begin();
  for (auto at = ranking.begin(); at != ranking.end(); ++at)
    if (at->candidate->hypothesis->prior_weight > 1.0 && tempered(*at, ratio) > tempered(*best, ratio)) best = at;
  std::rotate(ranking.begin(), best, best + 1);
}

double cosine_of(const Scored& a, const Scored& b) {
  const double norms = a.signature.norm() * b.signature.norm();
  return a.signature.size() == b.signature.size() && norms > 0.0 ? a.signature.dot(b.signature) / norms : 0.0;
}

/// Of entries that say the same equally well the one with the fewest unknowns leads: an oscillator tuned far above all modes is
/// a mass.
void prefer_fewer_unknowns(std::vector<Scored>& ranking, double ratio, const DiagnoseOptions& options) {
  const Scored& best = ranking.front();
  auto simplest = ranking.begin();
  for (auto at = ranking.begin(); at != ranking.end(); ++at)
    if (at->a.size() < simplest->a.size() && tempered(best, ratio) - tempered(*at, ratio) < options.equal_within &&
        std::abs(cosine_of(best, *at)) > options.same_direction)
      simplest = at;
  std::rotate(ranking.begin(), simplest, simplest + 1);
}

/// Entries that these data can't tell from the best.
std::vector<const Scored*> cluster_of(const std::vector<Scored>& ranking, double ratio, const DiagnoseOptions& options) {
  std::vector<const Scored*> members;
  const Scored& best = ranking.front();
  for (const Scored& other : ranking) {
    if (other.log_odds < -1e299) continue;
    const double gap = tempered(best, ratio) - tempered(other, ratio);
    bool in = gap < options.either_within;
    if (!in && gap < options.same_within) in = std::abs(cosine_of(best, other)) > options.same_direction;
    if (in) members.push_back(&other);
  }
  return members;
}

}  // namespace

/// The measurement that would tell two causes apart: the node where their mode shapes differ most, or another condition.
std::string splitting_measurement(const Inference& inference, const Fit& base, const std::vector<const Scored*>& members) {
  if (members.size() < 2) return "";
  const FeatureMap& map = inference.map();
  const Candidate& a = *members[0]->candidate;
  const Candidate& b = *members[1]->candidate;
  const auto& needs_a = a.hypothesis->needs.distinct;
  const auto& needs_b = b.hypothesis->needs.distinct;
  for (const auto* needs : {&needs_a, &needs_b})
    for (const auto& [key, count] : *needs)
      if (a.hypothesis != b.hypothesis && (!needs_a.contains(key) || !needs_b.contains(key)))
        return fmt::format("the same modes at further values of {}", key);
  if (a.hypothesis->set == "dampers" && b.hypothesis->set == "dampers" && a.hypothesis != b.hypothesis)
    return "the modes with dampers at two or more amplitudes, one of them beyond slip";
  if (a.hypothesis->measurement || b.hypothesis->measurement) {
    std::string names;
    for (const Candidate* c : {&a, &b})
      for (const int channel : c->channels)
        names += (names.empty() ? "" : ", ") + map.features().channels[static_cast<std::size_t>(channel)];
    return "a repeated record with a second, calibrated sensor beside " + names;
  }
  const auto nodes = map.model().sets.find("nodes");
  if (nodes == map.model().sets.end() || map.measured_modes().empty()) return "";
  // Shapes at every candidate node under both causes, of the modes as measured now.
  double largest = 0.0;
  std::string where;
  const auto shapes_of = [&](const Scored& scored) {
    std::vector<Cause> causes = base.causes;
    causes.push_back({scored.candidate, scored.a});
    return map.node_motion(base.base, causes);
  };
  const auto motion_a = shapes_of(*members[0]), motion_b = shapes_of(*members[1]);
  for (const auto& [name, values] : motion_a) {
    const auto other = motion_b.find(name);
    if (other == motion_b.end() || other->second.size() != values.size()) continue;
    Index mode = 0;
    const double difference = (values - other->second).cwiseAbs().maxCoeff(&mode);
    if (difference > largest) {
      largest = difference;
      const auto space = name.rfind(' ');  // "node:17 z"
      where = fmt::format("the shape of mode {} at {} along {}", map.measured_modes()[static_cast<std::size_t>(mode)].label,
                          name.substr(0, space), name.substr(space + 1));
    }
  }
  return where.empty() ? "" : fmt::format("{} (differs by {:.1f} % of the largest)", where, 100.0 * largest);
}

std::vector<LocationScore> location_map(const Inference& inference, const Fit& fit, const std::vector<Scored>& ranking) {
  std::map<std::string, double> best;
  const auto& nuisances = inference.map().nuisances();
  for (std::size_t j = 0; j < nuisances.size(); ++j) {
    const Nuisance& v = nuisances[j];
    if (v.kind == Nuisance::Kind::mode_damping || v.kind == Nuisance::Kind::level) continue;
    const VectorXd l = fit.total_factor.triangularView<Eigen::Lower>().solve(fit.map.jacobian.col(static_cast<Index>(j)));
    if (!(l.norm() > 1e-9)) continue;
    const std::string location = v.kind == Nuisance::Kind::parameter ? "group:" + v.name : v.name.substr(0, v.name.find(' '));
    double& score = best[location];
    score = std::max(score, std::abs(l.dot(fit.whitened)) / l.norm());
  }
  for (const Scored& scored : ranking) {
    if (scored.candidate->location == "global" || scored.candidate->hypothesis->measurement || scored.screen <= 0.0) continue;
    double& score = best[scored.candidate->location];
    score = std::max(score, std::sqrt(scored.screen));
  }
  std::vector<LocationScore> map;
  for (const auto& [location, score] : best) map.push_back({location, score});
  std::stable_sort(map.begin(), map.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  if (map.size() > 40) map.resize(40);
  return map;
}

std::string sentence_of(const Effect& effect) {
  std::string text = effect.cause.candidate->hypothesis->sentence;
  const auto replace = [&](const std::string& key, const std::string& value) {
    for (auto at = text.find(key); at != std::string::npos; at = text.find(key)) text.replace(at, key.size(), value);
  };
  replace("{location}", effect.cause.candidate->location);
  for (const EffectParameter& p : effect.parameters) {
    replace("{" + p.name + "}", fmt::format("{:.4g}", p.value));
    replace("{" + p.name + ".low}", fmt::format("{:.4g}", p.low));
    replace("{" + p.name + ".high}", fmt::format("{:.4g}", p.high));
  }
  return text;
}

namespace {

/// Drops earlier causes whose removal costs less than the threshold.
void check_backwards(const Inference& inference, Fit& current, std::vector<Effect>& effects, const DiagnoseOptions& options) {
  std::size_t held = 0;  // up to here no cause can go
  while (held + 1 < effects.size()) {
    std::vector<Fit> without(effects.size() - 1);
    parallel_for(without.size() - held, [&](std::size_t after_held) {
      const std::size_t i = held + after_held;
      std::vector<Cause> rest = current.causes;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      without[i] = inference.fit(rest, current.map.x.head(static_cast<Index>(inference.map().nuisances().size())));
    });
    const auto dispensable = [&](std::size_t i) {
      const double cost = 0.5 * (without[i].chi_squared - current.chi_squared) + effects[i].cause.candidate->log_prior;
      return cost < std::max(options.threshold, options.least_log_odds) - 1.0;
    };
    while (held < without.size() && !dispensable(held)) ++held;
    if (held == without.size()) return;
    effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(held));
    current = std::move(without[held]);
  }
}

/// The lowest fit of the same causes from where the best entries left x. A better optimiser must not look like a better model:
/// modes that change partners make valleys beside each other, and an entry may have found the way into a deeper one.
Fit lowest_from(const Inference& inference, const Fit& current, const std::vector<Scored>& ranking) {
  std::vector<const VectorXd*> starts;
  for (const Scored& scored : ranking)
    if (scored.x.size() > 0 && starts.size() < 3) starts.push_back(&scored.x);
  std::vector<Fit> again(starts.size());
  parallel_for(starts.size(), [&](std::size_t i) { again[i] = inference.fit(current.causes, *starts[i]); });
  Fit lowest = current;
  for (Fit& fit : again)
    if (fit.chi_squared < lowest.chi_squared) lowest = std::move(fit);
  return lowest;
}

/// The fit extended by the first entry of the ranking that is above the threshold and keeps its promise. Odds on the linearised
/// base are a promise: an entry with which the joint fit is no lower than without goes to the end of the ranking.
Fit extended_by_first(const Inference& inference, const Fit& current, std::vector<Scored>& ranking, double ratio,
                      double threshold) {
  const auto n = static_cast<Index>(inference.map().nuisances().size());
  while (tempered(ranking.front(), ratio) > threshold) {
    Scored& first = ranking.front();
    std::vector<Cause> causes = current.causes;
    causes.push_back({first.candidate, first.a});
    // From where the search left it and from where the fit without it is: valleys lie beside each other.
    std::vector<VectorXd> starts{current.map.x.head(n)};
    if (first.x.size() > 0) starts.push_back(first.x);
    std::vector<Fit> extended(starts.size());
    parallel_for(starts.size(), [&](std::size_t i) { extended[i] = inference.fit(causes, starts[i]); });
    // By what the fits minimise: the whitened misfit looks past the bounds that hold a fit back.
    Fit& lowest = extended.back().map.chi_squared <= extended.front().map.chi_squared ? extended.back() : extended.front();
    if (lowest.chi_squared < current.chi_squared) return std::move(lowest);
    first.log_odds = -1e300;
    std::rotate(ranking.begin(), ranking.begin() + 1, ranking.end());
  }
  return current;
}

}  // namespace

double tempered_log_odds(const Scored& best, int dof) { return tempered(best, birge(best, dof)); }

double analytic_threshold(const Inference& inference, double alpha) {
  const auto tail = [&](double d) {
    double sum = 0.0;
    for (const auto& candidate : inference.candidates())
      sum +=
          chi_squared_tail(2.0 * (d - candidate->log_prior), std::max<double>(1.0, static_cast<double>(candidate->low.size())));
    return sum;
  };
  double low = -10.0, high = 30.0;
  for (int i = 0; i < 60; ++i) (tail(0.5 * (low + high)) > alpha ? low : high) = 0.5 * (low + high);
  return high;
}

Diagnosis diagnose(const Inference& inference, const DiagnoseOptions& options, std::uint64_t seed) {
  Diagnosis out;
  out.threshold = std::max(options.threshold, options.least_log_odds);
  out.alpha = options.alpha;
  const auto n = static_cast<Index>(inference.map().nuisances().size());
  Fit current = inference.fit({}, {});
  if (current.chi_squared > 1e299) {
    out.verdict = "unknown";
    out.message = "the model predicts none of these rows: " + current.map.status.message;
    return out;
  }
  out.before = current;
  std::vector<Scored> ranking;
  ScreenTable first_look;  // what the first search computed of every entry; the next ones look through it first
  const auto search = [&] {
    return inference.search(current, options.search, first_look.change.empty() ? nullptr : &first_look, &first_look);
  };
  for (int step = 0; step <= options.most_causes; ++step) {
    if (step == options.most_causes && step > 0) {  // no more causes are wanted: the map of what is left takes the screen alone
      SearchOptions look = options.search;
      look.short_list = look.longest_list = look.probes = 0;
      look.family_screen = std::numeric_limits<double>::infinity();
      ranking = inference.search(current, look, first_look.change.empty() ? nullptr : &first_look, &first_look);
      break;
    }
    ranking = search();
    if (ranking.empty()) break;
    double ratio = birge(ranking.front(), inference.dof());
    for (int guard = 0; guard < 2 && tempered(ranking.front(), ratio) > -2.0; ++guard) {
      Fit lower = lowest_from(inference, current, ranking);
      const double fall = 0.5 * (current.chi_squared - lower.chi_squared) / ratio;  // of the widened odds
      if (!(fall > 0.5)) break;
      const double nats = 0.5 * (current.chi_squared + current.log_determinant - lower.chi_squared - lower.log_determinant);
      current = std::move(lower);
      if (step == 0) out.before = current;
      if (fall < options.least_log_odds) {  // not worth another search: every entry gains that much less
        for (Scored& scored : ranking) scored.log_odds -= nats;
        break;
      }
      ranking = search();
      if (ranking.empty()) break;
      ratio = birge(ranking.front(), inference.dof());
    }
    if (ranking.empty()) break;
    const auto weigh = [&] {
      if (step < options.most_causes && tempered(ranking.front(), ratio) > out.threshold) {
        if (options.refinement != nullptr) look_round_leader(inference, current, ranking, options);
        ratio = birge(ranking.front(), inference.dof());
        prefer_mass_to_bound(inference, current, ranking, ratio, options);
      }
      prefer_fewer_unknowns(ranking, ratio, options);
      prefer_stated_priors(ranking, ratio);
      return step < options.most_causes ? extended_by_first(inference, current, ranking, ratio, out.threshold) : current;
    };
    Fit extended = weigh();
    const bool found = tempered(ranking.front(), ratio) > out.threshold;
    if (!found && step > 0 && step < options.most_causes && !first_look.change.empty()) {
      // That nothing more is there is said only after every entry was computed anew.
      ranking = inference.search(current, options.search);
      if (ranking.empty()) break;
      ratio = birge(ranking.front(), inference.dof());
      extended = weigh();
    }
    if (step == 0) {
      out.ranking = with_widened_odds(ranking, ratio);
      out.log_odds = tempered(ranking.front(), ratio);
      out.localisation = location_map(inference, current, ranking);
    }
    if (step == options.most_causes || tempered(ranking.front(), ratio) <= out.threshold) break;
    auto members = cluster_of(ranking, ratio, options);
    std::vector<const Scored*> merged;
    Effect effect;
    effect.within_m = merge_neighbours(members, merged);
    effect.cause = {ranking.front().candidate, ranking.front().a};
    effect.state = effect.cause.candidate->state;
    effect.log_odds = tempered(ranking.front(), ratio);
    const double top = effect.log_odds;
    double scaled = std::exp(-top);  // nothing missing has odds 1
    for (const Scored& scored : ranking)
      if (const double d = tempered(scored, ratio); d > top - 40.0) scaled += std::exp(d - top);
    std::vector<double> probability;
    for (const Scored* member : members) {
      effect.cluster.push_back(member->candidate->id());
      probability.push_back(1.0 / scaled * std::exp(tempered(*member, ratio) - top));
    }
    effect.probability = 1.0 / scaled;
    for (const Scored* beside : merged) effect.probability += 1.0 / scaled * std::exp(tempered(*beside, ratio) - top);
    effect.rivals = rivals_of(members, probability, ratio);
    effect.split_by = splitting_measurement(inference, current, members);
    current = std::move(extended);
    out.effects.push_back(effect);
    check_backwards(inference, current, out.effects, options);
  }
  out.after = current;
  for (std::size_t i = 0; i < out.effects.size(); ++i) {
    out.effects[i].cause = current.causes[i];
    out.effects[i].parameters = effect_parameters(inference, current, i);
    out.effects[i].sentence = sentence_of(out.effects[i]);
    out.effects[i].remedy = out.effects[i].cause.candidate->hypothesis->remedy;
  }
  out.after_extension = !out.effects.empty();
  if (out.after_extension) out.localisation = location_map(inference, current, ranking);
  out.residual = residual_test(inference, current);
  out.gain = held_out_gain(inference, out.before, out.after, options.bootstrap, seed);
  for (Index j = 0; j < n; ++j) {
    const Nuisance& v = inference.map().nuisances()[static_cast<std::size_t>(j)];
    const double range = v.upper - v.lower;
    if (v.kind != Nuisance::Kind::parameter || !std::isfinite(range)) continue;
    const double u = out.before.map.x[j];
    if (u < v.lower + 0.02 * range || u > v.upper - 0.02 * range) out.on_bounds.push_back(v.name);
  }
  const bool rejects = out.residual.rejects(options.residual_alpha);
  // Held-out rows speak against a cause where they lose by more than chance, and by as many nats as a name must win.
  const double loss = 0.5 * out.gain.rows * (out.gain.after * out.gain.after - out.gain.before * out.gain.before);
  const bool fits_but_does_not_predict =
      !out.effects.empty() && out.gain.rows > 0 && out.gain.high_pct < 0.0 && loss > options.least_log_odds;
  const bool ambiguous =
      std::any_of(out.effects.begin(), out.effects.end(), [](const Effect& e) { return e.cluster.size() > 1; });
  if (rejects || fits_but_does_not_predict)
    out.verdict = "unknown";
  else if (out.effects.empty())
    out.verdict = "none";
  else
    out.verdict = ambiguous ? "ambiguous" : "named";
  if (out.verdict == "none")
    out.message = fmt::format("nothing found (largest log odds {:.1f}, threshold {:.1f})", out.log_odds, out.threshold);
  if (out.verdict == "unknown") {
    out.message = rejects ? "something is missing that no entry of the catalogue explains"
                          : "the best cause fits but does not predict the held-out rows";
    if (!out.effects.empty()) out.message += "; it acts like " + out.effects.front().cluster.front();
    if (rejects && out.residual.block_p_value < options.residual_alpha)
      out.message +=
          fmt::format("; not explained: {} ({} rows)", out.residual.blocks.front().name, out.residual.blocks.front().rows);
  }
  if (out.verdict == "named" || out.verdict == "ambiguous") out.message = out.effects.front().sentence;
  return out;
}

}  // namespace twindeck::diagnosis
