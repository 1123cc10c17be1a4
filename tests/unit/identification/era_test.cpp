// Oracles: free decays of known modes; the spread over seeds for the standard deviations.
#include "identification/era.hpp"

#include <gtest/gtest.h>

#include "calibration.hpp"
#include "core/error.hpp"
#include "identification/identify.hpp"

namespace twindeck::identification {
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

/// Of the modes found, the ones nearest to the chain's.
Identification nearest_to(const test::Chain& chain, const Identification& found) {
  Identification nearest;
  for (int r = 0; r < chain.size(); ++r) {
    const auto distance = [&](const Cluster& mode) { return std::abs(mode.frequency_Hz - chain.frequency_Hz(r)); };
    const auto at = std::min_element(found.modes.begin(), found.modes.end(),
                                     [&](const Cluster& a, const Cluster& b) { return distance(a) < distance(b); });
    nearest.modes.push_back(*at);
    nearest.deviations.push_back(found.deviations[static_cast<std::size_t>(at - found.modes.begin())]);
  }
  return nearest;
}

// A decay on top of ambient vibration of the same modes: the deviations hold with a record of that vibration to tell how strong
// it is, and are far too small without, for the model takes part of the vibration for decay.
TEST(Era, DeviationsAreCalibratedForDecaysUnderAmbientVibration) {
  const double rate = 20.0, zeta = 0.02, level = 0.02;
  const test::Chain chain(3, 10.0, zeta, rate);
  IdentifyOptions options;
  options.block_rows = 40;
  options.minimum_order = 6;
  options.maximum_order = 16;
  test::NormalisedErrors with, without;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Eigen::MatrixXd ambient = level * chain.simulate(240 + 600, seed, 0.05);
    const std::vector<Eigen::MatrixXd> decays = {decay(chain, zeta, rate, 240, 0.0, seed) + ambient.topRows(240)};
    const Identification found = identify_decays(decays, rate, options, seed, {ambient.bottomRows(600)});
    const Identification blind = identify_decays(decays, rate, options, seed);
    ASSERT_GE(found.modes.size(), 3U) << "seed " << seed;
    ASSERT_GE(blind.modes.size(), 3U) << "seed " << seed;
    with.add(nearest_to(chain, found), chain, zeta);
    without.add(nearest_to(chain, blind), chain, zeta);
  }
  // As above; a quiet record of 30 s has about six lines within a mode's bandwidth: another 20 % of a deviation, which is one
  // for all.
  with.expect_between(0.7, 1.4);
  without.expect_between(2.0, 1e3);
}

TEST(Era, TooShortADecayIsRefused) {
  const test::Chain chain(2, 10.0, 0.02, 20.0);
  EXPECT_THROW(static_cast<void>(era({decay(chain, 0.02, 20.0, 30, 0.0, 1)}, 20, {6}, 20.0, 1)), InputError);
}

}  // namespace
}  // namespace twindeck::identification
