// Oracles: modes of five equal masses in a row, whose shapes are sines; an interval of a normal law of ln T; counts by hand.
#include "diagnosis/bar_stays_effect.hpp"

#include <gtest/gtest.h>

#include "prediction/hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::BarStaysEffect;
using diagnosis::FoundStay;
using diagnosis::RowType;
using diagnosis::Verdict;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Five equal masses in a row; shape i is sin(i j pi / 6).
class FiveInARow {
 public:
  FiveInARow() : model(nodes_in_a_row(5), springs_in_a_row(VectorXd::Constant(6, 2e6)), 1000.0 * MatrixXd::Identity(5, 5)) {}
  static double hertz(int i) {
    return 2.0 * std::sqrt(2000.0) * std::sin(i * std::numbers::pi / 12.0) / (2.0 * std::numbers::pi);
  }
  static VectorXd shape(int i) {
    VectorXd out(5);
    for (int j = 1; j <= 5; ++j) out[j - 1] = std::sin(i * j * std::numbers::pi / 6.0);
    return out;
  }
  void measure(const std::string& name, double frequency, const VectorXd& values) {
    model.add_row(RowType::frequency, name, -1, frequency, 0.01 * frequency);
    for (int c = 0; c < values.size(); ++c) model.add_row(RowType::shape, name, c, values[c], 0.02);
  }
  [[nodiscard]] std::pair<int, int> explained(double least_mac, double within) const {
    const auto found = diagnosis::modes_explained(model.reduced(), model.features, {}, {least_mac, within});
    return {found.measured, found.explained};
  }
  Predicted model;
};
using Counts = std::pair<int, int>;

TEST(ModesExplained, AreAlikeAndNearInFrequency) {
  FiveInARow five;
  five.measure("a", FiveInARow::hertz(1), FiveInARow::shape(1));
  five.measure("b", FiveInARow::hertz(2) * std::exp(0.04), FiveInARow::shape(2));
  five.measure("c", FiveInARow::hertz(3), 0.8 * FiveInARow::shape(3) + 0.6 * FiveInARow::shape(4));  // a MAC of 0.64
  EXPECT_EQ(five.explained(0.6, 0.05), Counts(3, 3));
  EXPECT_EQ(five.explained(0.6, 0.03), Counts(3, 2));
  EXPECT_EQ(five.explained(0.7, 0.05), Counts(3, 2));
  EXPECT_EQ(five.explained(0.7, 0.03), Counts(3, 1));
}

TEST(ModesExplained, CountOnlyThoseWithAShapeAndAFrequency) {
  FiveInARow five;
  five.measure("a", FiveInARow::hertz(1), FiveInARow::shape(1));
  five.measure("b", FiveInARow::hertz(2), VectorXd());
  five.measure("c", FiveInARow::hertz(3), FiveInARow::shape(3).head(1));  // one channel is like every other
  for (int c = 0; c < 5; ++c) five.model.add_row(RowType::shape, "d", c, FiveInARow::shape(4)[c], 0.02);
  EXPECT_EQ(five.explained(0.6, 0.05), Counts(1, 1));
}

TEST(ModesExplained, OneThatTheModelHasNoModeForLeavesTheOthers) {
  FiveInARow five;
  five.measure("none", 0.5 * FiveInARow::hertz(1), Eigen::Vector<double, 5>(1.0, -2.0, 0.3, 0.1, 1.0));
  for (int i = 1; i <= 5; ++i) five.measure(std::to_string(i), FiveInARow::hertz(i), FiveInARow::shape(i));
  EXPECT_EQ(five.explained(0.6, 0.05), Counts(6, 5));
}

std::vector<FoundStay> two_stays() {
  return {{"NE-8", 3, 4e5, 0.02, diagnosis::ForceSource::measured}, {"N 9", 4, 5e5, 0.10, diagnosis::ForceSource::model}};
}

diagnosis::Diagnosis with_one_effect(Verdict verdict, const diagnosis::Candidate& candidate) {
  diagnosis::Diagnosis result;
  result.verdict = verdict;
  result.message = "A bearing slips";
  result.log_odds = 5.0;
  result.effects.emplace_back();
  result.effects.back().cause.candidate = &candidate;
  return result;
}

TEST(BarStaysEffect, ComesFirstAndTellsItsCountsAndForces) {
  const HandMade other("scale.stiffness", {});
  const BarStaysEffect effect(two_stays(), std::log(9.0), {11, 6}, {11, 9});
  auto result = with_one_effect(Verdict::named, other.candidate);
  effect.put_first(result);
  ASSERT_EQ(result.effects.size(), 2u);
  EXPECT_EQ(result.effects[1].cause.candidate, &other.candidate);
  EXPECT_EQ(result.verdict, Verdict::named);
  EXPECT_EQ(result.log_odds, 5.0);  // that of what the search found
  const auto& first = result.effects[0];
  EXPECT_EQ(first.cluster, std::vector<std::string>{"barstays@global"});
  EXPECT_NEAR(first.probability, 0.9, 1e-12);  // odds of nine to one
  EXPECT_EQ(
      result.message,
      "Stays modelled as bars do not vibrate: NE-8, N 9 swing with the deck. As cables they raise the modes explained from "
      "6 to 9 of 11 measured. Beyond that: A bearing slips");
  ASSERT_EQ(first.parameters.size(), 5u);
  EXPECT_EQ(first.parameters[3].name, "force_NE_8_N");
  EXPECT_EQ(first.parameters[4].name, "force_N_9_N");
  EXPECT_EQ(first.parameters[4].unit, "N");
  for (const auto& [i, deviation] : {std::pair<std::size_t, double>{3, 0.02}, {4, 0.10}}) {  // 90 % of a normal law of ln T
    EXPECT_EQ(first.parameters[i].value, i == 3 ? 4e5 : 5e5);
    EXPECT_NEAR(std::log(first.parameters[i].high / first.parameters[i].value), 1.645 * deviation, 1e-12);
    EXPECT_NEAR(std::log(first.parameters[i].low / first.parameters[i].value), -1.645 * deviation, 1e-12);
  }
}

TEST(BarStaysEffect, IsTheNameWhereNothingElseWasFound) {
  diagnosis::Diagnosis result;
  result.message = "nothing found";
  const BarStaysEffect effect({two_stays()[0]}, 8.0, {4, 2}, {4, 4});
  effect.put_first(result);
  EXPECT_EQ(result.verdict, Verdict::named);
  EXPECT_EQ(result.log_odds, 8.0);
  EXPECT_EQ(
      result.message,
      "Stays modelled as bars do not vibrate: NE-8 swings with the deck. As cables they raise the modes explained from 2 to "
      "4 of 4 measured. Beyond that nothing was found");
  for (const Verdict verdict : {Verdict::unknown, Verdict::ambiguous}) {
    const HandMade other("scale.stiffness", {});
    auto open = with_one_effect(verdict, other.candidate);
    effect.put_first(open);
    EXPECT_EQ(open.verdict, verdict);
  }
}

TEST(BarStaysEffect, ItsStaysDoNotSwingOnceMore) {
  const HandMade string("element.string", {}), stiffness("scale.stiffness", {});
  diagnosis::Instantiated entries;
  const auto add = [&](const HandMade& what, const std::string& location) {
    entries.candidates.push_back(std::make_unique<diagnosis::Candidate>());
    entries.candidates.back()->hypothesis = &what.hypothesis;
    entries.candidates.back()->location = location;
  };
  add(string, "stay:NE-8");
  add(string, "stay:NE-80");
  add(stiffness, "stay:NE-8");
  add(string, "stay:N 9");
  BarStaysEffect(two_stays(), 8.0, {4, 2}, {4, 4}).take_out_entries(entries);
  ASSERT_EQ(entries.candidates.size(), 2u);
  EXPECT_EQ(entries.candidates[0]->location, "stay:NE-80");
  EXPECT_EQ(entries.candidates[1]->hypothesis, &stiffness.hypothesis);
}

TEST(ExplainedGain, IsThatOfTheEffectWhereverItStands) {
  const HandMade other("scale.stiffness", {});
  auto result = with_one_effect(Verdict::named, other.candidate);
  EXPECT_FALSE(diagnosis::explained_gain(result));
  const BarStaysEffect effect(two_stays(), 8.0, {11, 6}, {12, 9});
  effect.put_first(result);
  std::swap(result.effects[0], result.effects[1]);
  const auto gain = diagnosis::explained_gain(result);
  ASSERT_TRUE(gain);
  EXPECT_EQ(gain->before, 6.0);
  EXPECT_EQ(gain->after, 9.0);
  EXPECT_EQ(gain->measured, 12.0);
}

}  // namespace
}  // namespace twindeck::tests
