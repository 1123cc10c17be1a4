// Oracle: a chain whose modes are known, in noise that the channels do not share.
#include "identification/common_motion.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::identification {
namespace {

constexpr double kRate_Hz = 100.0;

Eigen::MatrixXd noise(Eigen::Index n_samples, Eigen::Index n_channels, std::uint64_t seed) {
  test::Noise random(seed);
  Eigen::MatrixXd data(n_samples, n_channels);
  for (double& value : data.reshaped()) value = random();
  return data;
}

TEST(CommonMotion, EndsAboveTheHighestMode) {
  const test::Chain chain(6, 25.0, 0.01, kRate_Hz);
  const double highest = chain.frequency_Hz(5);
  const double end = highest_common_Hz({chain.simulate(60000, 5, 0.05)}, kRate_Hz);
  EXPECT_GT(end, highest);
  EXPECT_LT(end, 2.0 * highest);  // its flank stands out of the noise for a while; the Nyquist frequency is six times as high
}

// Short records, few and many channels, a loud channel: 200 draws without a false alarm.
TEST(CommonMotion, NoiseHasNone) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    for (const Eigen::Index channels : {2, 4, 12, 24}) {
      Eigen::MatrixXd data = noise(4000, channels, seed);
      data.col(0) *= 100.0;
      EXPECT_EQ(highest_common_Hz({data}, kRate_Hz), 0.0) << channels << " channels, seed " << seed;
    }
  }
}

// A sixtieth of the record with half overlap, as long as the spectra stay within 256 MB.
TEST(CommonMotion, SpectraOfLongRecordsStaySmall) {
  EXPECT_EQ(common_motion_segment(72000, 24), 2 * 72000 / 61);
  for (const Eigen::Index channels : {2, 16, 64, 256, 1000}) {
    const Eigen::Index segment = common_motion_segment(100'000'000, channels);
    EXPECT_GE(segment, 64);
    const double megabytes = 16e-6 * static_cast<double>(channels * channels * (segment / 2 + 1));
    EXPECT_LE(megabytes, channels < 500 ? 270.0 : 600.0) << channels << " channels";
  }
}

TEST(CommonMotion, OneChannelOrTooFewSamplesSayNothing) {
  EXPECT_EQ(highest_common_Hz({noise(4000, 1, 1)}, kRate_Hz), 0.0);
  EXPECT_EQ(highest_common_Hz({noise(40, 4, 1)}, kRate_Hz), 0.0);
}

}  // namespace
}  // namespace twindeck::identification
