// Oracle: a record made of closed-form modes, a steady machine and its second multiple. The machine's lines are marked; modes
// and narrow noise are not.
#include "identification/periodic.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "chain.hpp"
#include "core/random.hpp"
#include "identification/identify.hpp"
#include "signal/condition.hpp"

namespace twindeck::identification {
namespace {

constexpr double kLine_Hz = 1.7;

/// Four modes of a chain (2.46 Hz the first) and, of amplitude `level`, lines at 1.7 and 3.4 Hz.
Eigen::MatrixXd record_with_machine(double level) {
  const test::Chain chain(4, 25.0, 0.01, 20.0);
  Eigen::MatrixXd data = chain.simulate(20000, 42, 0.05);
  const Eigen::RowVector4d motion(0.3, 1.0, -0.5, 0.7);
  for (Eigen::Index t = 0; t < data.rows(); ++t) {
    const double angle = 2.0 * std::numbers::pi * kLine_Hz * static_cast<double>(t) / 20.0;
    data.row(t) += level * (std::sin(angle) * motion + 0.4 * std::sin(2.0 * angle + 0.7) * motion.reverse());
  }
  return signal::detrended(data);
}

Identification identified_with_machine(double level) {
  const Eigen::MatrixXd data = record_with_machine(level);
  IdentifyOptions options;
  options.block_rows = 25;
  options.maximum_order = 40;
  Identification found = identify(signal::correlations(data, {0, 1, 2, 3}, 50, 20), 20.0, options);
  mark_periodic(found, {data}, 20.0, options.periodic);
  return found;
}

TEST(Periodic, LinesOfAMachineAreMarkedAndNoModes) {
  const test::Chain chain(4, 25.0, 0.01, 20.0);
  const Identification found = identified_with_machine(0.5);
  ASSERT_EQ(found.periodic.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const double multiple = static_cast<double>(k + 1);
    EXPECT_NEAR(found.periodic[k].frequency_Hz, multiple * kLine_Hz, 0.001);
    EXPECT_EQ(found.periodic[k].multiple, static_cast<int>(k + 1));
    EXPECT_LT(found.periodic[k].kurtosis, 1.3);
  }
  ASSERT_EQ(found.modes.size(), 4U);
  for (int r = 0; r < 4; ++r)
    EXPECT_NEAR(found.modes[static_cast<std::size_t>(r)].frequency_Hz / chain.frequency_Hz(r), 1.0, 0.01);
}

TEST(Periodic, WithoutAMachineNothingIsMarked) {
  const Identification found = identified_with_machine(0.0);
  EXPECT_TRUE(found.periodic.empty());
  EXPECT_EQ(found.modes.size(), 4U);
}

TEST(Periodic, AModeTakenForACandidateHasTheKurtosisOfNoise) {
  // Even with a pole without damping at its frequency: the envelope decides. 1000 s hold some 80 independent values of this
  // mode.
  const test::Chain chain(4, 25.0, 0.01, 20.0);
  PeriodicLine candidate{chain.frequency_Hz(0), 0.0, chain.shape(0).cast<std::complex<double>>()};
  EXPECT_TRUE(periodic_lines({candidate}, {record_with_machine(0.5)}, 20.0, {}).empty());
  candidate.frequency_Hz = kLine_Hz;
  EXPECT_EQ(periodic_lines({candidate}, {record_with_machine(0.5)}, 20.0, {}).size(), 1U);
}

// A machine of known lines is added to a record and taken out again: what is left is the record without it. Only the first line
// is told; its multiple is found by its phase.
TEST(Periodic, WithoutItsLinesTheRecordIsAsIfTheMachineStoodStill) {
  const Eigen::MatrixXd still = record_with_machine(0.0), running = record_with_machine(0.5);
  const double line = (running - still).norm();
  std::vector<Samples> records = {running};
  const PeriodicLine known{kLine_Hz, 0.0, Eigen::Vector4cd(0.3, 1.0, -0.5, 0.7)};
  const std::vector<PeriodicLine> all = without_lines(records, {known}, 20.0, 0.1, 8.0, {});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].multiple, 2);
  EXPECT_NEAR(all[1].frequency_Hz, 2.0 * kLine_Hz, 1e-9);
  EXPECT_LT((records.front() - still).norm(), 0.05 * line);  // the phase is known to some hundredths: noise lies in its band
}

// Only the second multiple is told: the machine's own speed, of which it is twice, is found and taken out too.
TEST(Periodic, TheSpeedItselfIsFoundFromItsMultiple) {
  const Eigen::MatrixXd still = record_with_machine(0.0), running = record_with_machine(0.5);
  const double line = (running - still).norm();
  std::vector<Samples> records = {running};
  const PeriodicLine known{2.0 * kLine_Hz, 0.0, Eigen::Vector4cd(0.7, -0.5, 1.0, 0.3)};
  const std::vector<PeriodicLine> all = without_lines(records, {known}, 20.0, 0.1, 8.0, {});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_NEAR(all[0].frequency_Hz, kLine_Hz, 1e-9);
  EXPECT_EQ(all[0].multiple, 1);
  EXPECT_EQ(all[1].multiple, 2);
  EXPECT_LT((records.front() - still).norm(), 0.1 * line);  // the weaker line's phase is known half as well
  records = {running};
  EXPECT_EQ(without_lines(records, {known}, 20.0, 2.0, 8.0, {}).size(), 1U);  // below the band nothing is looked for
}

// In a record without a machine nothing turns with a multiple: what is taken out is the little that fits by chance.
TEST(Periodic, NoMultipleIsFoundInNoise) {
  const Eigen::MatrixXd still = record_with_machine(0.0);
  std::vector<Samples> records = {still};
  const PeriodicLine none{kLine_Hz, 0.0, Eigen::Vector4cd(0.3, 1.0, -0.5, 0.7)};
  EXPECT_EQ(without_lines(records, {none}, 20.0, 0.1, 8.0, {}).size(), 1U);
  EXPECT_LT((records.front() - still).norm(), 0.05 * still.norm());
}

// A line that turns evenly and nothing else, decimated and detrended as a step does it: next to nothing is left, also at the
// ends, and what is left of a noisy one is its noise.
TEST(Periodic, OfAPureSineNothingIsLeft) {
  const double rate_Hz = 100.0 / 4.0, line_Hz = 3.1;
  for (const double noise : {0.0, 1e-4}) {
    Eigen::MatrixXd data(6000, 2);
    for (Eigen::Index t = 0; t < data.rows(); ++t) {
      const double wave = std::sin(2.0 * std::numbers::pi * line_Hz * static_cast<double>(t) / 100.0 + 0.3);
      for (Eigen::Index c = 0; c < 2; ++c)
        data(t, c) = (c == 0 ? 1.0 : -0.6) * wave +
                     noise * normal_number(5, static_cast<std::uint64_t>(c), static_cast<std::uint64_t>(t));
    }
    std::vector<Samples> records = {signal::detrended(signal::decimated(signal::detrended(data), 4))};
    const PeriodicLine known{line_Hz + 1e-4, 0.0, Eigen::Vector2cd(1.0, -0.6)};
    EXPECT_EQ(without_lines(records, {known}, rate_Hz, 0.1, 10.0, {}).size(), 1U);
    const double left = records.front().norm() / std::sqrt(static_cast<double>(records.front().size()));
    EXPECT_LT(left, noise == 0.0 ? 1e-9 : 0.6 * noise);  // decimation by four halves the noise
  }
}

/// A mode at `f_Hz` with its deviations: is it taken for the line at 1.7 Hz?
bool is_taken_for_the_line(double f_Hz, double f_std_Hz, double zeta, double zeta_std) {
  Identification setup;
  Cluster mode;
  mode.frequency_Hz = f_Hz;
  mode.damping_ratio = zeta;
  ModeDeviation deviation;
  deviation.frequency_Hz = f_std_Hz;
  deviation.damping_ratio = zeta_std;
  setup.modes.push_back(mode);
  setup.deviations.push_back(deviation);
  Identification other;
  other.periodic.push_back({kLine_Hz, 0.0, Eigen::VectorXcd()});
  drop_lines_of_others({&setup, &other}, {});
  return setup.modes.empty();
}

TEST(Periodic, WhatALineLeavesIsNoModeInAnySetup) {
  EXPECT_TRUE(is_taken_for_the_line(1.7005, 0.0002, 0.0015, 0.0004));
  EXPECT_TRUE(is_taken_for_the_line(1.704, 0.003, 0.005, 0.0025));    // badly known: it may well be the line
  EXPECT_FALSE(is_taken_for_the_line(1.704, 0.001, 0.0015, 0.0004));  // four deviations away
  EXPECT_FALSE(is_taken_for_the_line(1.7005, 0.0002, 0.008, 0.002));  // damped as a structure
}

}  // namespace
}  // namespace twindeck::identification
