#include "diagnosis/bar_stays_effect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/lists.hpp"
#include "core/statistics.hpp"

namespace twindeck::diagnosis {

namespace {

const char* const kMeasured = "modes_measured";
const char* const kBefore = "modes_explained_before";
const char* const kAfter = "modes_explained_after";

/// A name that is a key of TOML wherever it stands.
std::string as_key(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

EffectParameter count(const char* name, double value) { return {name, "", value, value, value, false, false}; }

std::string sentence(const std::vector<FoundStay>& stays, const ModesExplained& before, const ModesExplained& after) {
  const auto names = each_of(stays, &FoundStay::name);
  return fmt::format(
      "Stays modelled as bars do not vibrate: {} swing{} with the deck. As cables they raise the modes explained from {} to {} "
      "of {} measured",
      fmt::join(names, ", "), names.size() == 1 ? "s" : "", before.explained, after.explained, after.measured);
}

}  // namespace

ModesExplained modes_explained(const ReducedModel& model, const FeatureSet& features, const ScatterOptions& scatter,
                               const ExplanationRule& rule) {
  const FeatureMap map(model, features, scatter);
  const auto base = map.base(map.standing());
  const Prediction prediction = map.predict(base, {}, false);
  ModesExplained out;
  for (std::size_t m = 0; m < map.measured_modes().size(); ++m) {
    const MeasuredMode& mode = map.measured_modes()[m];
    if (mode.real_rows.size() < 2 || mode.frequency < 0) continue;
    ++out.measured;
    if (prediction.paired[m] < 0 || !(prediction.mac[m] >= rule.least_mac)) continue;
    if (std::abs(std::log(prediction.frequency_Hz[m] / mode.frequency_Hz)) <= rule.within) ++out.explained;
  }
  return out;
}

BarStaysEffect::BarStaysEffect(std::vector<FoundStay> stays, double log_odds, const ModesExplained& before,
                               const ModesExplained& after)
    : stays_(std::move(stays)), hypothesis_(std::make_unique<Hypothesis>()), candidate_(std::make_unique<Candidate>()) {
  hypothesis_->id = "barstays";
  hypothesis_->title = "Stays modelled as bars do not vibrate";
  hypothesis_->set = "global";
  candidate_->hypothesis = hypothesis_.get();
  candidate_->location = "global";
  effect_.cause = {candidate_.get(), {}};
  effect_.cluster = {candidate_->id()};
  effect_.log_odds = log_odds;
  effect_.probability = 1.0 / (1.0 + std::exp(-log_odds));
  effect_.sentence = hypothesis_->sentence = sentence(stays_, before, after);
  effect_.remedy = "Model these stays in several elements, as the extended model does, and measure their frequencies.";
  effect_.parameters = {count(kMeasured, after.measured), count(kBefore, before.explained), count(kAfter, after.explained)};
  for (const FoundStay& stay : stays_)
    effect_.parameters.push_back({"force_" + as_key(stay.name) + "_N", "N", stay.force_N,
                                  stay.force_N * std::exp(-kReachOfNinety * stay.relative_std),
                                  stay.force_N * std::exp(kReachOfNinety * stay.relative_std), false, false});
}

void BarStaysEffect::put_first(Diagnosis& result) const {
  result.effects.insert(result.effects.begin(), effect_);
  if (result.verdict == Verdict::none) {
    result.verdict = Verdict::named;
    result.log_odds = effect_.log_odds;
    result.probability = effect_.probability;
    result.message = effect_.sentence + ". Beyond that nothing was found";
  } else {
    result.message = effect_.sentence + ". Beyond that: " + result.message;
  }
}

void BarStaysEffect::take_out_entries(Instantiated& entries) const {
  std::erase_if(entries.candidates, [&](const std::unique_ptr<Candidate>& entry) {
    return entry->hypothesis->does(Primitive::element_string) &&
           std::ranges::any_of(stays_, [&](const auto& stay) { return entry->location == "stay:" + stay.name; });
  });
}

std::optional<ExplainedGain> explained_gain(const Diagnosis& result) {
  for (const Effect& effect : result.effects) {
    if (effect.cause.candidate->hypothesis->id != "barstays") continue;
    ExplainedGain gain;
    for (const EffectParameter& p : effect.parameters) {
      if (p.name == kMeasured) gain.measured = p.value;
      if (p.name == kBefore) gain.before = p.value;
      if (p.name == kAfter) gain.after = p.value;
    }
    return gain;
  }
  return std::nullopt;
}

}  // namespace twindeck::diagnosis
