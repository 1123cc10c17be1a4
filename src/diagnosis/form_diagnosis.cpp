#include "diagnosis/form_diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "diagnosis/diagnose_parts.hpp"
#include "diagnosis/form_base.hpp"
#include "diagnosis/form_gain.hpp"
#include "diagnosis/form_search.hpp"
#include "diagnosis/form_weighing.hpp"
#include "diagnosis/inference/verdict.hpp"
#include "diagnosis/size_of_a_cause.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string message_of(const Diagnosis& out, const Ruling& ruling, const FormReport& form, const FormSearch& search) {
  if (out.verdict == Verdict::named || out.verdict == Verdict::ambiguous) return out.effects.front().sentence;
  const std::string scales = fmt::format("the model's form is off by about {:.1f} % in frequency and {:.1f} % in shape",
                                         100.0 * form.frequency.level, 100.0 * form.shape.level);
  if (out.verdict == Verdict::none)
    return fmt::format("nothing found: {} ({}); causes smaller than that which act in every condition cannot be seen",
                       ruling.reason, scales);
  std::string text = ruling.reason + " (" + scales + ")";
  if (!out.effects.empty())
    text += "; it acts like " + out.effects.front().cluster.front();
  else if (!search.entries.empty() && ruling.against_none > ruling.threshold)
    text += "; it acts like " + search.entries.front().candidate->id();
  return text;
}

void add_warnings(FormReport& form, const ScaleGrid& grid) {
  const auto warn = [&](const char* rows, const VectorXd& levels) {
    form.warnings.push_back(fmt::format(
        "the form error of {} ends at the end of its grid ({:.3g} %): the model is further off than any that was tried", rows,
        100.0 * levels[levels.size() - 1]));
  };
  if (form.frequency.at_end) warn("frequencies", grid.frequency);
  if (form.shape.at_end) warn("shapes", grid.shape);
}

/// A fit that starts at x, or else at the model's own values: with other causes the model may not show the measured modes at x.
Fit fit_from(const Inference& inference, const std::vector<Cause>& causes, const VectorXd& x) {
  Fit fit = inference.fit(causes, x);
  return fit.made() ? fit : inference.fit(causes, {});
}

/// Fits, intervals, residual test and gain at the level of the form error that the winning hypothesis has.
/// @param fitted  with the causes, at the level that the search used; it stands where no fit can be made at this one
void finish(const Inference& plain, const std::vector<Cause>& causes, const Fit& fitted, double without_cause,
            const DiagnoseOptions& options, std::uint64_t seed, Diagnosis& out) {
  out.with_form = std::make_shared<FeatureMap>(
      with_form_error(plain.map(), out.before.base, out.before.all.g, {out.form->frequency.level, out.form->shape.level}));
  const FeatureMap& levelled = *out.with_form;
  const Inference inference(levelled, plain.candidates());
  const auto n = static_cast<Index>(plain.map().nuisances().size());
  if (Fit before = fit_from(inference, {}, out.before.map.x.head(n)); before.made()) out.before = std::move(before);
  out.after = out.before;
  if (!causes.empty()) {
    Fit after = fit_from(inference, causes, fitted.map.x.head(n));
    out.after = after.made() ? std::move(after) : fitted;
  }
  for (std::size_t i = 0; i < out.effects.size(); ++i) {
    out.effects[i].cause = out.after.causes[i];
    out.effects[i].parameters = effect_parameters(inference, out.after, i);
    // Between states the model's error is the same in both: what is left of it is that with the causes in the model.
    const double form_error = out.effects[i].state.empty() ? without_cause : out.form->frequency.level;
    widen_for_form(out.effects[i].parameters, form_error);
    for (Rival& rival : out.effects[i].rivals) widen_for_form(rival.parameters, form_error);
    out.effects[i].sentence = sentence_of(out.effects[i]);
    out.effects[i].remedy = out.effects[i].cause.candidate->hypothesis->remedy;
  }
  out.after_extension = !out.effects.empty();
  out.localisation = location_map(inference, out.after, out.ranking);
  out.residual = residual_test(inference, out.after);
  out.on_bounds = parameters_on_bounds(levelled, out.before);
  out.gain = held_out_gain(inference, out.before, out.after, options.bootstrap, seed);
}

/// The causes that stand at the end have been fitted beside one another, and some were put in the place of others: a size that
/// was fine when its cause was taken may no longer be. What is told then cannot be named.
void object_to_size(const Effect& effect, Verdict& verdict, Ruling& ruling) {
  if (verdict != Verdict::named && verdict != Verdict::ambiguous) return;
  const std::string objection = objection_to_size(effect.cause, effect.parameters);
  if (objection.empty()) return;
  verdict = Verdict::unknown;
  ruling.reason = objection;
}

constexpr int kRoundsOfJudging = 2;

/// Causes one after another, and what the rules say of each.
class Chain {
 public:
  Chain(const FormSetting& setting, const DiagnoseOptions& options, std::uint64_t seed, const Fit& start, Diagnosis& out)
      : setting_(setting), options_(options), seed_(seed), current_(start), out_(out) {}

  void run() {
    for (int step = 0; step <= options_.most_causes; ++step)
      if (!take(step)) break;
    if (in_part_) judge_again();
    out_.verdict = verdict_;
  }
  [[nodiscard]] const std::vector<Cause>& causes() const { return causes_; }
  [[nodiscard]] const Fit& current() const { return current_; }
  [[nodiscard]] const Ruling& ruling() const { return ruling_; }
  [[nodiscard]] const FormSearch& search() const { return search_; }
  [[nodiscard]] const HypothesisEvidence& winner() const { return winner_; }
  [[nodiscard]] double without_cause() const { return without_cause_; }  ///< form error of frequencies with no cause

 private:
  struct Step {
    FormSearch search;
    std::vector<Scored> ranking;
    Weighing weighing;
    Ruling of_rules, ruling;  ///< before the guard, after it
  };

  /// Searches beside the causes that are in a fit.
  Step look(const Fit& base, const Leftover& leftover, bool always_guarded) {
    Step out;
    out.search = search_with_form(setting_, base, leftover);
    if (!out.search.weighed) {
      out.of_rules.verdict = out.ruling.verdict = Verdict::unknown;
      out.ruling.reason = "with the causes in the model some rows change too fast to be weighed";
      return out;
    }
    for (const FormEntry& entry : out.search.entries) out.ranking.push_back(scored_of(out.search, entry, setting_.informed));
    out.weighing = weighing_of(out.search, out.ranking, setting_, options_);
    out.of_rules = out.ruling = rule(out.weighing.weighed);
    if (!out.search.entries.empty() && (always_guarded || out.ruling.against_none > out.ruling.threshold)) {
      const PredictiveGain gain = predictive_gain(setting_, out.search, leftover, options_.bootstrap, seed_);
      if (always_guarded) out_.form->gain = gain;
      out.ruling = guarded(out.ruling, gain.low, out.weighing.weighed.in_all_conditions);
    }
    return out;
  }

  void begin_with(const Step& first) {
    out_.ranking = first.ranking;
    for (Scored& scored : out_.ranking) scored.log_odds /= std::max(1.0, first.weighing.weighed.chi_squared_ratio);
    out_.log_odds = first.ruling.against_none;
    out_.threshold = first.ruling.threshold;
    winner_ = first.search.none;
    without_cause_ = estimate(setting_.grid.frequency, first.search.none.frequency).level;
    verdict_ = first.ruling.verdict;
    if (first.search.entries.empty()) return;
    const Weighed& w = first.weighing.weighed;
    share_in_error_ = w.size_error * w.size_error;
    allowed_misfit_ = 1.0 + share_in_error_ * (w.none_chi_squared_ratio - 1.0);
  }

  /// Whether a cause was taken into the model.
  bool take(int number) {
    Step step = look(current_, leftover_, number == 0);
    if (!step.search.weighed) {
      if (number == 0)
        throw InputError({"", 0, "scatter"},
                         "rows are measured more exactly than 16 digits can weigh against what the model leaves open",
                         "leave frequency_floor and shape_floor at their defaults (0.001 and 0.01)");
      be_unknown(step.ruling);
      return false;
    }
    if (number == 0) begin_with(step);
    if (number > 0 && !in_part_ && is_error_of_the_first(step)) return false;
    if (number == 0 || verdict_ != Verdict::unknown) ruling_ = step.ruling;
    const bool by_a_channel = step.of_rules.verdict == Verdict::unknown && channel_first(step);
    const bool stands_out = by_a_channel || step.ruling.against_none > step.ruling.threshold;
    const bool accepted = step.ruling.verdict == Verdict::named || step.ruling.verdict == Verdict::ambiguous;
    // Between two states several parts may have changed: the first of them leaves the others unexplained. It is judged when
    // they are in the model. A wrong channel leaves what is wrong with the structure unexplained too.
    const auto goes_beside = [](const Candidate& c) { return !c.state.empty() || c.hypothesis->measurement; };
    const bool of_a_change = stands_out && goes_beside(*step.search.entries.front().candidate);
    const bool goes_on = (accepted || of_a_change) && number < options_.most_causes;
    if (step.of_rules.verdict == Verdict::unknown && !(of_a_change && goes_on)) {
      if (in_part_)
        rest_ = step.ruling;  // of causes that are still to be judged
      else
        be_unknown(step.ruling);  // a name that leaves the main change unexplained is none
    }
    search_ = std::move(step.search);
    if (number == 0 && accepted && !goes_on) {
      be_unknown(step.ruling);
      ruling_.reason = "a cause stands out, and most_causes allows none";
    }
    if (!goes_on) return false;
    if (!accept(step.ranking, step.weighing)) return false;
    if (!accepted) {
      in_part_ = true;
      if (number == 0) verdict_ = Verdict::named;  // until it is judged beside the others
    }
    if (step.ruling.verdict == Verdict::ambiguous) verdict_ = Verdict::ambiguous;
    return true;
  }

  /// Two wrong channels together look like something in the structure that explains a part of them. Where the leader leaves too
  /// much and acts in all conditions, the best fault of a channel that stands out by itself goes before it. @return whether
  /// there is one
  static bool channel_first(Step& step) {
    std::vector<FormEntry>& entries = step.search.entries;
    const double misfit = std::max(1.0, step.weighing.weighed.chi_squared_ratio);
    if (entries.front().contrast >= 0 || entries.front().candidate->hypothesis->measurement) return false;
    const auto channel = std::find_if(entries.begin(), entries.end(),
                                      [](const FormEntry& entry) { return entry.candidate->hypothesis->measurement; });
    if (channel == entries.end() || (channel->log_weight - step.search.none_weight) / misfit < RuleOptions{}.in_all)
      return false;
    const auto at = channel - entries.begin();
    std::rotate(entries.begin(), channel, channel + 1);
    std::rotate(step.ranking.begin(), step.ranking.begin() + at, step.ranking.begin() + at + 1);
    step.weighing.members = {0};
    step.weighing.weighed.members = 1;
    return true;
  }

  /// Whether what is left beside causes that stand is no more than the error of their own effect, which the model knows to
  /// `share_in_error_` of its evidence: a warning then.
  bool is_error_of_the_first(const Step& step) {
    const Weighed& w = step.weighing.weighed;
    const double misfit = std::max(1.0, w.chi_squared_ratio), most = share_in_error_ * out_.log_odds;
    const double left = std::max(step.ruling.against_none, (w.something_else - w.none) / misfit);
    if (left > most || w.none_chi_squared_ratio > std::max(RuleOptions{}.most_misfit, allowed_misfit_)) return false;
    if (step.ruling.against_none > step.ruling.threshold)
      out_.form->warnings.push_back(fmt::format(
          "beside what is named the rows show something like {}, which is no more than the error of the effect that is named",
          step.search.entries.front().candidate->id()));
    return true;
  }

  bool accept(const std::vector<Scored>& ranking, const Weighing& weighing) {
    const auto n = static_cast<Index>(setting_.plain.map().nuisances().size());
    const FormEntry& leader = search_.entries.front();
    out_.effects.push_back(effect_from(search_, ranking, weighing, ruling_, setting_));
    causes_.push_back(out_.effects.back().cause);
    // The search has moved the others too where it fitted the leader beside them.
    const bool fitted = leader.refined && leader.with.causes.size() == causes_.size();
    const Fit with = fit_from(setting_.informed, fitted ? leader.with.causes : causes_,
                              VectorXd((leader.refined ? leader.with : current_).map.x.head(n)));
    if (!with.made()) return withdraw("the best cause cannot be put into the model");
    const std::string objection =
        objection_to_size(with.causes.back(), effect_parameters(setting_.informed, with, causes_.size() - 1));
    if (!objection.empty()) return causes_.size() > 1 ? leave_out() : withdraw(objection);
    winner_ = leader.evidence;
    if (leader.contrast >= 0) leftover_ = {leader.contrast, std::max(leader.effect, leftover_.effect)};
    current_ = with;
    for (std::size_t i = 0; i < causes_.size(); ++i) causes_[i] = current_.causes[i];
    return true;
  }

  /// The cause taken last is none that counts: those before it stand. @return false
  bool leave_out() {
    out_.form->warnings.push_back("beside what is named something outside the catalogue acts like " +
                                  out_.effects.back().cluster.front());
    out_.effects.pop_back();
    causes_.pop_back();
    return false;
  }

  /// The cause taken last stands out and cannot stay: nothing is named. @return false
  bool withdraw(const std::string& reason) {
    out_.effects.pop_back();
    causes_.pop_back();
    ruling_.reason = reason;
    verdict_ = Verdict::unknown;
    return false;
  }

  /// Each cause anew beside all the others: what was taken while a part of the change was unexplained has had no fair rivals.
  /// Where that puts another cause in the place of one, those judged before it are judged once more.
  void judge_again() {
    const bool open = verdict_ != Verdict::unknown;
    bool others_now = true, any = false;
    for (int round = 0; round < kRoundsOfJudging && others_now; ++round) {
      if (open) verdict_ = Verdict::named;
      others_now = judge_each();
      any = any || others_now;
    }
    if (causes_.empty() && verdict_ == Verdict::named) verdict_ = Verdict::unknown;
    if (Fit fit = fit_from(setting_.informed, causes_, parameters_now()); fit.made()) {
      current_ = std::move(fit);
    } else {
      causes_.clear();
      out_.effects.clear();
      return;
    }
    if (any) judge_the_rest();
    if (rest_) be_unknown(*rest_);
  }

  /// @return whether a cause was left out, or replaced by another
  bool judge_each() {
    bool others_now = false;
    for (std::size_t i = 0; i < causes_.size();) {
      std::vector<Cause> others = causes_;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const Fit base = fit_from(setting_.informed, others, parameters_now());
      if (!base.made()) {
        Ruling why = ruling_;
        why.reason =
            "the best causes cannot be judged one by one: with one of them taken out the model shows none of the measured "
            "modes";
        be_unknown(why);
        ++i;
        continue;
      }
      Step step = look(base, leftover_, false);
      if (step.ruling.verdict == Verdict::unknown) be_unknown(step.ruling);
      if (!step.search.weighed) {
        ++i;
        continue;
      }
      if (step.ruling.against_none > step.ruling.threshold) {  // it stays, named or not
        search_ = std::move(step.search);
        out_.effects[i] = effect_from(search_, step.ranking, step.weighing, step.ruling, setting_);
        others_now = others_now || causes_[i].candidate != out_.effects[i].cause.candidate;
        causes_[i] = out_.effects[i].cause;
        if (verdict_ != Verdict::unknown) ruling_ = step.ruling;
        if (step.ruling.verdict == Verdict::ambiguous && verdict_ == Verdict::named) verdict_ = Verdict::ambiguous;
        ++i;
        continue;
      }
      causes_ = others;
      others_now = true;
      out_.effects.erase(out_.effects.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return others_now;
  }

  [[nodiscard]] VectorXd parameters_now() const {
    return current_.map.x.head(static_cast<Index>(setting_.plain.map().nuisances().size()));
  }

  /// What is left beside the causes that stand after they were judged.
  void judge_the_rest() {
    const Step step = look(current_, leftover_, false);
    rest_.reset();
    if (step.of_rules.verdict == Verdict::unknown || step.ruling.against_none > step.ruling.threshold) rest_ = step.ruling;
  }

  /// The first reason why nothing can be named is the one that is told.
  void be_unknown(const Ruling& why) {
    if (verdict_ != Verdict::unknown) ruling_ = why;
    verdict_ = Verdict::unknown;
  }

  const FormSetting& setting_;
  const DiagnoseOptions& options_;
  std::uint64_t seed_;
  Fit current_;
  Diagnosis& out_;
  std::vector<Cause> causes_;
  Leftover leftover_;
  Ruling ruling_;
  std::optional<Ruling> rest_;  ///< why what is left beside the causes forbids a name
  FormSearch search_;
  HypothesisEvidence winner_;
  double without_cause_ = 0.0;
  double share_in_error_ = 0.0, allowed_misfit_ = 0.0;  ///< by the error of the first cause's effect: of its nats, of chi²/dof
  Verdict verdict_ = Verdict::none;
  bool in_part_ = false;  ///< a cause was taken while the change was explained in part only
};

}  // namespace

Diagnosis diagnose_with_form(const Inference& whole, const DiagnoseOptions& options, std::uint64_t seed) {
  Diagnosis out;
  out.alpha = options.alpha;
  const FeatureMap& map = whole.map();
  const FeatureMap::Base prior = map.base(VectorXd::Zero(static_cast<Index>(map.nuisances().size())));
  const Prediction nominal = map.predict(prior, {}, false);
  out.verdict = Verdict::unknown;
  out.message = "the model predicts none of these rows";
  if (!nominal.valid) return out;
  const Inference& plain = whole;
  const FeatureMap informed_map = with_form_error(map, prior, nominal.g, level_of_fits(whole, prior, nominal.g));
  const Inference informed(informed_map, plain.candidates());
  const int dof = plain.dof();  // each shape has a free scale
  const FormSetting setting{plain, informed, dof, contrasts_of(map.features()), scale_grid()};
  out.before = first_fit(informed);
  if (!out.before.made()) {
    out.message += ": " + out.before.map.status.message;
    return out;
  }
  out.form.emplace();
  Chain chain(setting, options, seed, out.before, out);
  chain.run();
  out.form->frequency = estimate(setting.grid.frequency, chain.winner().frequency);
  out.form->shape = estimate(setting.grid.shape, chain.winner().shape);
  add_warnings(*out.form, setting.grid);
  finish(plain, chain.causes(), chain.current(), chain.without_cause(), options, seed, out);
  Ruling ruling = chain.ruling();
  for (const Effect& effect : out.effects) object_to_size(effect, out.verdict, ruling);
  out.message = message_of(out, ruling, *out.form, chain.search());
  return out;
}

}  // namespace twindeck::diagnosis
