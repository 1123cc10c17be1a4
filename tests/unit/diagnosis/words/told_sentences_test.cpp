// What is said of a diagnosis that is written by hand. Oracle: the sentences as a person reads them.
#include <gtest/gtest.h>

#include "diagnosis/words/sentences.hpp"
#include "unit/diagnosis/chain.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Diagnosis;
using diagnosis::Effect;
using diagnosis::EffectParameter;
using diagnosis::IdsInWords;
using diagnosis::PlaceWords;
using diagnosis::Sentences;
using diagnosis::Verdict;

/// Two causes at groups of a chain, whose fit is sound; the rest of the result is the test's.
class Told {
 public:
  Told() : base(diagnosed(chain, features, catalogue({"stiffness", "pol"})).result) {
    base.effects.clear();
    base.form.reset();
    base.gain = {};
    base.localisation.clear();
    soft.id = "soft";
    soft.title = "softer than modelled";
    soft.sentence = "{location} has {k} N/m of its stiffness";
    soft.remedy = "look at it";
    heavy.id = "heavy";
    heavy.title = "heavier than modelled";
    heavy.sentence = "{location} is heavy ({m.low} to {m.high})";
    for (auto& [candidate, hypothesis, location] :
         {std::tuple{&first, &soft, "group:g1"}, std::tuple{&second, &heavy, "group:g2"}}) {
      candidate->hypothesis = hypothesis;
      candidate->location = location;
      ids.add_cause(candidate->id(), hypothesis->title, places.at(location).words);
      ids.add_location(location, places.at(location).words);
    }
  }
  [[nodiscard]] static Effect effect(const diagnosis::Candidate& candidate, double probability) {
    Effect e;
    e.cause.candidate = &candidate;
    e.cluster = {candidate.id()};
    e.probability = probability;
    e.sentence = "It is " + candidate.hypothesis->id;
    e.remedy = candidate.hypothesis->remedy;
    return e;
  }
  [[nodiscard]] Sentences said(const Diagnosis& result, const std::vector<std::string>& next = {}) const {
    return diagnosis::sentences_of(*examined.inference, result, places, ids, next);
  }
  Chain chain{{.masses = 4, .modes = 3}};
  diagnosis::FeatureSet features = chain.measure(chain.as_modelled());
  Examined examined = examine(chain, features, catalogue({"stiffness", "pol"}));
  PlaceWords places{nullptr, chain.structure().system->dofs, {}, chain.places()};
  IdsInWords ids;
  diagnosis::Hypothesis soft, heavy;
  diagnosis::Candidate first, second;
  Diagnosis base;
};

TEST(ToldSentences, IntervalsSayWhatEachEndIsKnownTo) {
  const Told told;
  Diagnosis result = told.base;
  result.verdict = Verdict::named;
  Effect e = Told::effect(told.first, 0.5);
  e.state = "repaired";
  e.parameters = {EffectParameter{"k_N_m", "N/m", 5.0, 4.0, 6.0}, EffectParameter{"Fc", "N", 5.0, 181.0, 600.0, false, true},
                  EffectParameter{"mass", "kg", 5.0, 1.0, 60.0, true}, EffectParameter{"a_b", "-", 5.0, 1.0, 60.0, true, true},
                  EffectParameter{"count", "", 2.0, 2.0, 2.0}};
  result.effects = {e};
  EXPECT_EQ(told.said(result).why,
            "It is soft (state repaired). 90 % intervals: k 4 N/m to 6 N/m; Fc at least 181 N; mass "
            "at most 60 kg; a b not known.");
}

TEST(ToldSentences, StatesAreSaidFromTheFirstOn) {
  Told told;
  told.first.when = "from state mid on";
  told.first.further_states = {"late"};
  Diagnosis result = told.base;
  result.verdict = Verdict::named;
  Effect e = Told::effect(told.first, 0.5);
  e.state = "mid";
  result.effects = {e};
  EXPECT_EQ(told.said(result).why, "It is soft (from state mid on).");
  result.effects[0].sentence += ".";
  EXPECT_EQ(told.said(result).why, "It is soft (from state mid on).");
}

TEST(ToldSentences, WhyNamesEveryCauseOrWhatComesNearest) {
  const Told told;
  Diagnosis result = told.base;
  result.effects = {Told::effect(told.first, 0.5), Told::effect(told.second, 0.4)};
  result.verdict = Verdict::named;
  EXPECT_EQ(told.said(result).why, "Cause 1: It is soft. Cause 2: It is heavy.");
  result.verdict = Verdict::unknown;
  EXPECT_EQ(told.said(result).why,
            "Not known. What comes nearest: It is soft. Other causes beside this one: heavier than modelled at " +
                told.places.at("group:g2").words + ".");
  result.effects.pop_back();
  EXPECT_EQ(told.said(result).why, "Not known. What comes nearest: It is soft.");
  result.effects.clear();
  result.message = "misfit is left";
  EXPECT_EQ(told.said(result).why, "Misfit is left.");
  result.verdict = Verdict::none;
  EXPECT_EQ(told.said(result).why,
            "No cause is needed: the model with its parameters inside their bounds explains the measurement.");
  result.form.emplace();
  result.form->frequency.level = 0.012;
  result.form->shape.level = 0.034;
  EXPECT_EQ(
      told.said(result).why,
      "Nothing stands out of the error of the model's form, which is about 1.2 % in frequency and 3.4 % in shape. A cause "
      "that acts in every condition and changes less than that cannot be seen.");
}

TEST(ToldSentences, HowSureIsTheProbabilityWithTheRivals) {
  const Told told;
  const std::string all = "Compared with all other causes of the catalogue and with no cause, the ";
  const std::string alone = "No other cause of the catalogue comes near.";
  Diagnosis result = told.base;
  result.verdict = Verdict::named;
  result.effects = {Told::effect(told.first, 0.9951)};
  EXPECT_EQ(told.said(result).how_sure, all + "cause has probability above 0.99. " + alone);
  result.effects[0].probability = 0.9949;
  EXPECT_EQ(told.said(result).how_sure, all + "cause has probability 0.99. " + alone);
  result.effects[0].probability = 0.0049;
  EXPECT_EQ(told.said(result).how_sure, all + "cause has probability below 0.01. " + alone);
  const diagnosis::Rival heavy{told.second.id(), &told.second, 0.25, {{"m", "kg", 2.0, 1.0, 3.0}}},
      other{"other@global", nullptr, 0.125, {}};
  const std::string in_words = "heavier than modelled at " + told.places.at("group:g2").words;
  result.effects[0].probability = 0.5;
  result.effects[0].rivals = {heavy, other, heavy, other, other};
  const std::string rivals = "These data cannot tell this cause from: " + in_words +
                             ", probability 0.25 (m 1 kg to 3 kg); something else that changed, probability 0.12; " + in_words +
                             ", probability 0.25 (m 1 kg to 3 kg); and 2 more.";
  EXPECT_EQ(told.said(result).how_sure, all + "cause has probability 0.50. " + rivals);
  result.effects.push_back(Told::effect(told.second, 0.75));
  EXPECT_EQ(told.said(result).how_sure,
            all.substr(0, all.size() - 4) + "the probabilities are: cause 1, 0.50; cause 2, 0.75. Of cause 1: " + rivals);
  result.effects[0].rivals.clear();
  EXPECT_EQ(told.said(result).how_sure,
            all.substr(0, all.size() - 4) + "the probabilities are: cause 1, 0.50; cause 2, 0.75. " + alone);
}

TEST(ToldSentences, HowSureOfWhatIsNotNamedSaysWhatIsLacking) {
  const Told told;
  Diagnosis result = told.base;
  result.verdict = Verdict::none;
  result.threshold = std::log(19.0);
  for (const auto& [odds, words] : {std::pair(3.5, "3.5 to 1"), {0.025, "1 to 40"}, {1e-9, "below 1 to 1,000"}}) {
    result.log_odds = std::log(odds);
    EXPECT_EQ(told.said(result).how_sure,
              "No cause of the catalogue explains enough to be named. The odds of the best one against no cause are " +
                  std::string(words) + ", and a name needs 19 to 1.");
  }
  result.verdict = Verdict::unknown;
  result.log_odds = 363.2;
  EXPECT_EQ(
      told.said(result).how_sure,
      "No cause of the catalogue explains enough to be named. The odds of the nearest against no cause are above 1,000 to "
      "1.");
  result.effects = {Told::effect(told.first, 0.5), Told::effect(told.second, 0.4)};
  result.message = "two are alike";
  EXPECT_EQ(told.said(result).how_sure,
            "Not sure: two are alike. Compared with all other causes of the catalogue and with no cause, the first cause has "
            "probability 0.50. This cause is not the whole of what is wrong.");
  result.after_extension = true;
  result.residual.statistic = 123.4;
  result.residual.dof = 50;
  EXPECT_TRUE(told.said(result).how_sure.starts_with(
      "Not sure: with the causes in the model misfit is left (chi-squared 123 on 50 degrees of freedom). Compared"));
}

TEST(ToldSentences, TheGainIsOfHeldOutRowsOrOfModesLeftOut) {
  const Told told;
  Diagnosis result = told.base;
  EXPECT_EQ(told.said(result).how_much_better, "The model was not changed, so there is no gain to measure.");
  result.effects = {Told::effect(told.first, 0.5)};
  EXPECT_EQ(told.said(result).how_much_better, "No gain shown: no measured value was held out from the fit.");
  result.gain = {8, 2.0, 1.5, 25.0, 5.0, 40.0, "x"};
  const std::string numbers =
      "n 8 values, predicted without being fitted, the misfit goes from 2.00 to 1.50 standard deviations, 25 % less (90 % "
      "interval 5 to 40 %)";
  EXPECT_EQ(told.said(result).how_much_better, "O" + numbers + ".");
  result.gain.low_pct = 0.0;
  EXPECT_TRUE(told.said(result).how_much_better.starts_with("No gain shown: on 8 values, "))
      << told.said(result).how_much_better;
  result.gain = {8, 2.0, 2.2, -10.0, -25.0, 4.0, "x"};
  EXPECT_EQ(
      told.said(result).how_much_better,
      "No gain shown: on 8 values, predicted without being fitted, the misfit goes from 2.00 to 2.20 standard deviations, "
      "10 % more (90 % interval -4 to 25 %).");
  // Modes left out in turn: sums of squares 9 + 27 and 4 + 5 of 1 + 3 rows are 3 and 1.5 each.
  result.gain = {};
  result.form.emplace();
  result.form->gain.blocks.resize(2);
  result.form->gain.blocks[0].before = 9.0;
  result.form->gain.blocks[1].before = 27.0;
  result.form->gain.blocks[0].after = 4.0;
  result.form->gain.blocks[1].after = 5.0;
  result.form->gain.blocks[0].rows = 1;
  result.form->gain.blocks[1].rows = 3;
  result.form->gain.reduction_pct = 50.0;
  result.form->gain.low_pct = 10.0;
  result.form->gain.high_pct = 70.0;
  const diagnosis::Gain gain = diagnosis::told_gain(result);
  EXPECT_EQ(gain.rows, 4);
  EXPECT_EQ(gain.before, 3.0);
  EXPECT_EQ(gain.after, 1.5);
  EXPECT_EQ(gain.reduction_pct, 50.0);
  EXPECT_EQ(gain.low_pct, 10.0);
  EXPECT_EQ(gain.high_pct, 70.0);
  result.gain.rows = 2;  // rows that were held out win
  EXPECT_EQ(diagnosis::told_gain(result).rows, 2);
}

TEST(ToldSentences, WhatToMeasureNextIsTheMostWanted) {
  const Told told;
  Diagnosis result = told.base;
  result.verdict = Verdict::named;
  Effect e = Told::effect(told.first, 0.5);
  e.cluster = {told.first.id(), told.second.id()};
  e.split_by = "the frequency of mode 9";
  e.parameters = {{"Fc", "N", 2.0, 1.0, 3.0, false, true}, {"k", "N", 2.0, 1.0, 3.0, true, false}, {"m", "N", 2.0, 1.0, 3.0}};
  result.effects = {e};
  const std::string soft = told.ids.in_text(told.first.id()), heavy = told.ids.in_text(told.second.id());
  const auto next =
      diagnosis::measure_next(result, told.places, told.ids,
                              {{"b", "no row of type shape"}, {"a", "no stays in this model"}, {"c", "no row of type shape"}});
  EXPECT_EQ(next, (std::vector<std::string>{
                      "To tell " + soft + " from " + heavy + ": the frequency of mode 9.",
                      "Fc of " + soft + " has only a lower limit: a record in which this limit is reached would give the size.",
                      "k of " + soft + " has only an upper limit: a record in which this limit is reached would give the size.",
                      "Cannot be asked with these rows: b, c (no row of type shape)."}));
  EXPECT_EQ(told.said(result, next).next, "To tell the cause from its nearest rival, measure the frequency of mode 9.");
  result.effects.insert(result.effects.begin(), Told::effect(told.second, 0.5));
  EXPECT_EQ(told.said(result, next).next, "To tell " + soft + " from its nearest rival, measure the frequency of mode 9.");
  result.effects = {Told::effect(told.first, 0.5)};
  EXPECT_EQ(told.said(result, {next[1]}).next, next[1]);
  EXPECT_EQ(told.said(result, {next[3]}).next, "look at it.");
  EXPECT_EQ(told.said(result).next, "look at it.");
  result.verdict = Verdict::unknown;
  result.localisation = {{"group:g2", 4.0}, {"group:g1", 3.0}};
  const std::string left =
      "What is left unexplained is largest about " + told.places.at("group:g2").words +
      ". Measure the shapes at more points there, and test in a second condition (amplitude, temperature): "
      "that shows what the misfit depends on.";
  EXPECT_EQ(told.said(result).next, left);
  EXPECT_EQ(diagnosis::measure_next(result, told.places, told.ids, {}), std::vector<std::string>{left});
  result.verdict = Verdict::none;
  result.effects.clear();
  EXPECT_EQ(told.said(result).next, "Nothing more has to be measured for this question.");
  result.form.emplace();
  EXPECT_TRUE(told.said(result).next.starts_with("To see more, measure again at another temperature or amplitude"));
}

TEST(ToldSentences, PlacesAndNumbersAreInTheSentence) {
  const Told told;
  Diagnosis result = told.base;
  Effect one = Told::effect(told.first, 0.5), two = Told::effect(told.second, 0.5);
  one.parameters = {{"k", "N/m", 5.4321e6, 4e6, 6e6}};
  two.parameters = {{"m", "", 2.0, 1.23456, 3.4}};
  two.split_by = "something at group:g1";
  result.effects = {one, two};
  result.message = one.sentence;
  diagnosis::put_into_words(result, told.places, told.ids);
  const std::string g1 = told.places.at("group:g1").words, g2 = told.places.at("group:g2").words;
  EXPECT_EQ(result.effects[0].sentence, diagnosis::capitalised(g1) + " has 5.43 MN/m of its stiffness");
  EXPECT_EQ(result.effects[1].sentence, diagnosis::capitalised(g2) + " is heavy (1.23 to 3.4)");
  EXPECT_EQ(result.message, result.effects[0].sentence);
  EXPECT_EQ(result.effects[1].split_by, "something at " + g1);
}

TEST(ToldSentences, AllResidualsStayWithinTheLimitOfSidak) {
  // P(|z| <= c) = erf(c/√2): of one at 99 % it is 2.5758; of n its n-th power is 0.99.
  EXPECT_NEAR(diagnosis::sidak_limit(1), 2.5758293, 1e-6);
  for (const std::size_t n : {2u, 10u, 1000u})
    EXPECT_NEAR(std::pow(std::erf(diagnosis::sidak_limit(n) / std::sqrt(2.0)), static_cast<double>(n)), 0.99, 1e-9) << n;
}

}  // namespace
}  // namespace twindeck::tests
