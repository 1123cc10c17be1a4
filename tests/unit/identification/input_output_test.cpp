// Oracle: a discrete system of known poles driven by a coloured input that is measured: its poles, and not the input's, come
// out.
#include "identification/input_output.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"
#include "core/error.hpp"
#include "identification/efdd.hpp"

namespace twindeck::identification {
namespace {

struct Record {
  Eigen::MatrixXd input, output;
};

/// Two modes under a base motion that rings at 3 Hz with 2 % damping itself.
Record simulated(Eigen::Index n, double noise) {
  const double rate = 25.0;
  test::Noise random(5);
  const auto pole = [rate](double f, double z) {
    return std::exp(std::complex<double>(-z, std::sqrt(1.0 - z * z)) * 2.0 * std::numbers::pi * f / rate);
  };
  const std::complex<double> p[] = {pole(1.7, 0.02), pole(4.1, 0.015)}, ring = pole(3.0, 0.02);
  std::complex<double> x[2] = {0.0, 0.0}, s = 0.0;
  Record record{Eigen::MatrixXd(n, 1), Eigen::MatrixXd(n, 2)};
  for (Eigen::Index t = 0; t < n; ++t) {
    s = ring * s + random();
    const double u = s.imag() + 0.3 * random();
    record.input(t, 0) = u;
    record.output(t, 0) = x[0].imag() + x[1].imag() + noise * random();
    record.output(t, 1) = 0.6 * x[0].imag() - 1.3 * x[1].imag() + noise * random();
    for (int k = 0; k < 2; ++k) x[k] = p[k] * x[k] + u;
  }
  return record;
}

TEST(InputOutput, FindsTheSystemAndNotTheExcitation) {
  const Record record = simulated(6000, 0.2);
  IdentifyOptions options;
  options.block_rows = 20;
  options.minimum_order = 4;
  options.maximum_order = 20;
  const Identification found = identify_input_output(record.input, record.output, 25.0, options);
  ASSERT_EQ(found.modes.size(), 2U);
  const double frequency[] = {1.7, 4.1}, damping[] = {0.02, 0.015};
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_NEAR(found.modes[m].frequency_Hz / frequency[m], 1.0, 0.003);
    EXPECT_NEAR(found.modes[m].damping_ratio, damping[m], 0.002);
    EXPECT_GT(found.deviations[m].frequency_Hz, 0.0);
    EXPECT_LT(std::abs(found.modes[m].frequency_Hz - frequency[m]), 5.0 * found.deviations[m].frequency_Hz);
  }
}

// n - 2p + 1 columns. One input and two outputs: at least twice the 6p rows, n = 14p - 1. In ten blocks, 2p + 1 columns each:
// n = 22p + 9.
TEST(InputOutput, AsManyBlockRowsAsTheRecordCarriesAreTaken) {
  IdentifyOptions options;
  options.block_rows = 20;
  options.maximum_order = 8;
  const auto taken = [&](Eigen::Index samples, int n_blocks) {
    const Record record = simulated(samples, 0.1);
    try {
      static_cast<void>(identify_input_output(record.input, record.output, 25.0, options, n_blocks));
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("carries at most 19"), std::string::npos) << error.what();
      return false;
    }
    return true;
  };
  EXPECT_TRUE(taken(279, 2));
  EXPECT_FALSE(taken(278, 2));
  EXPECT_TRUE(taken(449, 10));
  EXPECT_FALSE(taken(448, 10));
}

TEST(InputOutput, TooShortARecordIsRefused) {
  const Record record = simulated(200, 0.1);
  EXPECT_THROW(static_cast<void>(identify_input_output(record.input, record.output, 25.0, {})), InputError);
}

TEST(Efdd, AgreesWithTheClosedForm) {
  // 200 segments of 82 s: the window's bias of the damping is 1.5/(pi 82 · 2.46) = 0.24 %, so within 0.5 % of critical.
  const double rate = 20.0, zeta = 0.01;
  const test::Chain chain(3, 20.0, zeta, rate);
  const auto spectra = singular_spectra(signal::cross_spectra(chain.simulate(160000, 9, 0.02), rate, {1640, 0.5}), 2);
  for (int r = 0; r < 3; ++r) {
    const EfddMode mode = efdd(spectra, 1.003 * chain.frequency_Hz(r));
    ASSERT_TRUE(mode.found);
    EXPECT_NEAR(mode.frequency_Hz / chain.frequency_Hz(r), 1.0, 0.003);
    EXPECT_NEAR(mode.damping_ratio, zeta, 0.005);
    EXPECT_GT(std::norm(mode.shape.dot(chain.shape(r).cast<std::complex<double>>())), 0.99);
  }
}

}  // namespace
}  // namespace twindeck::identification
