// Oracle: the bounds that the candidates are given here.
#include "diagnosis/size_of_a_cause.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::tests {
namespace {

using diagnosis::at_its_least;
using diagnosis::Candidate;
using diagnosis::Cause;
using diagnosis::may_be_zero;

/// An oscillator of 10 to 1000 kg and 1 to 60 Hz.
struct Oscillator {
  diagnosis::Hypothesis hypothesis;
  Candidate candidate;
  Oscillator() {
    hypothesis.unknowns = {{"mass_kg", "kg", {}, {}, true, {}}, {"frequency_Hz", "Hz", {}, {}, true, {}}};
    candidate.hypothesis = &hypothesis;
    candidate.low = Eigen::Vector2d(std::log(10.0), std::log(1.0));
    candidate.high = Eigen::Vector2d(std::log(1000.0), std::log(60.0));
    candidate.log = {true, true};
    candidate.tuned = 1;
  }
  [[nodiscard]] Cause of(double kg, double Hz) const { return {&candidate, Eigen::Vector2d(std::log(kg), std::log(Hz))}; }
};

TEST(AtItsLeast, IsASizeOnItsLowerBoundAlone) {
  const Oscillator oscillator;
  EXPECT_TRUE(at_its_least(oscillator.of(10.0, 20.0)));
  EXPECT_FALSE(at_its_least(oscillator.of(11.0, 20.0)));
  EXPECT_FALSE(at_its_least(oscillator.of(1000.0, 20.0)));
  EXPECT_FALSE(at_its_least(oscillator.of(100.0, 1.0))) << "a low frequency is no small effect";
}

// A thousandth of its own range of ln(100): 0.0046. The range of another unknown counts for nothing.
TEST(AtItsLeast, IsAsCloseAsAThousandthOfItsOwnRange) {
  Oscillator oscillator;
  oscillator.candidate.low[1] = -100.0;
  EXPECT_TRUE(at_its_least(oscillator.of(10.0 * std::exp(0.004), 20.0)));
  EXPECT_FALSE(at_its_least(oscillator.of(10.0 * std::exp(0.006), 20.0)));
  EXPECT_FALSE(at_its_least(oscillator.of(10.0 * std::exp(0.05), 20.0)));
}

TEST(AtItsLeast, IsNotSaidOfAFactor) {
  diagnosis::Hypothesis hypothesis;
  hypothesis.unknowns = {{"factor", "-", {}, {}, true, {}}};
  Candidate candidate;
  candidate.hypothesis = &hypothesis;
  candidate.low = Eigen::VectorXd::Constant(1, std::log(0.05));
  candidate.high = Eigen::VectorXd::Constant(1, std::log(20.0));
  candidate.log = {true};
  EXPECT_FALSE(at_its_least({&candidate, candidate.low})) << "a twentieth is a large change";
}

TEST(MayBeZero, IsAnIntervalOfEitherSignThatHoldsZero) {
  diagnosis::Hypothesis hypothesis;
  hypothesis.unknowns = {{"angle_deg", "deg", {}, {}, false, {}}};
  Candidate candidate;
  candidate.hypothesis = &hypothesis;
  candidate.low = Eigen::VectorXd::Constant(1, -30.0);
  candidate.high = Eigen::VectorXd::Constant(1, 30.0);
  candidate.log = {false};
  const auto interval = [](double low, double high) {
    return std::vector<diagnosis::EffectParameter>{{"angle_deg", "deg", 0.5 * (low + high), low, high, false, false}};
  };
  EXPECT_TRUE(may_be_zero(interval(-1.0, 4.0), candidate));
  EXPECT_FALSE(may_be_zero(interval(1.0, 4.0), candidate));
  candidate.low[0] = 0.0;  // of one sign only
  EXPECT_FALSE(may_be_zero(interval(-1.0, 4.0), candidate));
}

TEST(MayBeZero, IsAFactorWhoseIntervalHoldsOne) {
  diagnosis::Hypothesis hypothesis;
  hypothesis.unknowns = {{"factor", "-", {}, {}, true, {}}};
  Candidate candidate;
  candidate.hypothesis = &hypothesis;
  candidate.low = Eigen::VectorXd::Constant(1, std::log(0.05));
  candidate.high = Eigen::VectorXd::Constant(1, std::log(20.0));
  candidate.log = {true};
  const auto interval = [](double low, double high) {
    return std::vector<diagnosis::EffectParameter>{{"factor", "-", std::sqrt(low * high), low, high, false, false}};
  };
  EXPECT_TRUE(may_be_zero(interval(0.93, 1.05), candidate));
  EXPECT_FALSE(may_be_zero(interval(0.90, 0.97), candidate));
  EXPECT_FALSE(may_be_zero(interval(1.2, 1.9), candidate));
}

TEST(ObjectionToSize, SaysWhichOfTheTwoItIs) {
  const Oscillator oscillator;
  EXPECT_EQ(diagnosis::objection_to_size(oscillator.of(100.0, 20.0), {}), "");
  EXPECT_NE(diagnosis::objection_to_size(oscillator.of(10.0, 20.0), {}).find("as small as it can be"), std::string::npos);

  diagnosis::Hypothesis hypothesis;
  hypothesis.unknowns = {{"angle_deg", "deg", {}, {}, false, {}}};
  Candidate turned;
  turned.hypothesis = &hypothesis;
  turned.low = Eigen::VectorXd::Constant(1, -30.0);
  turned.high = Eigen::VectorXd::Constant(1, 30.0);
  turned.log = {false};
  const auto objection = [&](double low, double high) {
    return diagnosis::objection_to_size({&turned, Eigen::VectorXd::Constant(1, 0.5 * (low + high))},
                                        {{"angle_deg", "deg", 0.5 * (low + high), low, high, false, false}});
  };
  EXPECT_NE(objection(-1.0, 4.0).find("told from zero"), std::string::npos);
  EXPECT_EQ(objection(1.0, 4.0), "");
}

}  // namespace
}  // namespace twindeck::tests
