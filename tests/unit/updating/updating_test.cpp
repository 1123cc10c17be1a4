// What is asked of `update` and cannot be, and what else it returns. Oracles: one mass on one spring, f = sqrt(k/m)/(2 pi) with
// k = 100 theta, so that (f/f_X - 1)²/2 is the cost; messages that name what is wrong.
#include "updating/updating.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "chain.hpp"

namespace twindeck::updating {
namespace {

UpdatingOptions one_start() {
  UpdatingOptions options;
  options.starts = 1;
  return options;
}

SmallSystem one_mass(double initial = 1.0, double lower = 0.5, double upper = 4.0) {
  SmallSystem small(1);
  const int k = small.parameter("k", initial, lower, upper);
  return small.stiffness(100.0 * Eigen::MatrixXd::Ones(1, 1), k).mass(Eigen::MatrixXd::Ones(1, 1));
}

double hertz(double theta) { return std::sqrt(100.0 * theta) / (2.0 * std::numbers::pi); }

std::string refused(const SmallSystem& small, const std::vector<int>& active, const std::vector<FrequencyTarget>& targets) {
  try {
    (void)update(small.system(), {}, active, targets, one_start(), {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_says(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(UpdateInput, BoundsHaveToBeFiniteAndInOrder) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::vector<FrequencyTarget> target = {{"1X-1N", 0, 2.0}};
  expect_says(refused(one_mass(1.0, 1.0, 1.0), {0}, target), "has the bounds [1, 1]");
  expect_says(refused(one_mass(1.0, 2.0, 0.5), {0}, target), "has the bounds [2, 0.5]");
  expect_says(refused(one_mass(1.0, 0.5, inf), {0}, target), "expected a finite lower bound below the upper one");
  expect_says(refused(one_mass(1.0, -inf, 2.0), {0}, target), "expected a finite lower bound below the upper one");
  expect_says(refused(one_mass(0.4, 0.5, 2.0), {0}, target), "k: starts at 0.4, outside its bounds [0.5, 2]");
  expect_says(refused(one_mass(2.1, 0.5, 2.0), {0}, target), "starts at 2.1, outside its bounds [0.5, 2]");
  EXPECT_EQ(refused(one_mass(0.5, 0.5, 2.0), {0}, target), "");  // it may begin on one of them
}

TEST(UpdateInput, FrequenciesAreAboveZeroAndOfModesThatAreThere) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (const double f : {0.0, -1.0, none})
    expect_says(refused(one_mass(), {0}, {{"1X-1N", 0, f}}), "expected a frequency above 0");
  expect_says(refused(one_mass(), {0}, {{"1X-2N", 1, 2.0}}), "1X-2N: asks for mode 2 of a model with 1 degrees of freedom");
  expect_says(refused(one_mass(), {0}, {{"1X-0N", -1, 2.0}}), "asks for mode 0");
}

TEST(Update, OfOneMassHasTheCostsOfTheClosedForm) {
  UpdatingOptions options = one_start();
  options.elsewhere = {Eigen::VectorXd::Constant(1, 1.0), Eigen::VectorXd::Constant(1, 2.25)};
  const UpdatingResult result = update(one_mass().system(), {}, {0}, {{"1X-1N", 0, hertz(2.25)}}, options, {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_NEAR(result.theta[0], 2.25, 1e-6);
  EXPECT_NEAR(result.cost_before, 0.5 * std::pow(1.0 / 1.5 - 1.0, 2), 1e-9);
  ASSERT_EQ(result.elsewhere.size(), 2U);
  EXPECT_TRUE(result.elsewhere[0].valid);
  EXPECT_NEAR(result.elsewhere[0].cost, result.cost_before, 1e-9);
  EXPECT_NEAR(result.elsewhere[0].frequency_Hz[0], hertz(1.0), 1e-9);
  EXPECT_NEAR(result.elsewhere[1].cost, 0.0, 1e-15);
  EXPECT_EQ(result.mode_after, std::vector<int>{0});
}

TEST(Update, TargetsThatAreNotFittedCostNothing) {
  SmallSystem small(2);
  const int k = small.parameter("k", 1.0, 0.5, 4.0);
  small.stiffness(100.0 * spring(2, 0, -1), k).stiffness(900.0 * spring(2, 1, -1)).mass(Eigen::MatrixXd::Identity(2, 2));
  FrequencyTarget far{"2X-2N", 1, 7.0, false};
  const UpdatingResult result = update(small.system(), {}, {0}, {{"1X-1N", 0, hertz(2.25)}, far}, one_start(), {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_NEAR(result.cost_before, 0.5 / 9.0, 1e-9);
  EXPECT_NEAR(result.theta[0], 2.25, 1e-6);
  EXPECT_NEAR(result.frequency_after_Hz[1], hertz(9.0), 1e-9);  // it is followed all the same
}

// A parameter of 0 is scaled by its range.
TEST(Update, AParameterThatBeginsAtZeroIsScaledByItsRange) {
  SmallSystem small(1);
  const int more = small.parameter("more", 0.0, -0.5, 3.5);
  small.stiffness(100.0 * Eigen::MatrixXd::Ones(1, 1))
      .stiffness(100.0 * Eigen::MatrixXd::Ones(1, 1), more)
      .mass(Eigen::MatrixXd::Ones(1, 1));
  const UpdatingResult result = update(small.system(), {}, {0}, {{"1X-1N", 0, hertz(2.25)}}, one_start(), {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_EQ(result.scale[0], 4.0);
  EXPECT_EQ(result.box.lower[0], -0.125);
  EXPECT_EQ(result.box.upper[0], 0.875);
  EXPECT_NEAR(result.theta[0], 1.25, 1e-6);
}

// Of three dofs one has no mass: two modes, though twenty are asked for.
TEST(Update, DofsWithoutMassHaveNoModes) {
  SmallSystem small(3);
  const int k = small.parameter("k", 1.0, 0.5, 4.0);
  small.stiffness(100.0 * spring(3, 0, -1), k).stiffness(900.0 * spring(3, 1, -1)).stiffness(50.0 * spring(3, 2, -1));
  small.mass(Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal().toDenseMatrix());
  const UpdatingResult result = update(small.system(), {}, {0}, {{"1X-1N", 0, hertz(2.25)}}, one_start(), {});
  ASSERT_TRUE(result.status.converged) << result.status.message;
  EXPECT_NEAR(result.theta[0], 2.25, 1e-6);
}

TEST(Update, SaysThatTheStartModelCannotBeSolved) {
  SmallSystem small(2);
  const int k = small.parameter("k", 1.0, 0.5, 4.0);
  small.stiffness(-100.0 * spring(2, 0, -1), k).stiffness(900.0 * spring(2, 1, -1)).mass(Eigen::MatrixXd::Identity(2, 2));
  const UpdatingResult result = update(small.system(), {}, {0}, {{"1X-1N", 0, 2.0}}, one_start(), {});
  EXPECT_FALSE(result.status.converged);
  expect_says(result.status.message, "modes of the start model: ");
  EXPECT_EQ(result.theta[0], 1.0);
}

}  // namespace
}  // namespace twindeck::updating
