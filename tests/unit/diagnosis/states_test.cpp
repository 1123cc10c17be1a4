// Two states of one structure: what changed? Oracles: a chain whose springs and masses are changed between two measurements, by
// dense matrices of its own.
#include <gtest/gtest.h>

#include <map>

#include "chain.hpp"
#include "diagnosis/form_frame.hpp"
#include "diagnosis/law_diagnosis.hpp"

namespace twindeck::tests {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Rows of two measurements, the second in state "after" with modes named by letters.
diagnosis::FeatureSet two_states(diagnosis::FeatureSet before, const diagnosis::FeatureSet& after) {
  for (auto& row : before.rows) row.held_out = false;
  before.conditions.push_back(before.conditions.front());
  before.conditions.back().name = "later";
  before.conditions.back().state = "after";
  for (auto row : after.rows) {
    row.held_out = false;
    row.condition = 1;
    row.mode = std::string(1, static_cast<char>('a' + std::stoi(row.mode) - 1));
    before.rows.push_back(row);
  }
  return before;
}

diagnosis::Diagnosis asked(const Examined& e) { return diagnosis::diagnose(*e.inference, {}, 1); }

bool in_a_set(const diagnosis::Diagnosis& result, const std::string& id) {
  return std::any_of(result.effects.begin(), result.effects.end(), [&](const diagnosis::Effect& effect) {
    return std::find(effect.cluster.begin(), effect.cluster.end(), id) != effect.cluster.end();
  });
}

TEST(States, TheFirstIsReferenceOrElseTheFirstOfTheFile) {
  diagnosis::FeatureSet f;
  for (const char* state : {"stiff", "reference", "flexible"}) {
    f.conditions.emplace_back();
    f.conditions.back().state = state;
    f.rows.push_back({diagnosis::RowType::frequency, "1", -1, "", static_cast<int>(f.conditions.size()) - 1, 1.0, 0.01, false});
  }
  EXPECT_EQ(states_of(f), (std::vector<std::string>{"reference", "stiff", "flexible"}));
  f.rows.erase(f.rows.begin() + 1);  // a state that no row was measured in is none
  EXPECT_EQ(states_of(f), (std::vector<std::string>{"stiff", "flexible"}));
}

TEST(States, PartsChangeInOneStateOrErrInAllAndSensorsAreWrongInAllOrOne) {
  const Chain chain({.masses = 6, .modes = 4});
  const auto features = two_states(chain.measure(chain.as_modelled()), chain.measure(chain.as_modelled()));
  const Examined e = examine(chain, features, catalogue({"stiffness", "mass", "gain"}));
  std::map<std::string, int> asked;
  for (const auto& candidate : e.entries.candidates) {
    if (candidate->hypothesis->id == "gain") ++asked["gain " + candidate->state];
    if (candidate->hypothesis->id == "stiffness") {
      ++asked[candidate->state];
      if (candidate->state.empty()) continue;
      EXPECT_EQ(candidate->state, "after");
      EXPECT_LE(candidate->low[0], std::log(0.005) + 1e-12);
      EXPECT_GE(candidate->high[0], std::log(20.0) - 1e-12);
    }
    if (candidate->hypothesis->id == "mass") ++asked["mass " + candidate->state];
  }
  EXPECT_EQ(asked["after"], asked[""]);
  EXPECT_EQ(asked["mass after"], asked["mass "]);
  EXPECT_EQ(asked["gain after"], asked["gain "]);
  EXPECT_EQ(asked["gain reference"], asked["gain "]);
  EXPECT_EQ(asked["mass reference"], asked["mass "]);
  EXPECT_GT(asked["mass "], 0);
  const auto contrasts = diagnosis::contrasts_of(features);
  ASSERT_EQ(contrasts.size(), 1u);
  EXPECT_EQ(contrasts[0].key, "state after");
  EXPECT_EQ(contrasts[0].weight, (VectorXd(2) << 0.0, 1.0).finished());
}

TEST(States, ModesArePairedWithinTheirState) {
  // In the second state everything is four times as stiff, so that its first mode has the frequency of the first state's
  // second.
  const Chain chain({.masses = 6, .modes = 4});
  ChainTruth stiff = chain.as_modelled();
  stiff.spring *= 4.0;
  const auto features = two_states(chain.measure(chain.as_modelled()), chain.measure(stiff));
  const Examined e = examine(chain, features, catalogue({"stiffness"}));
  const auto base = e.map->base(VectorXd::Zero(static_cast<Index>(e.map->nuisances().size())));
  const auto prediction = e.map->predict(base, {}, false);
  ASSERT_TRUE(prediction.valid);
  for (std::size_t m = 0; m < 8; ++m) EXPECT_EQ(prediction.paired[m], static_cast<int>(m % 4)) << m;
}

TEST(States, ACauseActsInItsStateAlone) {
  const Chain chain({.masses = 6, .modes = 4});
  const auto features = two_states(chain.measure(chain.as_modelled()), chain.measure(chain.as_modelled()));
  const Examined e = examine(chain, features, catalogue({"stiffness"}));
  const auto base = e.map->base(VectorXd::Zero(static_cast<Index>(e.map->nuisances().size())));
  const auto without = e.map->predict(base, {}, false);
  const auto with = e.map->predict(base, {{&e.entry("stiffness@group:g2"), VectorXd::Constant(1, std::log(3.0))}}, false);
  ChainTruth changed = chain.as_modelled();
  changed.spring[2] = 3.0;
  const auto expected = chain.measure(changed);
  for (std::size_t r = 0; r < features.rows.size(); ++r) {
    const auto at = static_cast<Index>(r);
    if (features.rows[r].condition == 0) {
      EXPECT_DOUBLE_EQ(with.g[at], without.g[at]) << r;
    } else if (features.rows[r].type == diagnosis::RowType::frequency) {
      EXPECT_NEAR(std::exp(with.g[at]) / expected.rows[r - features.rows.size() / 2].value, 1.0, 1e-6) << r;
    }
  }
}

TEST(States, NothingChangedIsNone) {
  const Chain chain({.masses = 10, .modes = 6});
  for (unsigned i = 0; i < 4; ++i) {
    std::mt19937_64 random(60 + i);
    const ChainTruth truth = chain.scattered(random);
    const auto result =
        asked(examine(chain, two_states(chain.measure(truth, &random), chain.measure(truth, &random)), catalogue()));
    EXPECT_EQ(result.verdict, diagnosis::Verdict::none) << i << ": " << result.message;
  }
}

TEST(States, FindsWhatWasCut) {
  const Chain chain({.masses = 10, .modes = 6});
  std::mt19937_64 random(7);
  const ChainTruth before = chain.scattered(random);
  ChainTruth after = before;
  after.spring[6] *= 0.4;
  const Examined e = examine(chain, two_states(chain.measure(before, &random), chain.measure(after, &random)), catalogue());
  const auto result = asked(e);
  ASSERT_FALSE(result.effects.empty()) << result.message;
  EXPECT_TRUE(in_a_set(result, "stiffness@group:g6"));
  EXPECT_EQ(result.effects.front().cause.candidate->state, "after");
  EXPECT_NE(result.verdict, diagnosis::Verdict::none);
  if (result.effects.front().cause.candidate->id() == "stiffness@group:g6") {
    EXPECT_LT(result.effects.front().parameters[0].low, 0.4);
    EXPECT_GT(result.effects.front().parameters[0].high, 0.4);
  }
}

// Sensors were taken down and mounted again: one is the wrong way round since, or its gain is another one.
TEST(States, AFaultOfASensorSinceOneStateIsNoChangeOfTheStructure) {
  const Chain chain({.masses = 10, .modes = 6});
  for (const double factor : {-1.0, 1.4}) {
    for (const char* state : {"reference", "after"}) {
      std::mt19937_64 random(9);
      const ChainTruth truth = chain.scattered(random);
      diagnosis::FeatureSet before = chain.measure(truth, &random), after = chain.measure(truth, &random);
      for (diagnosis::Row& row : (std::string(state) == "after" ? after : before).rows)
        if (row.channel == 4) row.value *= factor;
      const Examined e = examine(chain, two_states(before, after), catalogue());
      const auto result = asked(e);
      ASSERT_EQ(result.effects.size(), 1U) << factor << " in " << state << ": " << result.message;
      const diagnosis::Effect& effect = result.effects.front();
      const std::string id = factor < 0.0 ? "pol@channel:c5" : "gain@channel:c5";
      EXPECT_EQ(effect.cause.candidate->id(), id) << result.message;
      EXPECT_EQ(effect.cause.candidate->state, state) << factor;
      if (factor < 0.0) continue;
      EXPECT_LT(effect.parameters[0].low, factor);
      EXPECT_GT(effect.parameters[0].high, factor);
    }
  }
}

// 300 kg where the least that counts as a mass is 500 kg.
TEST(States, ASizeAtItsLeastIsNotNamed) {
  const Chain chain({.masses = 10, .modes = 6});
  std::mt19937_64 random(8);
  const ChainTruth light = chain.scattered(random);
  ChainTruth heavy = light;
  heavy.mass[3] += 300.0;
  std::vector<diagnosis::Hypothesis> masses = catalogue({"mass"});
  masses.front().unknowns.front().low = {0.05, "total_mass", 0};
  masses.front().unknowns.front().start = {{0.08, "total_mass", 0}};
  const auto result =
      asked(examine(chain, two_states(chain.measure(light, &random), chain.measure(heavy, &random)), std::move(masses)));
  EXPECT_EQ(result.verdict, diagnosis::Verdict::unknown) << result.message;
  EXPECT_TRUE(result.effects.empty() || result.message.find("as small as it can be") != std::string::npos) << result.message;
}

TEST(States, FindsWhatWasAddedAndWhatWasTakenAway) {
  const Chain chain({.masses = 10, .modes = 6});
  std::mt19937_64 random(8);
  const ChainTruth light = chain.scattered(random);
  ChainTruth heavy = light;
  heavy.mass[3] += 700.0;
  const auto lighter = chain.measure(light, &random), heavier = chain.measure(heavy, &random);
  const Examined more = examine(chain, two_states(lighter, heavier), catalogue());
  const auto added = asked(more);
  ASSERT_FALSE(added.effects.empty()) << added.message;
  EXPECT_TRUE(in_a_set(added, "mass@node:4"));
  const Examined less = examine(chain, two_states(heavier, lighter), catalogue());
  const auto taken = asked(less);
  ASSERT_FALSE(taken.effects.empty()) << taken.message;
  EXPECT_TRUE(in_a_set(taken, "mass@node:4"));
  EXPECT_EQ(added.effects.front().cause.candidate->state, "after");
  EXPECT_EQ(taken.effects.front().cause.candidate->state, "reference");
}

/// Rows of a further measurement, in state "late".
diagnosis::FeatureSet with_late(diagnosis::FeatureSet states, const diagnosis::FeatureSet& late) {
  const std::size_t rows = states.rows.size();
  diagnosis::FeatureSet out = two_states(std::move(states), late);
  out.conditions.back().name = "late";
  out.conditions.back().state = "late";
  for (std::size_t r = rows; r < out.rows.size(); ++r) out.rows[r].condition = 2;
  return out;
}

TEST(States, OfThreeHaveAContrastFromEachOnAndOfEach) {
  const Chain chain({.masses = 6, .modes = 4});
  const auto sound = chain.measure(chain.as_modelled());
  const auto features = with_late(two_states(sound, sound), sound);
  const Examined e = examine(chain, features, catalogue({"stiffness", "mass"}));
  const auto contrasts = diagnosis::contrasts_of(features);
  ASSERT_EQ(contrasts.size(), 3u);
  EXPECT_EQ(contrasts[2].key, "from state after on");
  EXPECT_EQ(contrasts[2].weight, Eigen::Vector3d(0.0, 1.0, 1.0));
  // A cause is asked with the contrast that it makes, whichever side of it.
  const std::map<std::string, int> expected = {{"state after", 0},       {"state late", 1},      {"from state after on", 2},
                                               {"before state late", 1}, {"state reference", 2}, {"", -1}};
  for (const auto& candidate : e.entries.candidates)
    EXPECT_EQ(diagnosis::contrast_of(*candidate, contrasts), expected.at(candidate->when)) << candidate->key();
}

TEST(States, FindsWhatWasCutAndStaysCut) {
  // Oracle: the spring that was cut before the second measurement, and not mended before the third.
  const Chain chain({.masses = 10, .modes = 6});
  std::mt19937_64 random(7);
  const ChainTruth before = chain.scattered(random);
  ChainTruth after = before;
  after.spring[6] *= 0.4;
  const auto features =
      with_late(two_states(chain.measure(before, &random), chain.measure(after, &random)), chain.measure(after, &random));
  const Examined e = examine(chain, features, catalogue());
  const auto result = asked(e);
  ASSERT_FALSE(result.effects.empty()) << result.message;
  EXPECT_TRUE(in_a_set(result, "stiffness@group:g6"));
  EXPECT_EQ(result.effects.size(), 1U);
  EXPECT_EQ(result.effects.front().cause.candidate->when, "from state after on");
  EXPECT_EQ(result.effects.front().state, "after");
}

TEST(States, FindsSeveralPartsThatChangedTogether) {
  // Three storeys, all several times stiffer afterwards: frequencies more than double.
  const Chain chain({.masses = 3, .modes = 3, .parameters = true, .frequency_std = 0.002});
  std::mt19937_64 random(9);
  const ChainTruth before = chain.scattered(random);
  ChainTruth after = before;
  const VectorXd ratio = (VectorXd(4) << 4.6, 5.7, 6.1, 1.0).finished();
  after.spring = before.spring.cwiseProduct(ratio);
  const Examined e = examine(chain, two_states(chain.measure(before, &random), chain.measure(after, &random)),
                             catalogue({"stiffness", "gain", "pol"}));
  const auto result = asked(e);
  EXPECT_NE(result.verdict, diagnosis::Verdict::none) << result.message;
  for (int storey = 0; storey < 3; ++storey) {
    const std::string id = "stiffness@group:g" + std::to_string(storey);
    bool found = false;
    for (const auto& effect : result.effects) {
      if (effect.cause.candidate->id() != id) continue;
      found = true;
      EXPECT_LT(effect.parameters[0].low, ratio[storey]) << id;
      EXPECT_GT(effect.parameters[0].high, ratio[storey]) << id;
    }
    EXPECT_TRUE(found) << id << ": " << name_of(result.verdict) << ", " << result.message;
  }
}

}  // namespace
}  // namespace twindeck::tests
