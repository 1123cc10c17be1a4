// Oracle: the modes of the modal model whose functions the test writes into universal files, in closed form.
#include "identification/response_modes.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "../records/scratch.hpp"
#include "core/error.hpp"
#include "hammer_data.hpp"

namespace twindeck::identification {
namespace {

struct HammerCampaign {
  twindeck::test::ModalModel model = twindeck::test::six_modes();
  std::vector<Eigen::Index> fixed = {0, 3};  ///< points of the side that stays
  Eigen::VectorXd lines = twindeck::test::lines_of(5.0, 45.0, 641);
  double noise = 0.01;
  bool binary = false, hammer_roves = false, even = true;
};

/// As the step sets it where nothing is configured.
IdentificationSettings by_default() {
  IdentificationSettings config;
  config.order_is_default = true;
  return config;
}

/// Writes the campaign and reads its only setup.
Conditioned conditioned_test(const HammerCampaign& made, std::uint64_t seed, const IdentificationSettings& config = {}) {
  const records::Scratch scratch;
  const twindeck::test::ModalModel& model = made.model;
  const ResponseData data = twindeck::test::hammer_data(model, made.fixed, made.lines, made.noise, seed);
  std::string text, channels = "channel,quantity,unit\n", names;
  for (Eigen::Index o = 0; o < model.shapes.rows(); ++o) {
    channels += fmt::format("{}+z,acceleration,m/s^2\n", o + 1);
    names += fmt::format("{}\"{}+z\"", o > 0 ? ", " : "", o + 1);
    for (std::size_t i = 0; i < made.fixed.size(); ++i) {
      twindeck::test::WrittenFunction w;
      w.response = made.hammer_roves ? made.fixed[i] + 1 : o + 1;
      w.reference = made.hammer_roves ? o + 1 : made.fixed[i] + 1;
      w.f = made.lines;
      w.even = made.even;
      w.h = data.values.col(o * data.n_inputs + static_cast<Eigen::Index>(i));
      text += universal_function(w, made.binary);
    }
  }
  scratch.write("h.unv", text);
  scratch.write("channels.csv", channels);
  scratch.write("campaign.toml", "[[record]]\nsetup = \"ST1\"\nfile = \"h.unv\"\nchannels = [" + names + "]\n");
  const records::Campaign campaign = records::read_campaign(scratch.file(""));
  return condition_responses(campaign, records::record_groups(campaign, {"", "", records::kFrfKind, {}}).front(), config);
}

void expect_modes(const Identification& found, const std::vector<Eigen::Index>& modes, double least_mac) {
  const twindeck::test::ModalModel model = twindeck::test::six_modes();
  ASSERT_EQ(found.modes.size(), modes.size());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const Cluster& mode = found.modes[k];
    EXPECT_NEAR(mode.frequency_Hz, model.frequency_Hz[modes[k]], 1e-3 * model.frequency_Hz[modes[k]]);
    EXPECT_NEAR(mode.damping_ratio, model.damping_ratio[modes[k]], 0.02 * model.damping_ratio[modes[k]]);
    EXPECT_GT(twindeck::test::mac_with(model, modes[k], mode.shape), least_mac);
  }
}

// 0.1 % of each frequency, 2 % of each damping ratio and a MAC of 0.999: some deviations of the least-squares fit at 1 % of
// noise, the widest (5 %) mode nearest to them. As many modes as there are, for each of 20 seeds.
TEST(ResponseModes, FindsTheModesOfTwentyTestsAndNoOthers) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    HammerCampaign made;
    made.binary = seed % 2 == 0;
    made.hammer_roves = seed % 3 == 0;
    if (seed % 4 == 0) made.fixed = {0};
    expect_modes(identify_responses(conditioned_test(made, seed), by_default()), {0, 1, 2, 3, 4, 5}, 0.999);
  }
}

// None of the noise, half of it and twice of it.
TEST(ResponseModes, CountIsRightAtLessAndMoreNoise) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const double noise : {0.0, 0.005, 0.02}) {
      SCOPED_TRACE(fmt::format("seed {}, noise {}", seed, noise));
      HammerCampaign made;
      made.noise = noise;
      EXPECT_EQ(identify_responses(conditioned_test(made, seed), by_default()).modes.size(), 6U);
    }
}

// Two modes 1.2 % apart, with 1.0 % and 1.2 % of damping, from one reference; and the close pair of the others at 5 % of noise.
TEST(ResponseModes, CloseModesAreTwoFromOneReference) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    HammerCampaign made;
    made.fixed = {0};
    made.model.frequency_Hz[1] = 8.1;
    EXPECT_EQ(identify_responses(conditioned_test(made, seed), by_default()).modes.size(), 6U);
    made.model.frequency_Hz[1] = 8.35;
    made.noise = 0.05;
    EXPECT_EQ(identify_responses(conditioned_test(made, seed), by_default()).modes.size(), 6U);
  }
}

// A band between modes: three are inside, next to two below and one above it.
TEST(ResponseModes, ABandOfTheConfigurationGivesItsModes) {
  IdentificationSettings config = by_default();
  config.lowest_Hz = 12.0;
  config.highest_Hz = 35.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const Conditioned conditioned = conditioned_test({}, seed, config);
    EXPECT_EQ(conditioned.responses.frequency_Hz.size(), 369);
    EXPECT_EQ(identify_responses(conditioned, config).modes.size(), 3U);
  }
}

TEST(ResponseModes, UnevenLinesAreIdentified) {
  HammerCampaign made;
  made.lines = made.lines.unaryExpr([](double f) { return f + 0.02 * std::sin(40.0 * f); });
  made.even = false;
  const Conditioned conditioned = conditioned_test(made, 1);
  expect_modes(identify_responses(conditioned, by_default()), {0, 1, 2, 3, 4, 5}, 0.999);
  EXPECT_EQ(response_spectra(conditioned.responses).frequency_Hz.size(), 0);
}

TEST(ResponseModes, TooFewLinesAreRefused) {
  HammerCampaign made;
  made.lines = twindeck::test::lines_of(5.0, 45.0, 30);
  const auto refused = [&](const IdentificationSettings& config) -> std::string {
    try {
      static_cast<void>(conditioned_test(made, 1, config));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string few = refused({});
  EXPECT_NE(few.find("h.unv"), std::string::npos) << few;
  EXPECT_NE(few.find("has 30 frequency lines above 0 Hz, expected 40 or more"), std::string::npos) << few;
  made.lines = twindeck::test::lines_of(5.0, 45.0, 641);
  IdentificationSettings narrow;
  narrow.lowest_Hz = 20.0;
  narrow.highest_Hz = 21.0;
  EXPECT_NE(refused(narrow).find("leaves 17 frequency lines"), std::string::npos) << refused(narrow);
}

// The peaks of the first singular value stand at the modes that are far from others, within a line.
TEST(ResponseModes, SingularValuesPeakAtTheModes) {
  const Conditioned conditioned = conditioned_test({}, 1);
  const SingularSpectra spectra = response_spectra(conditioned.responses);
  ASSERT_EQ(spectra.values.cols(), 2);
  const twindeck::test::ModalModel model = twindeck::test::six_modes();
  for (const Eigen::Index r : {2, 4}) {
    Eigen::Index peak = 0;
    const auto from_line = static_cast<Eigen::Index>((model.frequency_Hz[r] - 1.0 - 5.0) * 16.0);
    spectra.values.col(0).segment(from_line, 32).maxCoeff(&peak);
    EXPECT_NEAR(spectra.frequency_Hz[from_line + peak], model.frequency_Hz[r], 0.0626);
  }
}

}  // namespace
}  // namespace twindeck::identification
