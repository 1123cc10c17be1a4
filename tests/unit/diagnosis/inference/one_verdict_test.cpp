// The verdict's table. Oracles: probabilities by hand.
#include "diagnosis/inference/one_verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::tests {
namespace {

using diagnosis::judge;
using diagnosis::Judgement;
using diagnosis::PossibleAnswer;
using diagnosis::Verdict;

/// An answer of a weight that is not in ln.
PossibleAnswer answer(double weight, bool something_else = false) { return {std::log(weight), something_else}; }

TEST(OneVerdict, NothingWithFivePerCentIsNone) {
  EXPECT_EQ(judge(0.0, {}).verdict, Verdict::none);
  const Judgement out = judge(std::log(0.06), {answer(0.94)});
  EXPECT_EQ(out.verdict, Verdict::none);
  EXPECT_NEAR(out.nothing, 0.06, 1e-12);
  EXPECT_NEAR(out.log_odds, std::log(0.94 / 0.06), 1e-12);
}

TEST(OneVerdict, OneAnswerOfNinetyFivePerCentOfTheRestIsNamed) {
  const Judgement out = judge(std::log(0.04), {answer(0.04), answer(0.92)});  // 0.92 of 0.96 is 95.8 %
  EXPECT_EQ(out.verdict, Verdict::named);
  EXPECT_EQ(out.set, std::vector<int>{1});
  EXPECT_NEAR(out.probability[1], 0.92, 1e-12);
}

TEST(OneVerdict, SeveralAreAmbiguousTheMostProbableFirst) {
  const Judgement out = judge(std::log(0.01), {answer(0.3), answer(0.65), answer(0.04)});  // 0.65 + 0.3 of 0.99 is 96 %
  EXPECT_EQ(out.verdict, Verdict::ambiguous);
  EXPECT_EQ(out.set, (std::vector<int>{1, 0}));
  EXPECT_FALSE(out.something_else_in_set);
}

TEST(OneVerdict, SomethingElseInTheLeadIsUnknown) {
  EXPECT_EQ(judge(std::log(0.01), {answer(0.3), answer(0.69, true)}).verdict, Verdict::unknown);
  const Judgement behind = judge(std::log(0.01), {answer(0.69), answer(0.3, true)});
  EXPECT_EQ(behind.verdict, Verdict::ambiguous);
  EXPECT_TRUE(behind.something_else_in_set);
}

TEST(OneVerdict, WeightsFarBelowZeroAreCompared) {
  const Judgement out = judge(-5000.0, {{-4900.0, false}, {-4950.0, true}});
  EXPECT_EQ(out.verdict, Verdict::named);
  EXPECT_NEAR(out.log_odds, 100.0, 1e-9);
}

}  // namespace
}  // namespace twindeck::tests
