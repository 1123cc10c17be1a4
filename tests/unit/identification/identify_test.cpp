// Oracle: closed-form modes of a chain of masses under white noise; the spread over seeds for the standard deviations, together
// with Au's closed-form law cov f = sqrt(zeta / (2 pi N_c)).
#include "identification/identify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "calibration.hpp"
#include "modal/mac.hpp"
#include "signal/condition.hpp"

namespace twindeck::identification {
namespace {

IdentifyOptions options() {
  IdentifyOptions o;
  o.block_rows = 25;
  o.maximum_order = 40;
  return o;
}

Identification identified(const Eigen::MatrixXd& data, double rate, const std::vector<Eigen::Index>& references) {
  return identify(signal::correlations(signal::detrended(data), references, 50, 20), rate, options());
}

/// Whether a mode with these deviations stays in a record of this length.
bool stays(double frequency_Hz, double damping_ratio, const ModeDeviation& deviation, double seconds,
           const IdentifyOptions& o) {
  Identification found;
  Cluster mode;
  mode.frequency_Hz = frequency_Hz;
  mode.damping_ratio = damping_ratio;
  mode.shape = Eigen::VectorXcd::Ones(2).normalized();
  found.modes.push_back(mode);
  found.deviations.push_back(deviation);
  drop_undetermined(found, o, seconds);
  return found.modes.size() == 1;
}

TEST(Identify, AModeOfFewCyclesStaysIfItIsAsWellKnownAsTheRecordAllows) {
  const double f = 1.228, zeta = 0.002;  // 4 minutes are 295 cycles: the law allows half of the half bandwidth and no less
  const auto law = [&](double seconds) { return std::sqrt(zeta / (2.0 * std::numbers::pi * f * seconds)); };
  ModeDeviation deviation;
  deviation.frequency_Hz = 1.5 * law(240.0) * f;
  deviation.damping_ratio = 2.5 * law(240.0);
  IdentifyOptions o = options();
  EXPECT_TRUE(stays(f, zeta, deviation, 240.0, o));
  EXPECT_FALSE(stays(f, zeta, deviation, 14400.0, o));  // four hours would show a mode better
  ModeDeviation damping_unknown = deviation;
  damping_unknown.damping_ratio = 4.0 * law(240.0);
  EXPECT_FALSE(stays(f, zeta, damping_unknown, 240.0, o));
  o.largest_law_ratio = 0.0;  // any
  EXPECT_TRUE(stays(f, zeta, damping_unknown, 14400.0, o));
}

// Two channels; the covariance turns the shape towards its perpendicular by `across`, and along itself by `along`.
TEST(Identify, AModeStaysAsLongAsItsShapeIsKnown) {
  const auto stays_with = [&](double across, double along) {
    ModeDeviation deviation;
    deviation.frequency_Hz = 0.002;
    deviation.damping_ratio = 0.001;
    deviation.factor = Eigen::MatrixXd::Zero(6, 2);
    deviation.factor.block(2, 0, 2, 1) = across * Eigen::Vector2d(1.0, -1.0).normalized();
    deviation.factor.block(2, 1, 2, 1) = along * Eigen::Vector2d(1.0, 1.0).normalized();
    return stays(1.0, 0.01, deviation, 3600.0, options());
  };
  EXPECT_TRUE(stays_with(0.5, 0.0));
  EXPECT_FALSE(stays_with(0.7, 0.0));
  EXPECT_TRUE(stays_with(0.0, 5.0));  // the scale of a shape is free
}

/// Adds a mode that a record of an hour settles, its shape known to `across`.
void add_mode(Identification& found, double frequency_Hz, const Eigen::VectorXcd& shape, double across, double deviation_Hz) {
  Cluster mode;
  mode.frequency_Hz = frequency_Hz;
  mode.damping_ratio = 0.01;
  mode.shape = normalised_shape(shape);
  const Eigen::Index n = shape.size();
  Eigen::VectorXcd perpendicular = Eigen::VectorXcd::Unit(n, n - 1);
  perpendicular -= mode.shape * mode.shape.dot(perpendicular);
  ModeDeviation deviation;
  deviation.frequency_Hz = deviation_Hz;
  deviation.damping_ratio = 0.001;
  deviation.factor = Eigen::MatrixXd::Zero(2 + 2 * n, 1);
  deviation.factor.block(2, 0, n, 1) = across * perpendicular.normalized().real();
  deviation.factor.block(2 + n, 0, n, 1) = across * perpendicular.normalized().imag();
  found.modes.push_back(mode);
  found.deviations.push_back(deviation);
}

// 0.003 Hz apart, each known to 0.002 Hz; MAC 0.81. What the shapes' own deviations say decides.
TEST(Identify, OfAPairThatTheDataCannotTellApartOneStays) {
  const auto modes_of = [&](double across, double apart_Hz) {
    Identification found;
    add_mode(found, 1.0, Eigen::Vector2cd(1.0, 0.0), 0.02, 0.0019);
    add_mode(found, 1.0 + apart_Hz, Eigen::Vector2cd(0.9, 0.436), across, 0.002);
    drop_undetermined(found, options(), 3600.0);
    return found.modes.size();
  };
  EXPECT_EQ(modes_of(0.1, 0.003), 2U);
  EXPECT_EQ(modes_of(0.5, 0.003), 1U);
  EXPECT_EQ(modes_of(0.5, 0.03), 2U);
}

// Two channels in quadrature have no collinearity: a mode where the record is sure of it, none where that may be noise.
TEST(Identify, AShapeOfArbitraryPhasesMustBeKnown) {
  const auto stays_with = [&](std::complex<double> second, double across) {
    Identification found;
    add_mode(found, 1.0, Eigen::Vector2cd(1.0, second), across, 0.002);
    drop_undetermined(found, options(), 3600.0);
    return found.modes.size() == 1;
  };
  EXPECT_TRUE(stays_with({0.0, 1.0}, 0.1));
  EXPECT_FALSE(stays_with({0.0, 1.0}, 0.4));
  EXPECT_TRUE(stays_with({1.0, 0.2}, 0.4));
}

// The least deviation of an hour at 1 Hz and 1 % is 0.00066 Hz. From 20 blocks it is known to a sixth, from 4 to no better than
// 41 %. Two other modes are known as random forces allow; where all are known better, the forces are not random.
TEST(Identify, WhatIsKnownBetterThanRandomForcesAllowIsNoMode) {
  const auto modes_of = [&](double deviation_Hz, double of_others_Hz, Eigen::Index blocks) {
    Identification found;
    for (const double frequency_Hz : {1.0, 1.2, 1.4})
      add_mode(found, frequency_Hz, Eigen::Vector2cd(1.0, 0.0), 0.02, frequency_Hz > 1.0 ? of_others_Hz : deviation_Hz);
    for (ModeDeviation& deviation : found.deviations) deviation.factor = Eigen::MatrixXd::Zero(6, blocks);
    drop_better_than_random(found, 3600.0);
    return found.modes.size();
  };
  EXPECT_EQ(modes_of(0.0004, 0.001, 20), 3U);
  EXPECT_EQ(modes_of(0.0003, 0.001, 20), 2U);
  EXPECT_EQ(modes_of(0.0003, 0.001, 4), 3U);
  EXPECT_EQ(modes_of(0.0003, 0.0003, 20), 3U);
}

// A mode that has lost its poles of high orders lies between a mode below and a chain of its own shape above: split off by
// noise and badly known, that chain makes no mixture of it. A well-known neighbour of another shape does.
TEST(Identify, OnlySettledNeighboursMakeAMixture) {
  const auto modes_of = [&](const Eigen::Vector4cd& above, double deviation_Hz) {
    Identification found;
    const double frequency_Hz[] = {1.0, 1.03, 1.05};
    add_mode(found, frequency_Hz[0], Eigen::Vector4cd(1.0, 0.2, 0.0, 0.0), 0.02, 0.002);
    add_mode(found, frequency_Hz[1], Eigen::Vector4cd(1.0, 1.0, 0.0, 0.0), 0.02, 0.002);
    add_mode(found, frequency_Hz[2], above, 0.02, deviation_Hz);
    for (int order = 2; order <= 60; order += 2) {
      for (int mode = 0; mode < 3; ++mode) {
        const auto m = static_cast<std::size_t>(mode);
        if (mode == 2 && order <= 10) continue;
        DiagramPole pole;
        pole.pole.order = order;
        pole.pole.frequency_Hz = frequency_Hz[m];
        pole.mode = mode;
        if (mode != 1 || order <= 10) found.modes[m].members.push_back(found.diagram.size());
        found.diagram.push_back(pole);
      }
    }
    drop_undetermined(found, options(), 3600.0);
    return found.modes.size();
  };
  EXPECT_EQ(modes_of(Eigen::Vector4cd(1.0, 1.0, 0.0, 0.0), 0.05), 2U);    // the mode and the one below it
  EXPECT_EQ(modes_of(Eigen::Vector4cd(-0.2, 1.0, 0.0, 0.0), 0.002), 2U);  // the two neighbours
}

TEST(Identify, AFrequencyThatTheRecordLeavesOpenIsNoMode) {
  ModeDeviation deviation;
  deviation.damping_ratio = 0.01;
  deviation.frequency_Hz = 0.009;
  EXPECT_TRUE(stays(1.0, 0.05, deviation, 600.0, options()));
  deviation.frequency_Hz = 0.015;  // above 1 % and above three times the least of ten minutes, 1.1 %
  EXPECT_FALSE(stays(1.0, 0.05, deviation, 600.0, options()));
  EXPECT_TRUE(stays(1.0, 0.05, deviation, 150.0, options()));  // a short record knows no mode better
}

// By hand: of 2,000 samples of noise the largest reaches sqrt(2 ln 2000) = 3.90 deviations.
TEST(Identify, AMotionThatNoiseMayHaveIsNoModeOfADecay) {
  Identification found;
  for (const double deviation : {0.0103 / 3.8, 0.0103 / 4.0}) {
    Cluster mode;
    mode.damping_ratio = 0.0103;
    found.modes.push_back(mode);
    found.deviations.emplace_back().damping_ratio = deviation;
  }
  drop_noise_of_a_decay(found, 2000);
  ASSERT_EQ(found.modes.size(), 1U);
  EXPECT_DOUBLE_EQ(found.deviations.front().damping_ratio, 0.0103 / 4.0);
}

TEST(Identify, ChainUnderWhiteNoise) {
  const double rate = 20.0, zeta = 0.01;
  const test::Chain chain(4, 25.0, zeta, rate);
  const Identification found = identified(chain.simulate(60000, 42, 0.05), rate, {0, 1, 2, 3});
  ASSERT_EQ(found.modes.size(), 4U);  // every mode, and none spurious
  for (int r = 0; r < 4; ++r) {
    const Cluster& mode = found.modes[static_cast<std::size_t>(r)];
    const ModeDeviation& deviation = found.deviations[static_cast<std::size_t>(r)];
    EXPECT_NEAR(mode.frequency_Hz / chain.frequency_Hz(r), 1.0, 0.005);
    EXPECT_NEAR(mode.damping_ratio / zeta, 1.0, 0.20);
    const Eigen::MatrixXcd truth = chain.shape(r).cast<std::complex<double>>();
    EXPECT_GT(modal::mac(truth, Eigen::MatrixXcd(mode.shape))(0, 0), 0.99);
    EXPECT_LT(std::abs(mode.frequency_Hz - chain.frequency_Hz(r)), 4.0 * deviation.frequency_Hz);
    EXPECT_LT(std::abs(mode.damping_ratio - zeta), 4.0 * deviation.damping_ratio);
    EXPECT_EQ(deviation.shape_real.size(), 4);
    // Au's law is the least a long record allows; the two strongest modes reach it within the scatter of 20 blocks' sigma (16
    // %).
    const double cycles = 3000.0 * chain.frequency_Hz(r),
                 law = chain.frequency_Hz(r) * std::sqrt(zeta / (2.0 * std::numbers::pi * cycles));
    EXPECT_GT(deviation.frequency_Hz, 0.5 * law);
    if (r < 2) {
      EXPECT_LT(deviation.frequency_Hz, 1.6 * law);
    }
    std::printf("mode %d: %.4f Hz, closed form %.4f, sigma %.4f; damping %.3f %%, sigma %.3f %%\n", r + 1, mode.frequency_Hz,
                chain.frequency_Hz(r), deviation.frequency_Hz, 100.0 * mode.damping_ratio, 100.0 * deviation.damping_ratio);
  }
}

TEST(Identify, BothSelectionsFindTheSameModes) {
  const double rate = 20.0;
  const test::Chain chain(4, 25.0, 0.01, rate);
  const auto blocks = signal::correlations(signal::detrended(chain.simulate(60000, 42, 0.05)), {0, 1, 2, 3}, 50, 20);
  IdentifyOptions paper = options();
  paper.selection = Selection::paper;
  const Identification a = identify(blocks, rate, options()), b = identify(blocks, rate, paper);
  ASSERT_EQ(a.modes.size(), 4U);
  ASSERT_EQ(b.modes.size(), 4U);
  for (std::size_t m = 0; m < 4; ++m) EXPECT_NEAR(a.modes[m].frequency_Hz / b.modes[m].frequency_Hz, 1.0, 1e-3);
}

TEST(PhaseCollinearity, OneForARealShapeAndZeroForACircle) {
  Eigen::VectorXcd real(3), circle(2);
  real << std::polar(1.0, 0.3), -std::polar(2.0, 0.3), std::polar(0.5, 0.3);
  circle << 1.0, std::complex<double>(0.0, 1.0);
  EXPECT_NEAR(phase_collinearity(real), 1.0, 1e-12);
  EXPECT_NEAR(phase_collinearity(circle), 0.0, 1e-12);
}

TEST(Identify, GainAndPolarityOfAChannelChangeItsShapeOnly) {
  // Oracle: property. Correlations scale with the gains, so poles move only as far as the weighting does.
  const double rate = 20.0;
  const test::Chain chain(3, 20.0, 0.01, rate);
  const Eigen::MatrixXd data = chain.simulate(20000, 8, 0.02);
  const Identification plain = identified(data, rate, {0, 1, 2});
  const Identification flipped = identified(data * Eigen::Vector3d(1.0, -1.0, 1.0).asDiagonal(), rate, {0, 1, 2});
  ASSERT_EQ(plain.modes.size(), flipped.modes.size());
  for (std::size_t m = 0; m < plain.modes.size(); ++m) {
    EXPECT_NEAR(plain.modes[m].frequency_Hz, flipped.modes[m].frequency_Hz, 1e-9);
    EXPECT_NEAR(plain.modes[m].damping_ratio, flipped.modes[m].damping_ratio, 1e-9);
    Eigen::VectorXcd back = flipped.modes[m].shape;
    back[1] *= -1.0;
    EXPECT_NEAR(std::norm(back.dot(plain.modes[m].shape)), 1.0, 1e-9);
  }
}

TEST(Identify, OrderAndUnitOfTheChannelsDoNotMatter) {
  // Oracle: property. A permutation permutes the shapes; one unit for all scales every correlation alike.
  const double rate = 20.0;
  const test::Chain chain(3, 20.0, 0.01, rate);
  const Eigen::MatrixXd data = chain.simulate(20000, 8, 0.02);
  const std::vector<Eigen::Index> order = {2, 0, 1};
  const Identification plain = identified(data, rate, {0, 1, 2}),
                       turned = identified(1000.0 * data(Eigen::all, order), rate, {0, 1, 2});
  ASSERT_EQ(plain.modes.size(), turned.modes.size());
  for (std::size_t m = 0; m < plain.modes.size(); ++m) {
    EXPECT_NEAR(plain.modes[m].frequency_Hz, turned.modes[m].frequency_Hz, 1e-9);
    EXPECT_NEAR(plain.modes[m].damping_ratio, turned.modes[m].damping_ratio, 1e-9);
    EXPECT_NEAR(plain.deviations[m].frequency_Hz / turned.deviations[m].frequency_Hz, 1.0, 1e-6);
    EXPECT_NEAR(std::norm(plain.modes[m].shape(order).dot(turned.modes[m].shape)), 1.0, 1e-9);
  }
}

TEST(Identify, DeviationsAreCalibrated) {
  // Normalised errors of 30 seeds and three modes, pooled: 90 values of unit deviation scatter by 7.5 %, and a sigma from 20
  // blocks (19 degrees of freedom) raises their deviation by sqrt(19/17) = 1.06. Calibrated means 0.8 to 1.25.
  const double rate = 20.0, zeta = 0.01;
  const test::Chain chain(3, 20.0, zeta, rate);
  test::NormalisedErrors errors;
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    const Identification found = identified(chain.simulate(30000, seed, 0.05), rate, {0, 1, 2});
    ASSERT_EQ(found.modes.size(), 3U) << "seed " << seed << " " << found.modes.back().frequency_Hz << " "
                                      << found.modes.back().members.size();
    errors.add(found, chain, zeta);
  }
  errors.expect_between(0.8, 1.25);
}

}  // namespace
}  // namespace twindeck::identification
