#include "diagnosis/words/sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/distributions.hpp"
#include "core/lists.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kMeasuredDigits = 4;  ///< of measured values: frequencies are known to a part in a thousand
constexpr int kOddsDigits = 2;
constexpr double kMostOdds = 1000.0;      ///< to 1; larger odds are not written as numbers
constexpr int kCountDigits = 9;           ///< of a number of rows: all of them
constexpr std::size_t kRivals = 3;        ///< rivals that are named singly
constexpr double kAlmostOne = 0.995;      ///< larger probabilities would be rounded to 1 with two digits
constexpr double kAlmostNothing = 0.005;  ///< … and smaller ones to 0

/// Rows that share a sentence: one frequency, the shape of a mode, all shapes at a sensor.
struct Block {
  std::string words;
  std::vector<std::size_t> rows;
  bool shape = false;
};

double mean_square(const Block& block, const VectorXd& residual) {
  double sum = 0.0;
  for (const std::size_t r : block.rows) sum += residual[static_cast<Index>(r)] * residual[static_cast<Index>(r)];
  return sum / static_cast<double>(block.rows.size());
}

/// Evidence of the rows of a block against their stated deviations: log likelihood ratio of the scale of n Gaussian errors
/// [nats].
double surprise(const Block& block, const VectorXd& residual) {
  const double ratio = mean_square(block, residual);
  return ratio > 1.0 ? 0.5 * static_cast<double>(block.rows.size()) * (ratio - 1.0 - std::log(ratio)) : 0.0;
}

/// What a type of row measures, before its mode, stay or sensor, and its unit.
struct Quantity {
  const char *words, *unit;
};

const Quantity& quantity_of(RowType type) {
  static constexpr Quantity in_order[] = {
      {"the frequency of mode ", "Hz"},     {"the damping ratio of mode ", "%"},      {"the shape of mode ", ""},
      {"the shape of mode ", ""},           {"the frequency of the stay ", "Hz"},     {"the RMS acceleration at ", "m/s2"},
      {"the noise floor at ", "m2/s3"},     {"the displacement under load at ", "m"}, {"the rotation under load at ", "rad"},
      {"the strain under load at ", "m/m"}, {"the support force under load at ", "N"}};
  return in_order[static_cast<std::size_t>(type)];
}

std::string quantity_words(const Row& row, const std::string& sensor) {
  const std::string words = quantity_of(row.type).words;
  if (row.type == RowType::stay_frequency) return fmt::format("{}{} (harmonic {})", words, row.stay, row.mode);
  return words + (words.ends_with("mode ") ? row.mode : sensor);
}

/// Whether a row is predicted. A held-out damping ratio is not, if the fit has no damping row of its mode, because every mode
/// has a damping ratio of its own.
bool is_predicted(const FeatureSet& features, const Row& row) {
  if (row.type != RowType::damping || !row.held_out) return true;
  return std::ranges::any_of(features.rows, [&](const Row& other) {
    return other.type == RowType::damping && !other.held_out && other.mode == row.mode;
  });
}

std::vector<Block> blocks_of(const Inference& inference, const PlaceWords& places) {
  const FeatureSet& features = inference.map().features();
  std::vector<Block> blocks;
  std::map<std::pair<int, std::string>, Block> of_mode;
  std::map<int, Block> of_sensor;
  for (std::size_t r = 0; r < features.rows.size(); ++r) {
    const Row& row = features.rows[r];
    if (!is_predicted(features, row)) continue;
    const std::string channel = row.channel >= 0 ? features.channels[static_cast<std::size_t>(row.channel)] : "";
    const std::string sensor = channel.empty() ? "" : places.at("channel:" + channel).words;
    const std::string when = features.conditions.size() > 1 ? fmt::format(" ({})", features.condition_of(row).name) : "";
    if (row.type != RowType::shape && row.type != RowType::shape_imag) {
      blocks.push_back({quantity_words(row, sensor) + when, {r}, false});
      continue;
    }
    Block& mode = of_mode[{row.condition, row.mode}];
    mode.words = quantity_words(row, sensor) + when;
    mode.rows.push_back(r);
    Block& at = of_sensor[row.channel];
    at.words = "the mode shapes at " + sensor;
    at.rows.push_back(r);
  }
  for (const auto& [key, block] : of_mode) blocks.push_back({block.words, block.rows, true});
  for (const auto& [key, block] : of_sensor) blocks.push_back({block.words, block.rows, true});
  return blocks;
}

std::string block_words(const Block& block, const Inference& inference, const Diagnosis& result, const VectorXd& before,
                        const VectorXd& after) {
  const Row& row = inference.map().features().rows[block.rows.front()];
  std::string text;
  if (block.shape) {
    text = fmt::format("{} {} off by {:.1f} standard deviations (root mean square of {} values)", block.words,
                       block.words.starts_with("the mode shapes") ? "are" : "is", std::sqrt(mean_square(block, before)),
                       block.rows.size());
  } else {
    const auto r = static_cast<Index>(block.rows.front());
    const double transformed = result.before.all.g[r],
                 computed = is_logarithmic(row.type) ? std::exp(transformed) : transformed;
    text = fmt::format("{} is measured as {} {}, the model fitted within its bounds has {} {}: {:.1f} standard deviations off",
                       block.words, number_in_words(row.value, kMeasuredDigits), quantity_of(row.type).unit,
                       number_in_words(computed, kMeasuredDigits), quantity_of(row.type).unit, std::abs(before[r]));
  }
  if (!result.effects.empty())
    text += fmt::format("; with the causes below in the model {:.1f}", std::sqrt(mean_square(block, after)));
  return text;
}

std::string what_is_wrong(const Inference& inference, const Diagnosis& result, const PlaceWords& places) {
  const VectorXd before = standardised_residuals(inference, result.before),
                 after = standardised_residuals(inference, result.after);
  const std::vector<Block> blocks = blocks_of(inference, places);
  const Block* worst = &blocks.front();
  for (const Block& block : blocks)
    if (surprise(block, before) > surprise(*worst, before)) worst = &block;
  const FeatureSet& features = inference.map().features();
  std::size_t judged = 0, beyond = 0;
  for (const Row& row : features.rows) judged += is_predicted(features, row) ? 1 : 0;
  const double limit = sidak_limit(judged);
  for (Index r = 0; r < before.size(); ++r)
    beyond += is_predicted(features, features.rows[static_cast<std::size_t>(r)]) && std::abs(before[r]) > limit ? 1 : 0;
  const std::string most = block_words(*worst, inference, result, before, after);
  if (result.verdict == Verdict::none && beyond == 0)
    return fmt::format("Nothing beyond what {} allows. The largest deviation: {}.",
                       result.form ? "the error of the model's form" : "chance", most);
  return fmt::format("{}. Of {} measured values, {} {} further off than chance allows ({:.1f} standard deviations).",
                     capitalised(most), number_in_words(static_cast<double>(judged), kCountDigits), beyond,
                     beyond == 1 ? "is" : "are", limit);
}

/// "factor 0.55 to 0.68", "Fc at least 181 N": intervals that the sentence does not contain yet.
std::string interval_words(const EffectParameter& p) {
  std::string name = p.name;
  std::string tail = "_" + p.unit;
  std::replace(tail.begin(), tail.end(), '/', '_');
  std::erase(tail, '^');
  if (name.size() > tail.size() && name.ends_with(tail)) name.resize(name.size() - tail.size());
  std::replace(name.begin(), name.end(), '_', ' ');
  const std::string low = quantity_in_words(p.low, p.unit), high = quantity_in_words(p.high, p.unit);
  if (p.at_low_bound && p.at_high_bound) return name + " not known";
  if (p.at_high_bound) return fmt::format("{} at least {}", name, low);
  if (p.at_low_bound) return fmt::format("{} at most {}", name, high);
  return fmt::format("{} {} to {}", name, low, high);
}

/// The effect's sentence, with the intervals that it does not contain.
std::string with_intervals(const Effect& effect) {
  const Candidate& candidate = *effect.cause.candidate;
  const std::string when = candidate.further_states.empty() ? "state " + effect.state : candidate.when;
  const std::string in_state = effect.state.empty() ? "" : fmt::format(" ({})", when);
  std::vector<std::string> words;
  for (const EffectParameter& p : effect.parameters) {
    const bool is_a_count = p.unit.empty() && p.low == p.high;
    if (!is_a_count && effect.cause.candidate->hypothesis->sentence.find("{" + p.name + ".low}") == std::string::npos)
      words.push_back(interval_words(p));
  }
  std::string sentence = effect.sentence;
  if (!in_state.empty() && sentence.ends_with('.')) sentence.pop_back();
  return ended(sentence + in_state) + (words.empty() ? "" : fmt::format(" 90 % intervals: {}.", fmt::join(words, "; ")));
}

std::string why_it_is(const Diagnosis& result, const IdsInWords& ids) {
  if (result.verdict == Verdict::none && result.form)
    return fmt::format(
        "Nothing stands out of the error of the model's form, which is about {:.1f} % in frequency and {:.1f} % in shape. A "
        "cause that "
        "acts in every condition and changes less than that cannot be seen.",
        100.0 * result.form->frequency.level, 100.0 * result.form->shape.level);
  if (result.verdict == Verdict::none)
    return "No cause is needed: the model with its parameters inside their bounds explains the measurement.";
  if (result.effects.empty()) return ended(capitalised(result.message));
  if (result.verdict == Verdict::unknown) {
    const std::string nearest = "Not known. What comes nearest: " + with_intervals(result.effects.front());
    std::vector<std::string> others;
    for (std::size_t i = 1; i < result.effects.size(); ++i)
      others.push_back(ids.in_text(result.effects[i].cause.candidate->id()));
    return others.empty() ? nearest : fmt::format("{} Other causes beside this one: {}.", nearest, fmt::join(others, "; "));
  }
  if (result.effects.size() == 1) return with_intervals(result.effects.front());
  std::vector<std::string> causes;
  for (std::size_t i = 0; i < result.effects.size(); ++i)
    causes.push_back(fmt::format("Cause {}: {}", i + 1, with_intervals(result.effects[i])));
  return fmt::format("{}", fmt::join(causes, " "));
}

std::string probability_words(double p) {
  if (p > kAlmostOne) return "above 0.99";
  return p < kAlmostNothing ? "below 0.01" : fmt::format("{:.2f}", p);
}

/// "40 to 1", "1 to 40", "above 1,000 to 1".
std::string odds_words(double log_odds) {
  const double most = std::log(kMostOdds), shown = std::clamp(log_odds, -most, most);
  const std::string larger = number_in_words(std::exp(std::abs(shown)), kOddsDigits);
  const std::string text = shown < 0.0 ? "1 to " + larger : larger + " to 1";
  return log_odds > most ? "above " + text : log_odds < -most ? "below " + text : text;
}

std::string rivals_words(const Effect& effect, const IdsInWords& ids) {
  if (effect.rivals.empty()) return "No other cause of the catalogue comes near.";
  std::vector<std::string> named;
  for (std::size_t i = 0; i < std::min(effect.rivals.size(), kRivals); ++i) {
    const Rival& rival = effect.rivals[i];
    const auto sizes = each_of(rival.parameters, interval_words);
    const std::string what = rival.candidate == nullptr ? "something else that changed" : ids.in_text(rival.id);
    named.push_back(fmt::format("{}, probability {}{}", what, probability_words(rival.probability),
                                sizes.empty() ? "" : fmt::format(" ({})", fmt::join(sizes, "; "))));
  }
  const std::string more = effect.rivals.size() > kRivals ? fmt::format("; and {} more", effect.rivals.size() - kRivals) : "";
  return fmt::format("These data cannot tell this cause from: {}{}.", fmt::join(named, "; "), more);
}

/// Sentence on several causes: the probability of each, and the ones that the data cannot distinguish.
std::string how_sure_of_each(const Diagnosis& result, const IdsInWords& ids) {
  std::vector<std::string> probabilities, rivals;
  for (std::size_t i = 0; i < result.effects.size(); ++i) {
    const Effect& effect = result.effects[i];
    probabilities.push_back(fmt::format("cause {}, {}", i + 1, probability_words(effect.probability)));
    if (!effect.rivals.empty()) rivals.push_back(fmt::format("Of cause {}: {}", i + 1, rivals_words(effect, ids)));
  }
  return fmt::format(
      "Compared with all other causes of the catalogue and with no cause, the probabilities are: {}. {}",
      fmt::join(probabilities, "; "),
      rivals.empty() ? "No other cause of the catalogue comes near." : fmt::format("{}", fmt::join(rivals, " ")));
}

std::string how_sure_it_is(const Diagnosis& result, const IdsInWords& ids) {
  if (result.verdict == Verdict::none)
    return fmt::format(
        "No cause of the catalogue explains enough to be named. The odds of the best one against no cause are {}, and a name "
        "needs {}.",
        odds_words(result.log_odds), odds_words(result.threshold));
  if (result.effects.empty())
    return fmt::format(
        "No cause of the catalogue explains enough to be named. The odds of the nearest against no cause are {}.",
        odds_words(result.log_odds));
  std::string text;
  if (result.verdict == Verdict::unknown)
    text =
        fmt::format("Not sure: {}. ",
                    result.after_extension && result.residual.dof > 0
                        ? fmt::format("with the causes in the model misfit is left (chi-squared {} on {} degrees of freedom)",
                                      number_in_words(result.residual.statistic), result.residual.dof)
                        : result.message);
  const Effect& first = result.effects.front();
  if (result.verdict != Verdict::unknown && result.effects.size() > 1) return how_sure_of_each(result, ids);
  text += fmt::format("Compared with all other causes of the catalogue and with no cause, the {}cause has probability {}. ",
                      result.effects.size() > 1 ? "first " : "", probability_words(first.probability));
  if (result.verdict == Verdict::unknown && first.rivals.empty()) return text + "This cause is not the whole of what is wrong.";
  return text + rivals_words(first, ids);
}

/// Mean absolute value of a member over the held-out modes, without NaN; NaN if none is left.
double mean_of(const std::vector<HeldOutMode>& modes, double HeldOutMode::*what) {
  double sum = 0.0;
  int count = 0;
  for (const HeldOutMode& mode : modes)
    if (std::isfinite(mode.*what)) {
      sum += std::abs(mode.*what);
      ++count;
    }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// Whether the mean error grows by more than its own standard error. A smaller growth may be chance.
bool frequencies_get_worse(const Gain& gain) {
  const auto n = static_cast<Eigen::Index>(gain.modes.size());
  if (n == 0) return false;
  Eigen::VectorXd growth(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const HeldOutMode& mode = gain.modes[static_cast<std::size_t>(k)];
    growth[k] = std::abs(mode.frequency_after_pct) - std::abs(mode.frequency_before_pct);
  }
  const double mean = growth.mean(), square = (growth.array() - mean).square().sum();
  return mean > (n > 1 ? std::sqrt(square / static_cast<double>(n * (n - 1))) : 0.0);
}

/// "predicted from all other modes, the frequencies of 20 modes are off by 2.1 % before and 1.2 % after on average, …"
std::string errors_of_held_out(const Gain& gain) {
  if (gain.modes.empty()) return "";
  const auto beside = [&](fmt::format_string<double&, double&> text, double HeldOutMode::*before, double HeldOutMode::*after) {
    double first = mean_of(gain.modes, before), then = mean_of(gain.modes, after);
    return std::isfinite(first) && std::isfinite(then) ? fmt::format(text, first, then) : "";
  };
  return fmt::format(
      "predicted from all other modes, the frequencies of {} are off by {:.2g} % before and {:.2g} % after on average{}{}.",
      gain.modes.size() == 1 ? "one mode" : fmt::format("{} modes", gain.modes.size()),
      mean_of(gain.modes, &HeldOutMode::frequency_before_pct), mean_of(gain.modes, &HeldOutMode::frequency_after_pct),
      beside(", damping ratios with dampers by {:.2g} % and {:.2g} %", &HeldOutMode::damping_before_pct,
             &HeldOutMode::damping_after_pct),
      beside(", their MAC is {:.2f} and {:.2f}", &HeldOutMode::mac_before, &HeldOutMode::mac_after));
}

/// "25 % less (90 % interval 5 to 40 %)"; a misfit that grows is "10 % more", its interval too.
std::string change_words(const Gain& gain) {
  const bool grows = gain.reduction_pct < 0.0;
  return fmt::format("{:.0f} % {} (90 % interval {:.0f} to {:.0f} %)", std::abs(gain.reduction_pct), grows ? "more" : "less",
                     grows ? 0.0 - gain.high_pct : gain.low_pct, grows ? 0.0 - gain.low_pct : gain.high_pct);
}

std::string how_much_better_it_is(const Diagnosis& result) {
  if (result.effects.empty()) return "The model was not changed, so there is no gain to measure.";
  const Gain gain = told_gain(result);
  if (gain.rows == 0) return "No gain shown: no measured value was held out from the fit.";
  const std::string numbers =
      fmt::format("on {} values, predicted without being fitted, the misfit goes from {:.2f} to {:.2f} standard deviations, {}",
                  number_in_words(gain.rows, kCountDigits), gain.before, gain.after, change_words(gain));
  const std::string raw = errors_of_held_out(gain);
  if (shows_gain(gain)) return fmt::format("{}.{}{}", capitalised(numbers), raw.empty() ? "" : " ", capitalised(raw));
  if (frequencies_get_worse(gain)) return fmt::format("No gain: {} {}.", raw, capitalised(numbers));
  return fmt::format("No gain shown: {}.{}{}", numbers, raw.empty() ? "" : " ", capitalised(raw));
}

std::string left_over_words(const Diagnosis& result, const PlaceWords& places) {
  return fmt::format(
      "What is left unexplained is largest about {}. Measure the shapes at more points there, and test in a second condition "
      "(amplitude, temperature): "
      "that shows what the misfit depends on.",
      places.at(result.localisation.front().location).words);
}

/// The hypothesis' own sentence, with location and numbers filled in.
std::string effect_words(const Effect& effect, const PlaceWords& places) {
  std::string text = effect.cause.candidate->hypothesis->sentence;
  const auto replace = [&](const std::string& key, const std::string& value) {
    for (auto at = text.find(key); at != std::string::npos; at = text.find(key, at + value.size()))
      text.replace(at, key.size(), value);
  };
  replace("{location}", places.at(effect.cause.candidate->location).words);
  for (const EffectParameter& p : effect.parameters) {
    for (const auto& [key, value] :
         {std::pair{p.name, p.value}, std::pair{p.name + ".low", p.low}, std::pair{p.name + ".high", p.high}}) {
      if (!p.unit.empty() && p.unit != "-")  // a number with a unit takes a prefix
        replace("{" + key + "} " + p.unit, quantity_in_words(value, p.unit));
      replace("{" + key + "}", number_in_words(value));
    }
  }
  return capitalised(text);
}

}  // namespace

double sidak_limit(std::size_t n) { return two_sided_normal_quantile(std::pow(0.99, 1.0 / static_cast<double>(n))); }

IdsInWords ids_in_words(const PlaceWords& places, const Inference& inference, const std::vector<Scored>& ranking) {
  IdsInWords ids;
  const auto add = [&](const Candidate& candidate) {
    const std::string words = places.at(candidate.location).words;
    ids.add_location(candidate.location, words);
    ids.add_cause(candidate.id(), candidate.hypothesis->title, candidate.location == "global" ? "" : words);
  };
  for (const auto& candidate : inference.candidates()) add(*candidate);
  for (const Scored& scored : ranking) add(*scored.candidate);
  for (const auto& [name, set] : inference.map().model().sets)
    for (const ReducedPlace& place : set) ids.add_location(place.id, places.at(place.id).words);
  return ids;
}

void put_into_words(Diagnosis& result, const PlaceWords& places, const IdsInWords& ids) {
  for (Effect& effect : result.effects) {
    const std::string raw = effect.sentence;
    effect.sentence = effect_words(effect, places);
    if (result.message == raw) result.message = effect.sentence;
    effect.split_by = ids.in_text(effect.split_by);
  }
  result.message = ids.in_text(result.message);
}

Gain told_gain(const Diagnosis& result) {
  if (!result.form || result.gain.rows != 0 || result.form->gain.blocks.empty()) return result.gain;
  Gain gain;
  double before = 0.0, after = 0.0;
  for (const auto& block : result.form->gain.blocks) {
    before += block.before;
    after += block.after;
    gain.rows += block.rows;
  }
  gain.held_out = "each mode in turn, in all conditions";
  gain.modes = result.form->held_out;
  gain.before = std::sqrt(before / gain.rows);
  gain.after = std::sqrt(after / gain.rows);
  gain.reduction_pct = result.form->gain.reduction_pct;
  gain.low_pct = result.form->gain.low_pct;
  gain.high_pct = result.form->gain.high_pct;
  return gain;
}

bool shows_gain(const Gain& gain) { return gain.rows > 0 && gain.low_pct > 0.0 && !frequencies_get_worse(gain); }

std::vector<std::string> measure_next(const Diagnosis& result, const PlaceWords& places, const IdsInWords& ids,
                                      const std::vector<Invisible>& invisible) {
  std::vector<std::string> next;
  for (const Effect& effect : result.effects) {
    if (effect.cluster.size() > 1 && !effect.split_by.empty())
      next.push_back(fmt::format("To tell {} from {}: {}.", ids.in_text(effect.cluster[0]), ids.in_text(effect.cluster[1]),
                                 effect.split_by));
    for (const EffectParameter& p : effect.parameters) {
      if (p.at_low_bound == p.at_high_bound) continue;
      next.push_back(fmt::format("{} of {} has only {} limit: a record in which this limit is reached would give the size.",
                                 p.name, ids.in_text(effect.cause.candidate->id()), p.at_high_bound ? "a lower" : "an upper"));
    }
  }
  if (result.verdict == Verdict::unknown && !result.localisation.empty()) next.push_back(left_over_words(result, places));
  std::map<std::string, std::vector<std::string>> lacking;
  for (const auto& none : invisible)
    if (none.reason.find("this model") == std::string::npos) lacking[none.reason].push_back(none.hypothesis);
  std::vector<std::string> cannot;
  for (const auto& [reason, families] : lacking) cannot.push_back(fmt::format("{} ({})", fmt::join(families, ", "), reason));
  if (!cannot.empty()) next.push_back(fmt::format("Cannot be asked with these rows: {}.", fmt::join(cannot, "; ")));
  return next;
}

Sentences sentences_of(const Inference& inference, const Diagnosis& result, const PlaceWords& places, const IdsInWords& ids,
                       const std::vector<std::string>& next) {
  Sentences out;
  out.what = what_is_wrong(inference, result, places);
  out.why = why_it_is(result, ids);
  out.how_sure = how_sure_it_is(result, ids);
  out.how_much_better = how_much_better_it_is(result);
  const auto rivalled =
      std::ranges::find_if(result.effects, [](const Effect& e) { return e.cluster.size() > 1 && !e.split_by.empty(); });
  const bool open = !next.empty() && !next.front().starts_with("Cannot be asked");
  if (result.verdict == Verdict::unknown && !result.localisation.empty())
    out.next = left_over_words(result, places);
  else if (rivalled != result.effects.end())
    out.next = fmt::format("To tell {} from its nearest rival, measure {}.",
                           rivalled == result.effects.begin() ? "the cause" : ids.in_text(rivalled->cluster.front()),
                           rivalled->split_by);
  else if (open)
    out.next = next.front();
  else if (!result.effects.empty())
    out.next = ended(result.effects.front().remedy);
  else if (result.form)
    out.next =
        "To see more, measure again at another temperature or amplitude, or in another state: the error of the model's form is "
        "the same in "
        "both and cancels.";
  else
    out.next = "Nothing more has to be measured for this question.";
  return out;
}

}  // namespace twindeck::diagnosis
