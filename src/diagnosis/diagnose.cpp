#include "diagnosis/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "diagnosis/diagnose_parts.hpp"
#include "diagnosis/refinement.hpp"
#include "diagnosis/splitting_measurement.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kMostWidening = 3.0;  ///< [-] of chi² per degree of freedom: more is a further cause, not an honest mistake
constexpr double kWorthALowerBase = -2.0;  ///< [nats] log odds from which a lower fit of the base may change what is named
constexpr double kNoticeableFall = 0.5;    ///< [nats] of a lower fit of the base: less changes no ranking
constexpr int kLowerFits = 2;              ///< of the base before one step goes on
constexpr std::size_t kOtherStarts = 3;    ///< entries whose x the base is fitted from again: the leading ones
constexpr double kBackwardSlack = 1.0;  ///< [nats] below the threshold before an earlier cause is dropped: none comes and goes
constexpr double kNegligibleOdds = 40.0;  ///< [nats] below the best: e^-40 adds nothing to a sum in double precision
constexpr double kLowestThreshold = -10.0, kHighestThreshold = 30.0;  ///< [nats] between which the analytic threshold is sought
constexpr int kHalvings = 60;                                         ///< of that interval: to the last bit
constexpr double kNearBound = 0.02;  ///< [-] of a parameter's range: nearer than that to its end it stands on the bound

/// What misfit is left even with the best cause widens every likelihood (Birge 1932), so that a badly stated noise names
/// nothing. Up to a factor: misfit beyond any honest mistake about the noise is a further cause, and must not hide the first.
double birge(const Scored& best, int dof) { return std::clamp(best.remaining / std::max(1, dof), 1.0, kMostWidening); }

double tempered(const Scored& scored, double ratio) {
  const double prior = scored.candidate->log_prior;
  return scored.weighed() ? (scored.log_odds - prior) / ratio + prior : -kNotFitted;
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
    if (!other.weighed()) continue;
    const double gap = tempered(best, ratio) - tempered(other, ratio);
    bool in = gap < options.either_within;
    if (!in && gap < options.same_within) in = std::abs(cosine_of(best, other)) > options.same_direction;
    if (in) members.push_back(&other);
  }
  return members;
}

}  // namespace

std::vector<std::string> parameters_on_bounds(const FeatureMap& map, const Fit& fit) {
  std::vector<std::string> names;
  const auto& nuisances = map.nuisances();
  for (std::size_t j = 0; j < nuisances.size(); ++j) {
    const Nuisance& v = nuisances[j];
    const double range = v.upper - v.lower;
    if (v.kind != Nuisance::Kind::parameter || !std::isfinite(range)) continue;
    const double u = fit.map.x[static_cast<Index>(j)];
    if (u < v.lower + kNearBound * range || u > v.upper - kNearBound * range) names.push_back(v.name);
  }
  return names;
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
      return cost < std::max(options.threshold, options.least_log_odds) - kBackwardSlack;
    };
    while (held < without.size() && !dispensable(held)) ++held;
    if (held == without.size()) return;
    effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(held));
    current = std::move(without[held]);
  }
}

/// The lowest fit of the same causes from where the best entries left x. A better optimiser must not look like a better model:
/// modes that change partners make several local minima, and an entry may have found the way into a lower one.
Fit lowest_from(const Inference& inference, const Fit& current, const std::vector<Scored>& ranking) {
  std::vector<const VectorXd*> starts;
  for (const Scored& scored : ranking)
    if (scored.x.size() > 0 && starts.size() < kOtherStarts) starts.push_back(&scored.x);
  std::vector<Fit> again(starts.size());
  parallel_for(starts.size(), [&](std::size_t i) { again[i] = inference.fit(current.causes, *starts[i]); });
  Fit lowest = current;
  for (Fit& fit : again)
    if (fit.chi_squared < lowest.chi_squared) lowest = std::move(fit);
  return lowest;
}

/// The fit extended by the first entry of the ranking that is enough and keeps its promise. Odds on the linearised base are a
/// promise: an entry with which the joint fit is no lower than without goes to the end of the ranking.
Fit extended_by_first(const Inference& inference, const Fit& current, std::vector<Scored>& ranking,
                      const std::function<bool(const Scored&)>& enough) {
  const auto n = static_cast<Index>(inference.map().nuisances().size());
  while (enough(ranking.front())) {
    Scored& first = ranking.front();
    std::vector<Cause> causes = current.causes;
    causes.push_back({first.candidate, first.a});
    // From where the search left it and from where the fit without it is: they may lead to different local minima.
    std::vector<VectorXd> starts{current.map.x.head(n)};
    if (first.x.size() > 0) starts.push_back(first.x);
    std::vector<Fit> extended(starts.size());
    parallel_for(starts.size(), [&](std::size_t i) { extended[i] = inference.fit(causes, starts[i]); });
    // By what the fits minimise: the whitened misfit looks past the bounds that hold a fit back.
    Fit& lowest = extended.back().map.chi_squared <= extended.front().map.chi_squared ? extended.back() : extended.front();
    if (lowest.chi_squared < current.chi_squared) return std::move(lowest);
    first.log_odds = -kNotFitted;
    std::rotate(ranking.begin(), ranking.begin() + 1, ranking.end());
  }
  return current;
}

/// The forward steps: each searches the catalogue on the fit so far and puts the first entry above the threshold into the
/// model.
class ForwardSteps {
 public:
  ForwardSteps(const Inference& inference, const DiagnoseOptions& options, Diagnosis& out)
      : inference_(inference), options_(options), out_(out), current_(out.before) {}

  void run() {
    for (int step = 0; step <= options_.most_causes; ++step)
      if (!take(step)) break;
  }
  [[nodiscard]] const Fit& fit() const { return current_; }
  [[nodiscard]] const std::vector<Scored>& ranking() const { return ranking_; }

 private:
  /// One step. @return whether another may follow
  bool take(int step) {
    const bool last = step == options_.most_causes;  // no more causes are wanted
    if (last && step > 0) {
      screen_what_is_left();
      return false;
    }
    if (!search() || !lower_the_base(step == 0)) return false;
    Fit extended = weigh(last);
    if (!enough(ranking_.front()) && step > 0 && !first_look_.change.empty()) {
      // That nothing more is there is said only after every entry was computed anew.
      ranking_ = inference_.search(current_, options_.search);
      if (!widen()) return false;
      extended = weigh(last);
    }
    if (step == 0) {
      out_.ranking = with_widened_odds(ranking_, ratio_);
      out_.log_odds = tempered(ranking_.front(), ratio_);
      out_.localisation = location_map(inference_, current_, ranking_);
    }
    if (last || !enough(ranking_.front())) return false;
    const Effect effect = first_effect();
    current_ = std::move(extended);
    out_.effects.push_back(effect);
    check_backwards(inference_, current_, out_.effects, options_);
    return true;
  }

  /// Widens the odds by the misfit that the best entry leaves. @return whether there is an entry
  bool widen() {
    if (ranking_.empty()) return false;
    ratio_ = birge(ranking_.front(), inference_.dof());
    return true;
  }

  /// Whether an entry is a further cause that is tuned to a mode and too faint for that.
  [[nodiscard]] bool faint_tuned(const Scored& scored) const {
    return !out_.effects.empty() && scored.candidate->tuned >= 0 && tempered(scored, ratio_) < options_.further_tuned;
  }

  /// Whether the odds of an entry are enough for a place in the model.
  [[nodiscard]] bool enough(const Scored& scored) const {
    return tempered(scored, ratio_) > out_.threshold && !faint_tuned(scored);
  }

  /// Faint tuned entries do not lead. They stay rivals.
  void put_faint_tuned_last() {
    std::stable_partition(ranking_.begin(), ranking_.end(), [this](const Scored& scored) { return !faint_tuned(scored); });
  }

  bool search() {
    ranking_ = inference_.search(current_, options_.search, known(), &first_look_);
    return widen();
  }

  /// The screen alone, for the map of what is left.
  void screen_what_is_left() {
    SearchOptions look = options_.search;
    look.short_list = look.longest_list = look.probes = 0;
    look.family_screen = std::numeric_limits<double>::infinity();
    ranking_ = inference_.search(current_, look, known(), &first_look_);
  }

  /// Fits the base lower where the search found the way, and searches again if that is worth it.
  bool lower_the_base(bool before_any_cause) {
    for (int i = 0; i < kLowerFits && tempered(ranking_.front(), ratio_) > kWorthALowerBase; ++i) {
      Fit lower = lowest_from(inference_, current_, ranking_);
      const double fall = 0.5 * (current_.chi_squared - lower.chi_squared) / ratio_;  // of the widened odds
      if (!(fall > kNoticeableFall)) break;
      const double nats = 0.5 * (current_.chi_squared + current_.log_determinant - lower.chi_squared - lower.log_determinant);
      current_ = std::move(lower);
      if (before_any_cause) out_.before = current_;
      if (fall < options_.least_log_odds) {  // not worth another search: every entry gains that much less
        for (Scored& scored : ranking_) scored.log_odds -= nats;
        break;
      }
      if (!search()) return false;
    }
    return true;
  }

  /// Orders the leading entries. @return the fit with the first that keeps its promise, the fit so far if none does
  Fit weigh(bool last) {
    put_faint_tuned_last();
    ratio_ = birge(ranking_.front(), inference_.dof());
    if (!last && enough(ranking_.front())) {
      if (options_.refinement != nullptr) look_round_leader(inference_, current_, ranking_, options_);
      ratio_ = birge(ranking_.front(), inference_.dof());
      prefer_mass_to_bound(inference_, current_, ranking_, ratio_, options_);
    }
    prefer_fewer_unknowns(ranking_, ratio_, options_);
    prefer_stated_priors(ranking_, ratio_);
    put_faint_tuned_last();
    return last ? current_ : extended_by_first(inference_, current_, ranking_, [this](const Scored& s) { return enough(s); });
  }

  /// The first entry as an effect, with the entries that these data cannot tell from it.
  [[nodiscard]] Effect first_effect() const {
    auto members = cluster_of(ranking_, ratio_, options_);
    std::vector<const Scored*> merged;
    Effect effect;
    effect.within_m = merge_neighbours(members, merged);
    effect.cause = {ranking_.front().candidate, ranking_.front().a};
    effect.state = effect.cause.candidate->state;
    effect.log_odds = tempered(ranking_.front(), ratio_);
    const double top = effect.log_odds;
    double scaled = std::exp(-top);  // nothing missing has odds 1
    for (const Scored& scored : ranking_)
      if (const double d = tempered(scored, ratio_); d > top - kNegligibleOdds) scaled += std::exp(d - top);
    std::vector<double> probability;
    for (const Scored* member : members) {
      effect.cluster.push_back(member->candidate->id());
      probability.push_back(1.0 / scaled * std::exp(tempered(*member, ratio_) - top));
    }
    effect.probability = 1.0 / scaled;
    for (const Scored* beside : merged) effect.probability += 1.0 / scaled * std::exp(tempered(*beside, ratio_) - top);
    effect.rivals = rivals_of(members, probability, ratio_);
    effect.split_by = splitting_measurement(inference_, current_, members);
    return effect;
  }

  [[nodiscard]] const ScreenTable* known() const { return first_look_.change.empty() ? nullptr : &first_look_; }

  const Inference& inference_;
  const DiagnoseOptions& options_;
  Diagnosis& out_;
  Fit current_;
  std::vector<Scored> ranking_;
  ScreenTable first_look_;  ///< what the first search computed of every entry; the next ones look through it first
  double ratio_ = 1.0;      ///< by which log likelihoods are divided
};

/// Intervals, sentence and remedy of each effect, at the fit with all of them.
void describe_effects(const Inference& inference, const Fit& fit, std::vector<Effect>& effects) {
  for (std::size_t i = 0; i < effects.size(); ++i) {
    effects[i].cause = fit.causes[i];
    effects[i].parameters = effect_parameters(inference, fit, i);
    effects[i].sentence = sentence_of(effects[i]);
    effects[i].remedy = effects[i].cause.candidate->hypothesis->remedy;
  }
}

Verdict verdict_of(const Diagnosis& out, bool residual_rejects, const DiagnoseOptions& options) {
  // Held-out rows speak against a cause where they lose by more than chance, and by as many nats as a name must win.
  const double loss = 0.5 * out.gain.rows * (out.gain.after * out.gain.after - out.gain.before * out.gain.before);
  const bool fits_but_does_not_predict =
      !out.effects.empty() && out.gain.rows > 0 && out.gain.high_pct < 0.0 && loss > options.least_log_odds;
  if (residual_rejects || fits_but_does_not_predict) return Verdict::unknown;
  if (out.effects.empty()) return Verdict::none;
  const bool ambiguous =
      std::any_of(out.effects.begin(), out.effects.end(), [](const Effect& e) { return e.cluster.size() > 1; });
  return ambiguous ? Verdict::ambiguous : Verdict::named;
}

std::string message_for(const Diagnosis& out, bool residual_rejects, const DiagnoseOptions& options) {
  if (out.verdict == Verdict::none)
    return fmt::format("nothing found (largest log odds {:.1f}, threshold {:.1f})", out.log_odds, out.threshold);
  if (out.verdict != Verdict::unknown) return out.effects.front().sentence;
  std::string message = residual_rejects ? "something is missing that no entry of the catalogue explains"
                                         : "the best cause fits but does not predict the held-out rows";
  if (!out.effects.empty()) message += "; it acts like " + out.effects.front().cluster.front();
  if (residual_rejects && out.residual.block_p_value < options.residual_level(out))
    message += fmt::format("; not explained: {} ({} rows)", out.residual.blocks.front().name, out.residual.blocks.front().rows);
  return message;
}

}  // namespace

double DiagnoseOptions::residual_level(const Diagnosis& result) const {
  return result.effects.empty() ? residual_alpha : residual_alpha_named;
}

double tempered_log_odds(const Scored& best, int dof) { return tempered(best, birge(best, dof)); }

double analytic_threshold(const Inference& inference, double alpha) {
  const auto tail = [&](double d) {
    double sum = 0.0;
    for (const auto& candidate : inference.candidates())
      sum +=
          chi_squared_tail(2.0 * (d - candidate->log_prior), std::max<double>(1.0, static_cast<double>(candidate->low.size())));
    return sum;
  };
  double low = kLowestThreshold, high = kHighestThreshold;
  for (int i = 0; i < kHalvings; ++i) (tail(0.5 * (low + high)) > alpha ? low : high) = 0.5 * (low + high);
  return high;
}

Diagnosis diagnose(const Inference& inference, const DiagnoseOptions& options, std::uint64_t seed) {
  Diagnosis out;
  out.threshold = std::max(options.threshold, options.least_log_odds);
  out.alpha = options.alpha;
  const Fit without_causes = inference.fit({}, {});
  if (!without_causes.made()) {
    out.verdict = Verdict::unknown;
    out.message = "the model predicts none of these rows: " + without_causes.map.status.message;
    return out;
  }
  out.before = without_causes;
  ForwardSteps steps(inference, options, out);
  steps.run();
  out.after = steps.fit();
  describe_effects(inference, out.after, out.effects);
  out.after_extension = !out.effects.empty();
  if (out.after_extension) out.localisation = location_map(inference, out.after, steps.ranking());
  out.residual = residual_test(inference, out.after);
  out.gain = held_out_gain(inference, out.before, out.after, options.bootstrap, seed);
  out.on_bounds = parameters_on_bounds(inference.map(), out.before);
  const bool rejects = out.residual.rejects(options.residual_level(out));
  out.verdict = verdict_of(out, rejects, options);
  out.message = message_for(out, rejects, options);
  return out;
}

}  // namespace twindeck::diagnosis
