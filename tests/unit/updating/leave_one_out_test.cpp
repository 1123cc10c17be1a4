// Each target left out and predicted, on spring-mass chains. Oracles: targets that one set of parameters meets exactly are
// predicted exactly; what is left out cannot change its own prediction; the same fit to the other targets alone, made by hand.
#include "updating/leave_one_out.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::updating {
namespace {

const Eigen::Vector3d kTruth(1.23, 0.87, 1.31);

// Five masses between walls; two groups of springs and a factor on a part of the masses.
SmallSystem chain() {
  SmallSystem small(5);
  const int k1 = small.parameter("k1", 1.0, 0.5, 1.6), k2 = small.parameter("k2", 1.0, 0.5, 1.6),
            m = small.parameter("m", 1.0, 0.5, 1.6);
  for (int i = 0; i < 6; ++i) small.stiffness(400.0 * spring(5, i < 5 ? i : -1, i - 1), i < 2 ? k1 : k2);
  Eigen::VectorXd own(5), variable(5);
  own << 1.0, 1.2, 0.8, 1.1, 1.3;
  variable << 0.0, 0.5, 0.0, 0.0, 0.9;
  return small.mass(own.asDiagonal().toDenseMatrix()).mass(variable.asDiagonal().toDenseMatrix(), m);
}

std::vector<FrequencyTarget> targets(const Eigen::VectorXd& frequency_Hz) {
  std::vector<FrequencyTarget> out;
  for (int i = 0; i < frequency_Hz.size(); ++i) out.push_back({std::to_string(i + 1), i, frequency_Hz(i)});
  return out;
}

UpdatingResult with_left_out(const std::vector<FrequencyTarget>& measured, Eigen::Index surrogate_from = 1000) {
  UpdatingOptions options;
  options.starts = 2;
  options.leave_one_out = true;
  options.surrogate_from_size = surrogate_from;
  return update(chain().system(), {}, {0, 1, 2}, measured, options, {});
}

TEST(LeaveOneOut, WhatOneSetOfParametersMeetsIsPredicted) {
  const Eigen::VectorXd exact = dense_frequencies(chain().system(), kTruth);
  for (const Eigen::Index surrogate : {1000, 1}) {
    const UpdatingResult result = with_left_out(targets(exact), surrogate);
    ASSERT_TRUE(result.status.converged) << result.status.message;
    ASSERT_EQ(result.left_out.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      const LeftOut& left = result.left_out[i];
      EXPECT_TRUE(left.converged);
      EXPECT_NEAR(left.frequency_Hz / exact(static_cast<Eigen::Index>(i)), 1.0, 1e-6) << i;
      EXPECT_NEAR((left.theta - kTruth).cwiseAbs().maxCoeff(), 0.0, 1e-5) << i;
      EXPECT_NEAR(left.cost, 0.0, 1e-12);
      EXPECT_EQ(left.on_bounds, 0);
    }
  }
}

TEST(LeaveOneOut, NothingOfTheLeftOutTargetEntersItsPrediction) {
  const Eigen::VectorXd exact = dense_frequencies(chain().system(), kTruth);
  std::vector<FrequencyTarget> wrong = targets(exact);
  wrong[2].measured_Hz *= 1.1;
  const UpdatingResult result = with_left_out(wrong);
  ASSERT_EQ(result.left_out.size(), 5U);
  EXPECT_NEAR(result.left_out[2].frequency_Hz / exact(2), 1.0, 1e-6) << "of the other four, which are right";
  EXPECT_GT(std::abs(result.frequency_after_Hz(2) / exact(2) - 1.0), 0.01) << "the fit to all five goes after it";
  EXPECT_GT(std::abs(result.left_out[0].frequency_Hz / exact(0) - 1.0), 1e-3) << "and so does a fit to it and three more";
}

TEST(LeaveOneOut, IsTheFitToTheOthers) {
  std::vector<FrequencyTarget> scattered = targets(dense_frequencies(chain().system(), kTruth));
  const Eigen::VectorXd scatter = (Eigen::VectorXd(5) << 1.02, 0.97, 1.01, 0.99, 1.03).finished();
  for (std::size_t i = 0; i < 5; ++i) scattered[i].measured_Hz *= scatter(static_cast<Eigen::Index>(i));
  const UpdatingResult result = with_left_out(scattered);
  ASSERT_EQ(result.left_out.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<FrequencyTarget> others = scattered;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    UpdatingOptions options;
    options.starts = 1;
    const UpdatingResult alone = update(chain().system(), {}, {0, 1, 2}, others, options, {});
    EXPECT_NEAR(result.left_out[i].cost, alone.starts.front().cost, 1e-9 + 1e-4 * alone.starts.front().cost) << i;
    const Eigen::VectorXd there = dense_frequencies(chain().system(), alone.theta);
    EXPECT_NEAR(result.left_out[i].frequency_Hz / there(static_cast<Eigen::Index>(i)), 1.0, 1e-4) << i;
  }
}

TEST(LeaveOneOut, IsLeftAloneUnlessAskedForAndWithOneTarget) {
  const Eigen::VectorXd exact = dense_frequencies(chain().system(), kTruth);
  UpdatingOptions options;
  options.starts = 1;
  EXPECT_TRUE(update(chain().system(), {}, {0, 1, 2}, targets(exact), options, {}).left_out.empty());
  EXPECT_TRUE(with_left_out({targets(exact).front()}).left_out.empty());
}

TEST(Costs, AreThoseOfTheFrequenciesThere) {
  const Eigen::VectorXd measured = dense_frequencies(chain().system(), kTruth);
  UpdatingOptions options;
  options.starts = 1;
  options.elsewhere = {kTruth, Eigen::Vector3d(1.1, 0.9, 1.4)};
  const UpdatingResult result = update(chain().system(), {}, {0, 1, 2}, targets(measured), options, {});
  const auto cost = [&](const Eigen::Vector3d& theta) {
    return 0.5 * (dense_frequencies(chain().system(), theta).array() / measured.array() - 1.0).square().sum();
  };
  EXPECT_NEAR(result.cost_before, cost(Eigen::Vector3d::Ones()), 1e-12);
  ASSERT_EQ(result.elsewhere.size(), 2U);
  EXPECT_NEAR(result.elsewhere[0].cost, 0.0, 1e-14);
  EXPECT_NEAR(result.elsewhere[1].cost, cost(options.elsewhere[1]), 1e-12);
}

}  // namespace
}  // namespace twindeck::updating
