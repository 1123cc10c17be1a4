#include "diagnosis/law_diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/statistics.hpp"
#include "diagnosis/form_base.hpp"
#include "diagnosis/form_frame.hpp"
#include "diagnosis/inference/one_verdict.hpp"
#include "diagnosis/law_gain.hpp"
#include "diagnosis/law_openings.hpp"
#include "diagnosis/law_search.hpp"
#include "diagnosis/size_of_a_cause.hpp"
#include "diagnosis/splitting_measurement.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kUnitOfKinks = 0.0025;  // [-] of a scale of 1 (law_frame.hpp)
constexpr double kFarOff = 0.08;         // error of frequencies above which a warning is given
constexpr double kErrorOfSizes = 0.25;   // deviation of ln(size): error of a size by an inaccurate model

Scored as_scored(const LawSearch& search, const LawAccount& account, const Inference& informed) {
  const LawEntry& entry = search.entries[static_cast<std::size_t>(account.members.front())];
  Scored out;
  out.candidate = entry.candidate;
  out.a = account.causes.front().a;
  out.log_odds = account.log_weight - search.nothing.log_weight;
  out.screen = std::max(0.0, 2.0 * (account.log_weight - account.log_prior - search.nothing.log_weight));
  out.remaining = account.evidence.chi_squared;
  out.fitted = account.refined();
  if (out.a.size() == entry.candidate->low.size()) out.signature = informed.signature(search.base, *entry.candidate, out.a);
  if (out.signature.size() == 0) out.signature = VectorXd::Zero(std::ssize(informed.training()));
  return out;
}

/// Posterior of a scale: its mode in ln tau and two quantiles of Laplace's approximation.
ScaleEstimate estimate_of(const LawEvidence& evidence, int index, double unit = kUnitOfClasses) {
  const double level = unit * evidence.tau[index], reach = std::exp(kReachOfNinety * evidence.deviation[index]);
  return {level, level / reach, level * reach};
}

std::vector<ErrorClass> classes_in_words(const LawEvidence& evidence, const std::vector<Contrast>& contrasts) {
  std::vector<ErrorClass> out;
  const auto add = [&](int index, const std::string& name, const std::string& unit, double scale) {
    if (evidence.tau[index] > 0.0) out.push_back({name, unit, estimate_of(evidence, index, scale)});
  };
  add(kFrequencies, "frequencies", "of each mode's frequency", kUnitOfClasses);
  add(kShapes, "shapes", "of the stiffness, at random in the model's modes", kUnitOfClasses);
  add(kKinks, "channels of shapes", "of a shape's norm at each channel", kUnitOfKinks);
  add(kGains, "gains", "of each channel's gain", kUnitOfClasses);
  add(kElements, "elements", "of the stated scatter of elements", 1.0);
  for (std::size_t c = 0; c < contrasts.size(); ++c)
    add(kFirstContrast + static_cast<int>(c), "changes with " + contrasts[c].key, "of frequencies and shapes together",
        kUnitOfClasses);
  return out;
}

/// A fit that starts at x, or else at the model's own values.
Fit fit_near(const Inference& inference, const std::vector<Cause>& causes, const VectorXd& x) {
  Fit fit = inference.fit(causes, x);
  return fit.made() ? fit : inference.fit(causes, {});
}

class ByLaw {
 public:
  ByLaw(const LawSetting& setting, const DiagnoseOptions& options, std::uint64_t seed, Diagnosis& out)
      : setting_(setting), options_(options), seed_(seed), out_(out) {}

  void run() {
    search_ = search_by_law(setting_, out_.before);
    if (!search_.weighed)
      throw InputError({"", 0, "scatter"},
                       "rows are measured more exactly than 16 digits can weigh against what the model leaves open",
                       "leave frequency_floor and shape_floor at their defaults (0.001 and 0.01)");
    std::erase_if(search_.accounts,
                  [&](const LawAccount& account) { return std::ssize(account.members) > std::max(options_.most_causes, 1); });
    part_model_errors();
    for (const LawAccount& account : search_.accounts)
      if (account.members.size() == 1) out_.ranking.push_back(as_scored(search_, account, setting_.informed));
    reach_verdict();
  }

  /// Whether the last fit finds a member of the set in the model without a size of its own. The remaining accounts are then
  /// judged anew.
  [[nodiscard]] bool leaves_out_taken_set() {
    if (out_.effects.size() < 2 || objection().empty()) return false;
    leave_out(taken_);
    out_.effects.clear();
    causes_.clear();
    out_.form->warnings.clear();
    reach_verdict();
    return true;
  }
  [[nodiscard]] const LawSearch& search() const { return search_; }
  [[nodiscard]] const std::vector<Cause>& causes() const { return causes_; }
  [[nodiscard]] const Fit& fitted() const { return fitted_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] const LawEvidence& winner() const { return winner_; }
  [[nodiscard]] const std::vector<int>& opened() const { return opened_; }  ///< modes that are none of the model's

  /// Makes the verdict `unknown` if the last fit objects to the sizes.
  void refuse_sizes() {
    const std::string found = objection();
    if (found.empty()) return;
    out_.verdict = Verdict::unknown;
    reason_ = found;
  }

 private:
  [[nodiscard]] std::string objection() const {
    for (const Effect& effect : out_.effects)
      if (std::string found = objection_to_size(effect.cause, effect.parameters); !found.empty()) return found;
    return {};
  }

  void leave_out(const std::vector<int>& members) {
    std::erase_if(search_.accounts, [&](const LawAccount& account) { return account.members == members; });
  }

  void reach_verdict() {
    while (!judge_the_rest()) {
    }
    tell_model_errors();
    out_.form->frequency = estimate_of(winner_, kFrequencies);
    out_.form->shape = estimate_of(winner_, kShapes);
    out_.form->classes = classes_in_words(winner_, setting_.contrasts);
    if (out_.form->frequency.level > kFarOff)
      out_.form->warnings.push_back(
          fmt::format("the model is {:.0f} % off in frequency: too far to see small causes; a finer mesh, or fewer modes "
                      "(band.highest of s3_identification), may bring it nearer",
                      100.0 * out_.form->frequency.level));
  }

  [[nodiscard]] bool is_model_error(int member) const {
    return diagnosis::is_model_error(setting_, search_.entries[static_cast<std::size_t>(member)]);
  }

  /// Judges the remaining accounts and puts the causes into the model. @return false if the set in the model has a member
  /// without a size of its own; that set is then left out
  [[nodiscard]] bool judge_the_rest() {
    leave_out_refused_sets();
    out_.probability = 1.0 - judgement_.nothing;
    out_.log_odds = judgement_.log_odds;
    out_.threshold = std::log(kSetProbability / (1.0 - kSetProbability));
    out_.verdict = judgement_.verdict;
    winner_ = search_.nothing.evidence;
    opened_ = search_.nothing.opened;
    reason_ = reason_of_verdict();
    refuse_nil();
    guard();
    if (out_.verdict != Verdict::named && out_.verdict != Verdict::ambiguous) return true;
    if (options_.most_causes > 0) return accept();
    out_.verdict = Verdict::unknown;
    reason_ = "a cause stands out, and most_causes allows none";
    return true;
  }

  /// Separates errors of the model: causes that act equally in all states are no change.
  void part_model_errors() {
    const auto first = std::stable_partition(search_.accounts.begin(), search_.accounts.end(), [&](const LawAccount& account) {
      return !std::ranges::all_of(account.members, [&](int m) { return is_model_error(m); });
    });
    search_.model_errors.assign(std::make_move_iterator(first), std::make_move_iterator(search_.accounts.end()));
    search_.accounts.erase(first, search_.accounts.end());
  }

  [[nodiscard]] double weight_of_nothing() const {
    std::vector<double> terms = {search_.nothing.log_weight};
    for (const LawAccount& account : search_.model_errors) terms.push_back(account.log_weight);
    return log_sum(terms);
  }

  /// Verdict without a cause: `unknown` if the rows show that something changed, else `none`.
  [[nodiscard]] Verdict without_a_cause() const {
    const double nothing = weight_of_nothing();
    return std::ranges::any_of(search_.else_weight, [&](double w) { return w > nothing; }) ? Verdict::unknown : Verdict::none;
  }

  void judge_accounts() {
    std::vector<PossibleAnswer> answers;
    // Where no account was worth a fit, none is an answer: their weights at the base are not those of "nothing" at its own fit.
    const bool any = std::ranges::any_of(search_.accounts, &LawAccount::scored);
    for (const LawAccount& account : search_.accounts)
      answers.push_back({any ? account.log_weight : LawEvidence{}.log_evidence, false});
    for (const double w : search_.else_weight) answers.push_back({w, true});
    judgement_ = judge(weight_of_nothing(), answers);
  }

  [[nodiscard]] bool has_objection(const Fit& fit) const {
    for (std::size_t c = 0; c < fit.causes.size(); ++c)
      if (!objection_to_size(fit.causes[c], effect_parameters(setting_.informed, fit, c)).empty()) return true;
    return false;
  }

  /// Leaves out sets in which one cause has no size of its own or adds no prediction. The next accounts are judged without
  /// them. A single cause with an objection makes the verdict `unknown` (refuse_sizes).
  void leave_out_refused_sets() {
    judge_accounts();
    const auto refused = [&] {
      if (search_.accounts.empty() || judgement_.verdict == Verdict::none) return false;
      const LawAccount& leader = search_.accounts.front();
      if (leader.members.size() < 2 || !leader.refined()) return false;
      if (has_objection(leader.with)) return true;
      return !each_cause_predicts(setting_, search_, leader, options_.bootstrap, seed_);
    };
    while (refused()) {
      search_.accounts.erase(search_.accounts.begin());
      judge_accounts();
    }
  }

  /// Refuses a single cause if the interval of its size includes zero.
  void refuse_nil() {
    if (out_.verdict != Verdict::named && out_.verdict != Verdict::ambiguous) return;
    const LawAccount& leader = search_.accounts.front();
    if (!leader.refined() || leader.with.causes.size() != 1 ||
        !may_be_zero(effect_parameters(setting_.informed, leader.with, 0), *leader.with.causes.front().candidate))
      return;
    reason_ = "the size of the best cause cannot be told from zero";
    out_.verdict = without_a_cause();
  }

  [[nodiscard]] std::string reason_of_verdict() const {
    if (out_.verdict == Verdict::none) return "nothing stands out of the form error";
    if (out_.verdict == Verdict::unknown) return "something changed that no cause of the catalogue explains";
    return "one cause or a set of causes stands out";
  }

  void guard() {
    if (search_.accounts.empty() || !search_.accounts.front().scored) return;
    out_.form->gain = gain_by_law(setting_, search_, options_.bootstrap, seed_);
    out_.form->held_out = held_out_modes(setting_, search_);
    if (out_.verdict != Verdict::named && out_.verdict != Verdict::ambiguous) return;
    const std::vector<int>& members = search_.accounts.front().members;
    // A fault of a channel appears in all modes, and any of them shows it to the class of gains. So leaving out one mode is no
    // test.
    const bool of_channels = std::ranges::all_of(
        members, [&](int m) { return is_of_a_channel(*search_.entries[static_cast<std::size_t>(m)].candidate); });
    if (out_.form->gain.low > 0.0 || out_.form->gain.blocks.empty() || of_channels) return;  // load tests alone have no block
    out_.verdict = without_a_cause();
    reason_ = "the best cause does not predict modes that it was not fitted to";
  }

  /// Puts the leading set into the answer: one effect for each cause, with its rivals. @return false if the leading set was
  /// refused and left out
  [[nodiscard]] bool accept() {
    std::vector<const LawAccount*> set;
    std::vector<double> probability;
    double something_else = 0.0;
    for (const int i : judgement_.set) {
      const double p = judgement_.probability[static_cast<std::size_t>(i)];
      if (i < static_cast<int>(search_.accounts.size())) {
        set.push_back(&search_.accounts[static_cast<std::size_t>(i)]);
        probability.push_back(p);
      } else {
        something_else += p;
      }
    }
    const LawAccount& leader = account_to_take(set);
    if (!put_into_model(leader)) return true;
    if (leader.members.size() > 1 && has_objection(fitted_)) {
      leave_out(taken_);
      return false;
    }
    std::vector<Slot> slots;
    for (const int m : leader.members)
      if (!is_model_error(m)) slots.push_back({{m}, {0.0}});
    for (std::size_t k = 0; k < set.size(); ++k) place(*set[k], probability[k], slots);
    for (std::size_t c = 0; c < slots.size(); ++c) out_.effects.push_back(effect_of_slot(slots[c], c, set));
    if (judgement_.something_else_in_set)
      for (Effect& effect : out_.effects) {
        effect.cluster.emplace_back("other@global");
        effect.rivals.push_back({"other@global", nullptr, something_else, {}});
      }
    if (std::ranges::all_of(slots, [](const Slot& slot) { return slot.members.size() == 1; }) &&
        !judgement_.something_else_in_set)
      out_.verdict = Verdict::named;
    return true;
  }

  /// Reports errors of the model in all states, with or without a change.
  void tell_model_errors() {
    const LawAccount* account = out_.verdict == Verdict::none ? leading_model_error(search_)
                                : out_.effects.empty()        ? nullptr
                                                              : &search_.accounts.front();
    if (account == nullptr || !account->refined()) return;
    for (std::size_t c = 0; c < account->members.size(); ++c) {
      if (!is_model_error(account->members[c])) continue;
      Effect effect;
      effect.cause = account->with.causes[c];
      effect.parameters = effect_parameters(setting_.informed, account->with, c);
      widen_sizes(effect.parameters, kErrorOfSizes);
      out_.form->warnings.push_back("the model errs in all states alike: " + sentence_of(effect));
    }
  }

  [[nodiscard]] bool put_into_model(const LawAccount& leader) {
    const auto n = static_cast<Index>(setting_.plain.map().nuisances().size());
    std::vector<Cause> changes;
    for (std::size_t c = 0; c < leader.members.size(); ++c)
      if (!is_model_error(leader.members[c])) changes.push_back(leader.causes[c]);
    Fit with;
    const FeatureMap map = with_open(setting_.informed.map(), leader.opened);
    if (leader.scored)
      with = fit_near(Inference(map, setting_.informed.candidates()), changes,
                      VectorXd((leader.refined() ? leader.with : search_.base).map.x.head(n)));
    if (!with.made()) {
      out_.verdict = Verdict::unknown;
      reason_ = "the best cause cannot be put into the model";
      return false;
    }
    winner_ = leader.evidence;
    opened_ = leader.opened;
    causes_ = with.causes;
    taken_ = leader.members;
    fitted_ = std::move(with);
    return true;
  }

  /// One cause of the answer: its possible entries, the leader's first, with their probabilities.
  struct Slot {
    std::vector<int> members;
    std::vector<double> probability;
  };

  /// Adds the probability of a set to the slots of its members. A member without a slot goes to a free one.
  void place(const LawAccount& account, double probability, std::vector<Slot>& slots) const {
    std::vector<bool> taken(slots.size(), false);
    std::vector<int> strange;
    for (const int m : account.members) {
      bool found = is_model_error(m);
      for (std::size_t s = 0; s < slots.size() && !found; ++s) {
        const auto at = std::ranges::find(slots[s].members, m);
        if (at == slots[s].members.end() || taken[s]) continue;
        slots[s].probability[static_cast<std::size_t>(at - slots[s].members.begin())] += probability;
        taken[s] = found = true;
      }
      if (!found) strange.push_back(m);
    }
    std::size_t next = 0;
    for (std::size_t s = 0; s < slots.size() && next < strange.size(); ++s) {
      if (taken[s]) continue;
      slots[s].members.push_back(strange[next++]);
      slots[s].probability.push_back(probability);
    }
  }

  [[nodiscard]] Effect effect_of_slot(const Slot& slot, std::size_t which, const std::vector<const LawAccount*>& set) const {
    Effect effect;
    effect.cause = causes_[which];
    effect.state = effect.cause.candidate->state;
    effect.log_odds = judgement_.log_odds;
    effect.probability = slot.probability.front();
    std::vector<const Scored*> members;
    for (std::size_t i = 0; i < slot.members.size(); ++i) {
      const Candidate* candidate = search_.entries[static_cast<std::size_t>(slot.members[i])].candidate;
      const auto scored = std::ranges::find_if(out_.ranking, [&](const Scored& s) { return s.candidate == candidate; });
      if (scored != out_.ranking.end()) members.push_back(&*scored);
      effect.cluster.push_back(candidate->id());
      if (i == 0) continue;
      Rival rival{candidate->id(), candidate, slot.probability[i], {}};
      for (const LawAccount* account : set) {
        if (!account->refined() || !rival.parameters.empty()) continue;
        for (std::size_t c = 0; c < account->with.causes.size(); ++c)
          if (account->with.causes[c].candidate == candidate)
            rival.parameters = effect_parameters(setting_.informed, account->with, c);
      }
      effect.rivals.push_back(std::move(rival));
    }
    effect.split_by = splitting_measurement(setting_.plain, search_.base, members);
    return effect;
  }

  const LawSetting& setting_;
  const DiagnoseOptions& options_;
  std::uint64_t seed_;
  Diagnosis& out_;
  LawSearch search_;
  Judgement judgement_;
  LawEvidence winner_;
  std::vector<int> opened_;
  std::vector<Cause> causes_;
  std::vector<int> taken_;  ///< entries of the account in the model
  Fit fitted_;
  std::string reason_;
};

/// Makes fits, intervals, residual test and gain with the form error of the winning hypothesis, and with its open modes.
void finish_by_law(const Inference& plain, const ByLaw& engine, const DiagnoseOptions& options, std::uint64_t seed,
                   Diagnosis& out) {
  const FormLevel level{out.form->frequency.level, out.form->shape.level};
  out.with_form = std::make_shared<FeatureMap>(
      with_open(with_form_error(plain.map(), out.before.base, out.before.all.g, level), engine.opened()));
  const FeatureMap& levelled = *out.with_form;
  const Inference inference(levelled, plain.candidates());
  const auto n = static_cast<Index>(plain.map().nuisances().size());
  if (Fit before = fit_near(inference, {}, out.before.map.x.head(n)); before.made()) out.before = std::move(before);
  out.after = out.before;
  if (!engine.causes().empty()) {
    Fit after = fit_near(inference, engine.causes(), engine.fitted().map.x.head(n));
    out.after = after.made() ? std::move(after) : engine.fitted();
  }
  for (std::size_t i = 0; i < out.effects.size(); ++i) {
    out.effects[i].cause = out.after.causes[i];
    out.effects[i].parameters = effect_parameters(inference, out.after, i);
    widen_sizes(out.effects[i].parameters, kErrorOfSizes);
    for (Rival& rival : out.effects[i].rivals) widen_sizes(rival.parameters, kErrorOfSizes);
    out.effects[i].sentence = sentence_of(out.effects[i]);
    out.effects[i].remedy = out.effects[i].cause.candidate->hypothesis->remedy;
  }
  out.after_extension = !out.effects.empty();
  out.localisation = location_map(inference, out.after, out.ranking);
  out.residual = residual_test(inference, out.after);
  out.residual.take_total(engine.winner().chi_squared, std::ssize(plain.training()));
  out.on_bounds = parameters_on_bounds(levelled, out.before);
  out.gain = held_out_gain(inference, out.before, out.after, options.bootstrap, seed);
}

/// Reports modes that are none of the model's.
void add_open_modes(const FeatureMap& map, const ByLaw& engine, Diagnosis& out) {
  std::vector<std::string> modes;
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const MeasuredMode& mode = map.measured_modes()[m];
    const bool opened = contains(engine.opened(), static_cast<int>(m));
    if (out.after.all.paired[m] >= 0 && !opened) continue;
    modes.push_back(fmt::format("{} ({:.4g} Hz{}{})", mode.label, mode.frequency_Hz,
                                map.features().conditions.size() > 1 ? ", " : "",
                                map.features().conditions.size() > 1 ? map.features().condition_of(mode).name : ""));
  }
  if (!modes.empty())
    out.form->warnings.push_back(
        fmt::format("no mode of the model is the measured mode {}: its rows decide nothing", fmt::join(modes, ", ")));
}

std::string message_by_law(const Diagnosis& out, const ByLaw& engine) {
  if (out.verdict == Verdict::named || out.verdict == Verdict::ambiguous) return out.effects.front().sentence;
  const auto& modes = out.with_form->measured_modes();
  const bool shapes = std::ranges::any_of(modes, [](const MeasuredMode& mode) { return !mode.real_rows.empty(); });
  const std::string scales =
      fmt::format("the model's form is off by about {:.1f} % in frequency{}", 100.0 * out.form->frequency.level,
                  shapes ? fmt::format(" and {:.1f} % in shape", 100.0 * out.form->shape.level) : "");
  if (out.verdict == Verdict::none)
    return fmt::format("nothing found: {} ({}). A cause that acts in every condition and changes less than that cannot be seen",
                       engine.reason(), scales);
  std::string text = engine.reason() + " (" + scales + ")";
  if (!out.effects.empty())
    text += "; it acts like " + out.effects.front().cluster.front();
  else if (!out.ranking.empty() && out.ranking.front().log_odds > out.threshold)
    text += "; it acts like " + out.ranking.front().candidate->id();
  return text;
}

}  // namespace

Diagnosis diagnose(const Inference& whole, const DiagnoseOptions& options, std::uint64_t seed) {
  Diagnosis out;
  const FeatureMap& map = whole.map();
  const FeatureMap::Base prior = map.base(map.standing());
  const Prediction nominal = map.predict(prior, {}, false);
  out.verdict = Verdict::unknown;
  out.message = "the model predicts none of these rows";
  if (!nominal.valid) return out;
  const Inference& plain = whole;
  const std::vector<Contrast> contrasts = contrasts_of(map.features());
  const FeatureMap informed_map = with_form_error(map, prior, nominal.g, level_of_fits(whole, prior, nominal.g));
  const Inference informed(informed_map, plain.candidates());
  const LawSetting setting{plain, informed, contrasts, options.static_odds, options.progress};
  out.before = first_fit(plain, informed);
  if (!out.before.made()) {
    out.message += ": " + out.before.map.status.message;
    return out;
  }
  out.form.emplace();
  ByLaw engine(setting, options, seed, out);
  engine.run();
  do finish_by_law(plain, engine, options, seed, out);
  while (engine.leaves_out_taken_set());
  engine.refuse_sizes();
  add_open_modes(map, engine, out);
  out.message = message_by_law(out, engine);
  return out;
}

}  // namespace twindeck::diagnosis
