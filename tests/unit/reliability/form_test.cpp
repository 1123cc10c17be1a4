/// Oracles: closed forms of linear limit states, design points of the published problems worked out by hand.
#include "reliability/form.hpp"

#include <gtest/gtest.h>

#include "core/distributions.hpp"
#include "published_problems.hpp"

namespace twindeck::reliability {
namespace {

TEST(Form, FindsBetaOfResistanceLessLoad) {
  const FormResult found = form(published::resistance_less_load, 2);
  ASSERT_TRUE(found.status.converged) << found.status.message;
  EXPECT_NEAR(found.points.front().beta, 3.535534, 1e-6);
  EXPECT_NEAR(found.points.front().alpha[0], -1.0 / std::numbers::sqrt2, 1e-6);
  EXPECT_TRUE(found.strong_maximum);
  EXPECT_EQ(found.points.size(), 1U);
}

TEST(Form, LinearLimitStatesAreExactInAnyDimension) {
  for (const int n : {1, 2, 20, 200}) {
    const FormResult found = form(published::linear(5.0), n);
    ASSERT_TRUE(found.status.converged) << n;
    EXPECT_NEAR(found.points.front().beta, 5.0, 1e-6) << n;
    EXPECT_NEAR(found.probability / 2.866515719e-7, 1.0, 1e-5) << n;  // problem 107: beta 5
    EXPECT_NEAR(found.points.front().alpha.squaredNorm(), 1.0, 1e-9) << n;
  }
}

TEST(Form, FindsTheBeamUnderAxialLoad) {
  // FORM's linearisation is within 3 %; subset simulation has the value itself.
  const FormResult found = form(published::axial_beam(), 2);
  ASSERT_TRUE(found.status.converged);
  EXPECT_NEAR(found.probability / 0.029198, 1.0, 0.03);
  EXPECT_TRUE(found.strong_maximum);
}

TEST(Form, FindsAllBranchesOfASeriesSystem) {
  const FormResult found = form(published::four_branches, 2);
  ASSERT_TRUE(found.status.converged);
  // Two design points at 3 along the diagonal and two at 3.5 across it, all of comparable weight: no strong maximum.
  EXPECT_NEAR(found.points.front().beta, 3.0, 1e-5);
  EXPECT_FALSE(found.strong_maximum);
  EXPECT_GE(found.points.size(), 2U);
}

TEST(Form, FindsTheRegionThatTheSlopeAtTheOriginHides) {
  const FormResult found = form(published::hidden_region, 2);
  ASSERT_TRUE(found.status.converged);
  EXPECT_NEAR(found.points.front().beta, 4.0, 1e-3);
}

TEST(Form, CountsTheOriginBeyondTheLimitAsNegative) {
  const FormResult found = form([](const Eigen::VectorXd& u) { return u[0] - 2.0; }, 1);
  ASSERT_TRUE(found.status.converged);
  EXPECT_NEAR(found.points.front().beta, -2.0, 1e-6);
  EXPECT_NEAR(found.probability, normal_tail(-2.0), 1e-9);
}

TEST(Form, SaysThatAKinkOfTheLimitStateStopsIt) {
  // The nearest point of problem 25 lies where its two branches cross: no slope there points to the origin.
  const FormResult found = form(published::rp25, 2);
  ASSERT_FALSE(found.status.converged);
  EXPECT_NE(found.status.message.find("kink"), std::string::npos) << found.status.message;
  EXPECT_NE(found.status.message.find("subset simulation"), std::string::npos) << found.status.message;
}

TEST(Form, SaysThatALimitIsNeverExceeded) {
  const FormResult found = form([](const Eigen::VectorXd& u) { return 1.0 + u.squaredNorm(); }, 3);
  EXPECT_FALSE(found.status.converged);
  EXPECT_NE(found.status.message.find("found no point of the limit"), std::string::npos) << found.status.message;
}

}  // namespace
}  // namespace twindeck::reliability
