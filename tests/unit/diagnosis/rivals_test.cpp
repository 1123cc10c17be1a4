// Oracle: intervals by hand, value ± 1.645 deviations, in ln where the unknown is logarithmic.
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/diagnose_parts.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Candidate;
using diagnosis::Hypothesis;
using diagnosis::Scored;
using Eigen::VectorXd;

constexpr double kQuantile = 1.645, kDigits = 1e-3;  // of the normal law at 95 %, to its digits

struct Entry {
  Entry(const std::string& name, bool log, double low, double high, double value, double deviation) {
    hypothesis.id = name;
    hypothesis.unknowns.push_back({name, "kg", {}, {}, log, {}});
    candidate.hypothesis = &hypothesis;
    candidate.location = "node:7";
    candidate.log = {log};
    candidate.low = VectorXd::Constant(1, low);
    candidate.high = VectorXd::Constant(1, high);
    scored.candidate = &candidate;
    scored.a = VectorXd::Constant(1, value);
    scored.a_covariance = Eigen::MatrixXd::Constant(1, 1, deviation * deviation);
  }
  Entry(const Entry&) = delete;
  Entry& operator=(const Entry&) = delete;
  Hypothesis hypothesis;
  Candidate candidate;
  Scored scored;
};

TEST(Rivals, AreTheMembersBesideTheFirst) {
  const Entry first("a", false, 0.0, 10.0, 5.0, 1.0), second("b", false, 0.0, 10.0, 5.0, 1.0);
  const auto rivals = diagnosis::rivals_of({&first.scored, &second.scored}, {0.7, 0.3}, 1.0);
  ASSERT_EQ(rivals.size(), 1U);
  EXPECT_EQ(rivals[0].id, "b@node:7");
  EXPECT_EQ(rivals[0].candidate, &second.candidate);
  EXPECT_EQ(rivals[0].probability, 0.3);
  EXPECT_TRUE(diagnosis::rivals_of({&first.scored}, {1.0}, 1.0).empty());
}

TEST(Rivals, IntervalsAreThoseOfTheNormalLawWidenedByMisfit) {
  const Entry first("a", false, 0.0, 10.0, 5.0, 1.0), plain("b", false, -20.0, 20.0, 5.0, 1.2),
      log("c", true, -3.0, 9.0, 2.0, 0.3);
  const auto rivals = diagnosis::rivals_of({&first.scored, &plain.scored, &log.scored}, {0.5, 0.3, 0.2}, 4.0);
  const auto& b = rivals[0].parameters.at(0);
  EXPECT_EQ(b.value, 5.0);
  EXPECT_NEAR(b.low, 5.0 - kQuantile * 2.4, kDigits);
  EXPECT_NEAR(b.high, 5.0 + kQuantile * 2.4, kDigits);
  EXPECT_FALSE(b.at_low_bound || b.at_high_bound);
  const auto& c = rivals[1].parameters.at(0);
  EXPECT_NEAR(c.value, std::exp(2.0), 1e-12);
  EXPECT_NEAR(std::log(c.low), 2.0 - kQuantile * 0.6, kDigits);
  EXPECT_NEAR(std::log(c.high), 2.0 + kQuantile * 0.6, kDigits);
  EXPECT_EQ(c.unit, "kg");
}

TEST(Rivals, IntervalsEndAtTheBounds) {
  const Entry first("a", false, 0.0, 10.0, 5.0, 1.0), low("b", false, 4.0, 20.0, 5.0, 1.0),
      high("c", false, 0.0, 6.0, 5.0, 1.0);
  const auto rivals = diagnosis::rivals_of({&first.scored, &low.scored, &high.scored}, {0.5, 0.3, 0.2}, 1.0);
  EXPECT_EQ(rivals[0].parameters[0].low, 4.0);
  EXPECT_TRUE(rivals[0].parameters[0].at_low_bound);
  EXPECT_FALSE(rivals[0].parameters[0].at_high_bound);
  EXPECT_EQ(rivals[1].parameters[0].high, 6.0);
  EXPECT_TRUE(rivals[1].parameters[0].at_high_bound);
}

TEST(Rivals, WithoutACovarianceHaveNoMagnitudes) {
  const Entry first("a", false, 0.0, 10.0, 5.0, 1.0);
  Entry second("b", false, 0.0, 10.0, 5.0, 1.0);
  second.scored.a_covariance.resize(0, 0);
  EXPECT_TRUE(diagnosis::rivals_of({&first.scored, &second.scored}, {0.7, 0.3}, 1.0)[0].parameters.empty());
}

}  // namespace
}  // namespace twindeck::tests
