// What a diagnosis says, and the rivals and parameters that it tells of. Oracles: what was hidden in a chain of masses; its
// mirror image, which frequencies cannot tell from it; the residuals that residuals.csv holds; gains whose intervals lie above
// zero, or do not.
#include "diagnosis/words/sentences.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "diagnosis/model_parameters.hpp"
#include "unit/diagnosis/chain.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::IdsInWords;
using diagnosis::PlaceWords;
using diagnosis::Sentences;

/// A diagnosed chain with its words.
struct Spoken {
  Examined examined;
  diagnosis::Sentences sentences;
  std::vector<std::string> next;
};

Spoken speak(const Chain& chain, const diagnosis::FeatureSet& features, const diagnosis::DiagnoseOptions& options = {}) {
  Spoken out{diagnosed(chain, features, catalogue(), {}, options), {}, {}};
  diagnosis::Diagnosis& result = out.examined.result;
  std::vector<matching::Channel> channels;
  for (const std::string& name : features.channels) {
    matching::Channel channel;
    channel.name = name;
    channel.point = name.substr(1);
    channels.push_back(channel);
  }
  const PlaceWords places(nullptr, chain.structure().system->dofs, channels, chain.places());
  const IdsInWords ids = diagnosis::ids_in_words(places, *out.examined.inference);
  diagnosis::put_into_words(result, places, ids);
  out.next = diagnosis::measure_next(result, places, ids, out.examined.entries.invisible);
  out.sentences = diagnosis::sentences_of(*out.examined.inference, result, places, ids, out.next);
  return out;
}

TEST(Sentences, ASoftSpringIsToldWithItsPlaceSizeProbabilityAndGain) {
  const Chain chain({.masses = 8, .modes = 6});
  ChainTruth truth = chain.as_modelled();
  truth.spring[5] = 0.6;
  const Spoken spoken = speak(chain, chain.measure(truth));
  const diagnosis::Diagnosis& result = spoken.examined.result;
  ASSERT_EQ(result.verdict, diagnosis::Verdict::named);
  const auto& effect = result.effects.front();
  EXPECT_TRUE(spoken.sentences.why.starts_with("The stiffness of the group g5 is 0.")) << spoken.sentences.why;
  EXPECT_NE(spoken.sentences.why.find("90 % intervals: factor " + diagnosis::number_in_words(effect.parameters[0].low) +
                                      " to " + diagnosis::number_in_words(effect.parameters[0].high)),
            std::string::npos)
      << spoken.sentences.why;
  EXPECT_EQ(result.message, effect.sentence);
  EXPECT_GT(effect.probability, 0.98);
  EXPECT_NE(spoken.sentences.how_sure.find("the cause has probability above 0.99"), std::string::npos)
      << spoken.sentences.how_sure;
  EXPECT_NE(spoken.sentences.how_much_better.find(fmt::format("{:.0f} % less", result.gain.reduction_pct)), std::string::npos);
  // No sentence names an id alone.
  for (const std::string& text :
       {spoken.sentences.what, spoken.sentences.why, spoken.sentences.how_sure, spoken.sentences.next})
    EXPECT_EQ(text.find("group:"), std::string::npos) << text;
}

TEST(Sentences, WhatIsWrongIsTheQuantityThatIsFurthestOff) {
  // Of single rows the one with the largest residual, with the numbers of residuals.csv.
  const Chain chain({.masses = 8, .modes = 6, .shapes = false});
  for (const std::size_t row : {1u, 2u, 5u}) {
    diagnosis::FeatureSet features = chain.measure(chain.as_modelled());
    features.rows[row].value += 12.0 * features.rows[row].std;
    const Spoken spoken = speak(chain, features);
    const auto before = diagnosis::standardised_residuals(*spoken.examined.inference, spoken.examined.result.before);
    Eigen::Index worst = 0;
    const double largest = before.cwiseAbs().maxCoeff(&worst);
    const std::string& what = spoken.sentences.what;
    EXPECT_NE(what.find(fmt::format("he frequency of mode {} is measured as {} Hz", worst + 1,
                                    diagnosis::number_in_words(features.rows[static_cast<std::size_t>(worst)].value, 4))),
              std::string::npos)
        << what;
    EXPECT_NE(what.find(fmt::format(": {:.1f} standard deviations", largest)), std::string::npos) << what;
  }
}

TEST(Sentences, NothingWrongIsSaid) {
  const Chain chain({.masses = 8, .modes = 6});
  const Spoken spoken = speak(chain, chain.measure(chain.as_modelled()));
  ASSERT_EQ(spoken.examined.result.verdict, diagnosis::Verdict::none);
  EXPECT_TRUE(spoken.sentences.what.starts_with("Nothing beyond what the error of the model's form allows."));
  EXPECT_NE(spoken.sentences.how_much_better.find("no gain"), std::string::npos);
  // What cannot be asked is one line, however many families it is.
  const auto cannot = std::count_if(spoken.next.begin(), spoken.next.end(),
                                    [](const auto& line) { return line.starts_with("Cannot be asked"); });
  EXPECT_EQ(cannot, 1);
  EXPECT_NE(spoken.next.back().find("fric"), std::string::npos);
  EXPECT_TRUE(spoken.sentences.next.starts_with("To see more, measure again")) << spoken.sentences.next;
}

TEST(Sentences, MirrorImagesAreRivals) {
  // A symmetric chain seen by its frequencies alone: a soft spring is at either end, with the same probability and size. Prior
  // odds are even: seven frequencies of one state do not outweigh those of the default.
  const Chain chain({.masses = 8, .modes = 7, .shapes = false});
  ChainTruth truth = chain.as_modelled();
  truth.spring[1] = 0.4;
  diagnosis::DiagnoseOptions even;
  even.static_odds = 0.0;
  const Spoken spoken = speak(chain, chain.measure(truth), even);
  const diagnosis::Diagnosis& result = spoken.examined.result;
  ASSERT_FALSE(result.effects.empty());
  const auto& effect = result.effects.front();
  ASSERT_EQ(effect.rivals.size() + 1, effect.cluster.size());
  double sum = effect.probability;
  const diagnosis::Rival* mirror = nullptr;
  for (std::size_t i = 0; i < effect.rivals.size(); ++i) {
    EXPECT_EQ(effect.rivals[i].id, effect.cluster[i + 1]);
    sum += effect.rivals[i].probability;
    const std::string here = effect.cause.candidate->id();
    if ((here == "stiffness@group:g1" && effect.rivals[i].id == "stiffness@group:g7") ||
        (here == "stiffness@group:g7" && effect.rivals[i].id == "stiffness@group:g1"))
      mirror = &effect.rivals[i];
  }
  EXPECT_LE(sum, 1.0 + 1e-9);
  ASSERT_NE(mirror, nullptr) << effect.cause.candidate->id();
  EXPECT_NEAR(mirror->probability / effect.probability, 1.0, 0.05);
  ASSERT_EQ(mirror->parameters.size(), 1u);
  EXPECT_NEAR(mirror->parameters[0].value / effect.parameters[0].value, 1.0, 0.02);
  EXPECT_LT(mirror->parameters[0].low, mirror->parameters[0].value);
  EXPECT_GT(mirror->parameters[0].high, mirror->parameters[0].value);
  EXPECT_NE(spoken.sentences.how_sure.find("These data cannot tell this cause from: "), std::string::npos)
      << spoken.sentences.how_sure;
}

TEST(Sentences, AGainWhoseIntervalHoldsZeroIsNoneShown) {
  diagnosis::Gain gain{8, 2.0, 1.8, 11.0, -2.0, 25.0, "some"};
  EXPECT_FALSE(diagnosis::shows_gain(gain));
  gain.low_pct = 0.0;
  EXPECT_FALSE(diagnosis::shows_gain(gain));
  gain.low_pct = 1.0;
  EXPECT_TRUE(diagnosis::shows_gain(gain));
  gain.modes = {{"1", "calm", -1.0, 3.0}, {"2", "calm", 2.0, -3.0}};
  EXPECT_FALSE(diagnosis::shows_gain(gain)) << "frequencies of modes left out are further off, 3 % after 1.5 %";
  gain.modes.front().frequency_after_pct = 0.5;
  EXPECT_TRUE(diagnosis::shows_gain(gain)) << "0.25 % further off with a standard error of 0.75 %";
  gain.rows = 0;
  EXPECT_FALSE(diagnosis::shows_gain(gain));
}

TEST(Sentences, OneNumberOfOddsIsToldEverywhere) {
  const Chain chain({.masses = 8, .modes = 6});
  ChainTruth truth = chain.as_modelled();
  truth.spring[5] = 0.5;
  std::mt19937_64 random(3);
  diagnosis::FeatureSet features = chain.measure(truth, &random);
  const Examined examined = diagnosed(chain, features, catalogue());
  ASSERT_FALSE(examined.result.effects.empty());
  const auto& leader = examined.result.ranking.front();
  EXPECT_EQ(leader.candidate, examined.result.effects.front().cause.candidate);
  EXPECT_DOUBLE_EQ(examined.result.effects.front().log_odds, examined.result.log_odds);
  EXPECT_LE(leader.log_odds, examined.result.log_odds);  // of all answers together
  EXPECT_NEAR(leader.log_odds, examined.result.log_odds, -std::log(0.95));
}

TEST(ModelParameters, AreTheTruthWithinTheirIntervals) {
  // Ten chains with scattered springs: 90 % intervals hold them in 90 of 90 to 74 of 90 (binomial, one in ten thousand below
  // 72).
  const Chain chain({.masses = 8, .modes = 7});
  std::mt19937_64 random(11);
  int held = 0, all = 0;
  for (int i = 0; i < 10; ++i) {
    const ChainTruth truth = chain.scattered(random);
    const Examined examined = diagnosed(chain, chain.measure(truth, &random), catalogue({"pol"}));
    const auto parameters = diagnosis::model_parameters(*examined.inference, examined.result);
    ASSERT_EQ(parameters.size(), 9u);
    for (std::size_t p = 0; p < parameters.size(); ++p, ++all) {
      EXPECT_EQ(parameters[p].name, "g" + std::to_string(p));
      const auto& before = parameters[p].before;
      EXPECT_LE(before.low, before.value);
      EXPECT_GE(before.high, before.value);
      EXPECT_GE(before.low, 0.9 - 1e-12);
      EXPECT_LE(before.high, 1.1 + 1e-12);
      held +=
          before.low <= truth.spring[static_cast<Eigen::Index>(p)] && truth.spring[static_cast<Eigen::Index>(p)] <= before.high;
    }
  }
  EXPECT_EQ(all, 90);
  EXPECT_GE(held, 72);
}

TEST(ModelParameters, ACauseAtAParameterIsInItsValue) {
  const Chain chain({.masses = 8, .modes = 6});
  ChainTruth truth = chain.as_modelled();
  truth.spring[5] = 0.6;
  const Examined examined = diagnosed(chain, chain.measure(truth), catalogue());
  ASSERT_EQ(examined.result.effects.front().cause.candidate->id(), "stiffness@group:g5");
  const auto parameters = diagnosis::model_parameters(*examined.inference, examined.result);
  EXPECT_GE(parameters[5].before.low, 0.9 - 1e-12);  // as far as its bounds let it
  EXPECT_LE(parameters[5].after.low, 0.6);
  EXPECT_GE(parameters[5].after.high, 0.6);
  EXPECT_NEAR(parameters[5].after.value, 0.6, 0.06);
}

}  // namespace
}  // namespace twindeck::tests
