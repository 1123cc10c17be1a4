// Oracles: free decays of known modes; the spread over seeds for the standard deviations.
#include <gtest/gtest.h>

#include "calibration.hpp"
#include "core/error.hpp"
#include "sysid/era.hpp"
#include "sysid/identify.hpp"

namespace twindeck::sysid {
namespace {

/// Sum of decaying cosines of the chain's modes.
Eigen::MatrixXd decay(const test::Chain& chain, double zeta, double rate, Eigen::Index samples, double noise,
                      std::uint64_t seed) {
  test::Noise random(seed);
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(samples, chain.size());
  for (int r = 0; r < chain.size(); ++r) {
    const double w = 2.0 * std::numbers::pi * chain.frequency_Hz(r);
    for (Eigen::Index t = 0; t < samples; ++t) {
      const double s = static_cast<double>(t) / rate;
      y.row(t) +=
          std::exp(-zeta * w * s) * std::cos(w * std::sqrt(1.0 - zeta * zeta) * s) * chain.shape(r).transpose() / (r + 1.0);
    }
  }
  for (double& value : y.reshaped()) value += noise * random();
  return y;
}

TEST(Era, ExactDecaysGiveTheExactPoles) {
  const test::Chain chain(3, 10.0, 0.02, 20.0);
  const FreeDecay found = era({decay(chain, 0.02, 20.0, 200, 0.0, 1)}, 20, {6}, 20.0, 1, 2);
  const auto& poles = found.models.orders.front().poles;
  ASSERT_EQ(poles.size(), 3U);
  for (int r = 0; r < 3; ++r) {
    EXPECT_NEAR(poles[static_cast<std::size_t>(r)].frequency_Hz, chain.frequency_Hz(r), 1e-8);
    EXPECT_NEAR(poles[static_cast<std::size_t>(r)].damping_ratio, 0.02, 1e-8);
  }
}

TEST(Era, DeviationsAreCalibratedForNoisyDecays) {
  const double rate = 20.0, zeta = 0.02;
  const test::Chain chain(3, 10.0, zeta, rate);
  IdentifyOptions options;
  options.block_rows = 40;
  options.minimum_order = 4;
  options.maximum_order = 16;
  test::NormalisedErrors errors;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const std::vector<Eigen::MatrixXd> decays = {decay(chain, zeta, rate, 240, 0.02, seed),
                                                 decay(chain, zeta, rate, 240, 0.02, 100 + seed)};
    const Identification found = identify_decays(decays, rate, options, seed);
    ASSERT_EQ(found.modes.size(), 3U) << "seed " << seed;
    errors.add(found, chain, zeta);
  }
  // 90 values: 7.5 % scatter, and 7 % from 100 draws.
  errors.expect_between(0.75, 1.3);
}

TEST(Era, TooShortADecayIsRefused) {
  const test::Chain chain(2, 10.0, 0.02, 20.0);
  EXPECT_THROW(static_cast<void>(era({decay(chain, 0.02, 20.0, 30, 0.0, 1)}, 20, {6}, 20.0, 1)), InputError);
}

}  // namespace
}  // namespace twindeck::sysid
