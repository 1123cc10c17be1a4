// Oracles: hand calculations on chosen shapes; free decays of one oscillator and a steady motion in closed form.
#include "identification/decays.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace twindeck::identification {
namespace {

std::vector<records::CampaignChannel> named_channels(const std::vector<std::string>& names) {
  std::vector<records::CampaignChannel> channels;
  for (const std::string& name : names) channels.emplace_back().name = name;
  return channels;
}

identification::Cluster mode_of(double frequency_Hz, const Eigen::VectorXcd& shape) {
  identification::Cluster mode;
  mode.frequency_Hz = frequency_Hz;
  mode.shape = shape;
  return mode;
}

/// A condition over the channels a, b, c.
ConditionResult condition_of(const std::vector<std::pair<double, Eigen::Vector3cd>>& modes) {
  ConditionResult result;
  result.channels = named_channels({"a", "b", "c"});
  for (const auto& [frequency_Hz, shape] : modes) {
    result.modes.emplace_back().frequency_Hz = frequency_Hz;
    result.modes.back().shape = shape;
  }
  return result;
}

// The decay's channels stand in another order and one is unknown to the condition: names pair them.
TEST(PartnerOf, IsTheModeOfLikeShapeOverCommonChannels) {
  const ConditionResult ambient = condition_of({{1.02, {1.0, -1.0, 0.5}}, {1.0, {1.0, 1.0, 0.5}}});
  const auto partner = partner_of(mode_of(1.0, Eigen::Vector3cd(7.0, -1.0, 1.0)), named_channels({"x", "b", "a"}), &ambient);
  ASSERT_TRUE(partner.has_value());
  EXPECT_EQ(partner->mode, 0U);
  EXPECT_NEAR(partner->mac, 1.0, 1e-14);
}

// |f/f' - 1| <= 0.1 of the decay's own frequency: 1.1 is within, 1.101 is not. A MAC of (1 + 0.5)²/(2 · 1.25) = 0.9 is enough,
// of 0.8 not: (2 + 1)²/(2 · 5) = 0.9 as well, and (1 + 1/3)²/(2 · 10/9) = 0.8.
TEST(PartnerOf, FrequencyAndShapeMustBothAgree) {
  const auto channels = named_channels({"a", "b"});
  const auto mac_with = [&](double frequency_Hz, double second) {
    const ConditionResult ambient = condition_of({{frequency_Hz, {1.0, second, 0.0}}});
    return partner_of(mode_of(1.0, Eigen::Vector2cd(1.0, 1.0)), channels, &ambient);
  };
  EXPECT_TRUE(mac_with(1.0999, 0.5).has_value());
  EXPECT_NEAR(mac_with(1.0, 0.5)->mac, 0.9, 1e-14);
  EXPECT_TRUE(mac_with(0.9001, 0.5).has_value());
  EXPECT_FALSE(mac_with(1.1001, 0.5).has_value());
  EXPECT_FALSE(mac_with(0.8999, 0.5).has_value());
  EXPECT_TRUE(mac_with(1.0, 1.0 / 3.0 + 1e-6).has_value());
  EXPECT_FALSE(mac_with(1.0, 1.0 / 3.0 - 1e-6).has_value());
}

// A complex factor of a shape does not count; its conjugate is another shape: |1 - 1|²/4 = 0.
TEST(PartnerOf, AComplexShapeIsNotItsConjugate) {
  const std::complex<double> i(0.0, 1.0);
  const ConditionResult ambient = condition_of({{1.0, {1.0, i, 0.0}}});
  const auto channels = named_channels({"a", "b"});
  EXPECT_TRUE(partner_of(mode_of(1.0, Eigen::Vector2cd(i, -1.0)), channels, &ambient).has_value());
  EXPECT_FALSE(partner_of(mode_of(1.0, Eigen::Vector2cd(1.0, -i)), channels, &ambient).has_value());
}

// A channel that the condition does not know (NaN) does not count, and a mode without a common one is no partner.
TEST(PartnerOf, ChannelsThatAreUnknownDoNotCount) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ConditionResult ambient = condition_of({{1.0, {1.0, {nan, nan}, 0.5}}});
  const identification::Cluster mode = mode_of(1.0, Eigen::Vector3cd(1.0, 9.0, 0.5));
  const auto partner = partner_of(mode, ambient.channels, &ambient);
  ASSERT_TRUE(partner.has_value());
  EXPECT_NEAR(partner->mac, 1.0, 1e-14);
  EXPECT_FALSE(partner_of(mode, named_channels({"x", "y", "z"}), &ambient).has_value());
  EXPECT_FALSE(partner_of(mode, ambient.channels, nullptr).has_value());
}

TEST(ConditionNamed, IsFoundByItsNameOrNull) {
  std::vector<ConditionResult> results(2);
  results[0].condition = "summer";
  results[1].condition = "winter";
  EXPECT_EQ(condition_named(results, "winter"), &results[1]);
  EXPECT_EQ(condition_named(results, "spring"), nullptr);
  EXPECT_EQ(condition_named({}, "winter"), nullptr);
}

TEST(QuantityAtLargest, IsThatOfTheLargestMagnitude) {
  auto channels = named_channels({"a", "b", "c"});
  channels[1].quantity = "displacement";
  channels[2].quantity = "velocity";
  EXPECT_EQ(quantity_at_largest(channels, Eigen::Vector3cd(0.5, {-0.3, 0.6}, 0.6)), "displacement");
  EXPECT_EQ(quantity_at_largest(channels, Eigen::Vector3cd(0.5, 0.1, -0.6)), "velocity");
}

// A sine of amplitude A at the channel of the largest component: the modal RMS is A/sqrt(2), and sqrt(2) times it is A. The
// record's ends spoil some periods of the filter, of 400: 2 %. Two records are averaged by their length.
TEST(AmbientAmplitudes, ASteadySineHasItsAmplitude) {
  const double rate = 20.0, f = 1.0;
  const Eigen::Vector2cd shape(0.5, 1.0);
  ConditionResult result;
  result.condition = "summer";
  SetupResult setup;
  setup.conditioned.setup = "S1";
  setup.conditioned.channels = named_channels({"a", "b"});
  setup.conditioned.channels[1].quantity = "velocity";
  setup.conditioned.rate_Hz = rate;
  for (const auto& [amplitude, n] : {std::pair{3.0, 12000}, std::pair{1.0, 4000}}) {
    Eigen::MatrixXd data(n, 2);
    for (Eigen::Index t = 0; t < n; ++t) {
      const double value = amplitude * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(t) / rate);
      data.row(t) << 0.5 * value, value;
    }
    setup.conditioned.records.emplace_back(data);
  }
  setup.found.modes = {mode_of(f, shape.normalized())};
  result.setups.push_back(setup);
  result.modes.emplace_back().frequency_Hz = f;
  result.modes.back().damping_ratio = 0.01;
  result.modes.back().members = {{0, 0}};
  const auto amplitudes = ambient_amplitudes({result}, {});
  ASSERT_EQ(amplitudes.size(), 1U);
  // Mean square over 600 s and 200 s: (3 · 9 + 1)/4 = 7.
  EXPECT_NEAR(amplitudes[0].amplitude, std::sqrt(7.0), 0.02 * std::sqrt(7.0));
  EXPECT_NEAR(amplitudes[0].seconds, 800.0, 1e-9);
  EXPECT_EQ(amplitudes[0].quantity, "velocity");
  EXPECT_EQ(amplitudes[0].setup, "S1");
  EXPECT_EQ(amplitudes[0].condition, "summer");
}

/// A decay of one oscillator from `release_s` on, two channels in the ratio 1 : -0.5, quiet before.
Conditioned released(double frequency_Hz, double damping_ratio, double release_s) {
  const double rate = 20.0, omega = 2.0 * std::numbers::pi * frequency_Hz;
  Eigen::MatrixXd data = Eigen::MatrixXd::Zero(4000, 2);
  for (Eigen::Index k = 0; k < data.rows(); ++k) {
    const double t = static_cast<double>(k) / rate - release_s;
    const double value =
        t < 0.0 ? 0.0
                : std::exp(-damping_ratio * omega * t) * std::cos(omega * std::sqrt(1.0 - damping_ratio * damping_ratio) * t);
    data.row(k) << value, -0.5 * value;
  }
  Conditioned conditioned;
  conditioned.setup = "S1";
  conditioned.condition = "summer";
  conditioned.channels = named_channels({"a", "b"});
  conditioned.references = {0, 1};
  conditioned.rate_Hz = rate;
  conditioned.records.emplace_back(data);
  conditioned.files = {"decay.csv"};
  return conditioned;
}

// ERA of a decay without noise is exact but for what rounding lets in: 1e-6. The filter adds the mode's image at -f, at the
// ends.
TEST(IdentifyFreeDecays, ADecayHasItsFrequencyAndDamping) {
  ConditionResult ambient = condition_of({{1.01, {1.0, -0.5, 0.0}}});
  ambient.condition = "summer";
  IdentificationSettings config;
  config.largest_deviation = 0.0;
  const auto decays = identify_free_decays({released(1.0, 0.01, 5.0)}, config, {ambient}, 1);
  ASSERT_EQ(decays.size(), 1U);
  ASSERT_GE(decays[0].found.modes.size(), 1U);
  const identification::Cluster& mode = decays[0].found.modes[0];
  EXPECT_NEAR(mode.frequency_Hz, 1.0, 1e-6);
  EXPECT_NEAR(mode.damping_ratio, 0.01, 1e-6);
  EXPECT_NEAR((mode.shape[1] / mode.shape[0]).real(), -0.5, 1e-6);
  ASSERT_GE(decays[0].by_amplitude.size(), 1U);
  EXPECT_EQ(decays[0].by_amplitude[0].mode, "1");
  EXPECT_EQ(decays[0].by_amplitude[0].record, "decay.csv");
  ASSERT_GE(decays[0].by_amplitude[0].points.size(), 2U);
  double before = std::numeric_limits<double>::infinity();
  for (const identification::AmplitudePoint& point : decays[0].by_amplitude[0].points) {
    EXPECT_NEAR(point.frequency_Hz, 1.0, 1e-4);
    EXPECT_NEAR(point.damping_ratio, 0.01, 1e-4);
    EXPECT_TRUE(point.amplitude < before && point.amplitude <= 1.0);  // falling, below the release's
    before = point.amplitude;
  }
}

// Two oscillators: beyond the reach that is told of the motion, none is looked for.
TEST(IdentifyFreeDecays, TheBandEndsWhereTheMotionDoes) {
  Conditioned decay = released(1.0, 0.01, 5.0);
  Eigen::MatrixXd both = decay.records.front();
  both += 0.1 * Eigen::MatrixXd(released(5.0, 0.01, 5.0).records.front());
  decay.records = {Samples(both)};
  IdentificationSettings config;
  config.largest_deviation = 0.0;
  for (const double reach : {0.0, 1.2}) {
    decay.reach_Hz = reach;
    const auto modes = identify_free_decays({decay}, config, {}, 1).front().found.modes;
    const bool high = std::any_of(modes.begin(), modes.end(), [](const Cluster& m) { return m.frequency_Hz > 1.4; });
    EXPECT_EQ(high, reach == 0.0) << reach;
    EXPECT_TRUE(
        std::any_of(modes.begin(), modes.end(), [](const Cluster& m) { return std::abs(m.frequency_Hz - 1.0) < 1e-3; }));
  }
}

}  // namespace
}  // namespace twindeck::identification
