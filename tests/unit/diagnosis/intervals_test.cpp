// Oracle: noise floors, on which the logarithm of a factor acts linearly, so that its law is normal. The level of the other m
// channels has a variance of s²/m; a channel with the factor has a variance of s² (1 + 1/m).
#include "diagnosis/intervals.hpp"

#include <gtest/gtest.h>

#include "unit/diagnosis/prediction/hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::EffectParameter;
using diagnosis::RowType;
using Eigen::VectorXd;

constexpr int kOthers = 4;
constexpr double kStd = 0.1, kNinetyFive = 1.6449;
// The width is interpolated between 25 points of ±4 deviations: to 0.03 deviations. The fit ends where chi² would fall by less
// than 0.02, within sqrt(0.02) deviations of the best value.
constexpr double kInterpolated = 0.03, kEndOfTheFit = 0.142;

/// Floors of five channels. The factor on the first may have any value between e^low and e^high.
class Floors {
 public:
  Floors(double ln_factor, double spread, double low, double high)
      : model_(nodes_in_a_row(1 + kOthers), springs_in_a_row(VectorXd::Constant(2 + kOthers, 2e6)),
               1000.0 * Eigen::MatrixXd::Identity(1 + kOthers, 1 + kOthers)) {
    for (int c = 0; c <= kOthers; ++c) {
      const double ln = c == 0 ? ln_factor : (c % 2 ? spread : -spread);
      model_.add_row(RowType::psd_floor, "", c, std::exp(ln), kStd * std::exp(ln));
    }
    hypothesis_.id = "floor";
    hypothesis_.unknowns.push_back({"ratio", "-", {std::exp(low), "", 0}, {std::exp(high), "", 0}, true, {}});
    hypothesis_.actions.push_back({diagnosis::Primitive::channel_floor, {}, {{"factor", {1.0, "$ratio", 0}}}, 0});
    candidate_.hypothesis = &hypothesis_;
    candidate_.location = "channel:c0";
    candidate_.channels = {0};
    candidate_.log = {true};
    candidate_.low = VectorXd::Constant(1, low);
    candidate_.high = VectorXd::Constant(1, high);
    candidate_.starts = {VectorXd::Constant(1, 0.5 * (low + high))};
  }
  [[nodiscard]] EffectParameter interval() const {
    const diagnosis::FeatureMap map = model_.map();
    const std::vector<std::unique_ptr<diagnosis::Candidate>> none;
    const diagnosis::Inference inference(map, none);
    const auto fit = inference.fit({{&candidate_, candidate_.starts[0]}}, {});
    const auto found = effect_parameters(inference, fit, 0);
    EXPECT_EQ(found.size(), 1U);
    return found.at(0);
  }

 private:
  Predicted model_;
  diagnosis::Hypothesis hypothesis_;
  diagnosis::Candidate candidate_;
};

void expect_interval(const EffectParameter& found, double centre, double deviation) {
  const double low = std::log(found.low), high = std::log(found.high);
  EXPECT_NEAR(std::log(found.value), centre, kEndOfTheFit * deviation);
  EXPECT_NEAR(0.5 * (low + high), centre, kEndOfTheFit * deviation);
  EXPECT_NEAR(0.5 * (high - low), kNinetyFive * deviation, kInterpolated * deviation);
  EXPECT_FALSE(found.at_low_bound || found.at_high_bound);
}

TEST(EffectParameters, OfALinearEffectAreThoseOfTheNormalLaw) {
  const EffectParameter found = Floors(1.1, 0.0, -5.0, 5.0).interval();
  EXPECT_EQ(found.name, "ratio");
  expect_interval(found, 1.1, kStd * std::sqrt(1.0 + 1.0 / kOthers));
}

TEST(EffectParameters, AreWidenedByTheMisfit) {
  // The others lie ±3 s about their level: chi² = 36 on five rows widens by sqrt(7.2).
  const EffectParameter found = Floors(1.1, 3.0 * kStd, -5.0, 5.0).interval();
  expect_interval(found, 1.1, std::sqrt(36.0 / 5.0) * kStd * std::sqrt(1.0 + 1.0 / kOthers));
}

TEST(EffectParameters, AnEndThatTheDataDoNotSeeIsThePriors) {
  // The upper bound lies within a deviation of the best value.
  const EffectParameter found = Floors(1.1, 0.0, -2.0, 1.15).interval();
  EXPECT_TRUE(found.at_high_bound);
  EXPECT_FALSE(found.at_low_bound);
  EXPECT_NEAR(found.high, std::exp(1.15), 1e-12);
  EXPECT_LT(std::log(found.low), 1.1 - kStd);
}

TEST(EffectParameters, OfACauseWithoutUnknownsAreNone) {
  Predicted model(nodes_in_a_row(2), springs_in_a_row(VectorXd::Constant(3, 2e6)), 1000.0 * Eigen::MatrixXd::Identity(2, 2));
  for (int c = 0; c < 2; ++c) model.add_row(RowType::psd_floor, "", c, 1.0, 0.1);
  HandMade sign("channel.sign", {});
  const diagnosis::FeatureMap map = model.map();
  const std::vector<std::unique_ptr<diagnosis::Candidate>> none;
  const diagnosis::Inference inference(map, none);
  diagnosis::Fit fit;
  fit.causes = {sign.on_channels({0}).cause()};
  EXPECT_TRUE(effect_parameters(inference, fit, 0).empty());
}

TEST(WidenSizes, HoldsTheValueAndReachesToBothSidesOfIt) {
  // By hand: ln of |ln 0.2| and of 3000 moves by 1.6449 * 0.25, whichever side of the value the ends were rounded to.
  const double reach = kNinetyFive * 0.25;
  for (const double rounding : {-1e-12, 0.0, 1e-12}) {
    std::vector<EffectParameter> sizes(2);
    sizes[0] = {"factor", "-", 0.2, 0.2 + rounding, 0.2 + rounding};
    sizes[1] = {"mass", "kg", 3000.0, 3000.0 + rounding, 3000.0 + rounding};
    diagnosis::widen_sizes(sizes, 0.25);
    EXPECT_NEAR(sizes[0].low, std::exp(std::log(0.2) * std::exp(reach)), 1e-5);
    EXPECT_NEAR(sizes[0].high, std::exp(std::log(0.2) * std::exp(-reach)), 1e-5);
    EXPECT_NEAR(sizes[1].low, 3000.0 * std::exp(-reach), 0.5);
    EXPECT_NEAR(sizes[1].high, 3000.0 * std::exp(reach), 0.5);
  }
}

}  // namespace
}  // namespace twindeck::tests
