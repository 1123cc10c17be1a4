// Oracle: the modes that the record of the benchmark was made with: fourteen of fourteen within 0.5 %, none spurious, by both
// methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "bench/identification_record.hpp"
#include "identification/identify.hpp"
#include "signal/condition.hpp"

namespace twindeck::identification {
namespace {

std::vector<Eigen::Index> all_channels() {
  std::vector<Eigen::Index> channels(16);
  std::iota(channels.begin(), channels.end(), 0);
  return channels;
}

IdentifyOptions bench_options() {
  IdentifyOptions options;
  options.block_rows = 50;
  options.limits.highest_Hz = 8.0;  // the generator's band
  return options;
}

bool has_all_modes_and_no_other(const Identification& found) {
  if (found.modes.size() != bench::kRecordFrequencies_Hz.size()) return false;
  for (std::size_t m = 0; m < found.modes.size(); ++m) {
    if (std::abs(found.modes[m].frequency_Hz / bench::kRecordFrequencies_Hz[m] - 1.0) >= 0.005) return false;
  }
  return true;
}

Identification identified(std::uint64_t seed) {
  const Eigen::MatrixXd data = signal::detrended(bench::identification_record(60000, seed));
  return identify(signal::correlations(data, all_channels(), 100, 20), bench::kRecordRate_Hz, bench_options());
}

// Other noise and other shapes of the same modes. The seeds are consecutive and were chosen before any of them was run. The
// rule was built on others: 20260101 to 20260150 and 20270101 to 20270150.
TEST(BenchRecord, FiftyOtherRecords) {
  if (std::getenv("TWINDECK_SLOW") == nullptr) GTEST_SKIP() << "half a minute: set TWINDECK_SLOW=1";
  for (std::uint64_t seed = 20280101; seed < 20280151; ++seed)
    EXPECT_TRUE(has_all_modes_and_no_other(identified(seed))) << "seed " << seed;
}

// From order 30 on the mode at 7.4 Hz of these records is two poles of one shape, which the data cannot tell apart. The one or
// two orders that have a single pole know its frequency at least four times better than either half.
TEST(BenchRecord, AModeThatSplitsInTwoIsKnownFromTheOrdersThatHaveItWhole) {
  for (const std::uint64_t seed : {20260131U, 20270132U}) {
    const Identification found = identified(seed);
    ASSERT_TRUE(has_all_modes_and_no_other(found)) << seed;
    for (const std::size_t i : found.modes.back().members) EXPECT_LT(found.diagram[i].pole.order, 30);
    EXPECT_LT(found.deviations.back().frequency_Hz, 0.005);
    EXPECT_LT(std::abs(found.modes.back().frequency_Hz - 7.4), 4.0 * found.deviations.back().frequency_Hz);
  }
}

TEST(BenchRecord, FourteenOfFourteenModesAndNoneSpurious) {
  const Eigen::MatrixXd data = signal::detrended(bench::identification_record());
  const std::vector<Eigen::Index> references = all_channels();
  const auto blocks = signal::correlations(data, references, 100, 20);
  const IdentifyOptions options = bench_options();
  const Identification covariance = identify(blocks, bench::kRecordRate_Hz, options);
  const Identification direct = identify_from_data({data}, references, blocks, bench::kRecordRate_Hz, options);
  for (const Identification& found : {covariance, direct}) {
    for (std::size_t m = 0; m < found.modes.size(); ++m) {
      std::printf("%8.4f Hz +- %.4f  %6.3f %% +- %.3f  at %zu orders\n", found.modes[m].frequency_Hz,
                  found.deviations[m].frequency_Hz, 100.0 * found.modes[m].damping_ratio,
                  100.0 * found.deviations[m].damping_ratio, found.modes[m].members.size());
    }
    ASSERT_EQ(found.modes.size(), bench::kRecordFrequencies_Hz.size());
    for (std::size_t m = 0; m < found.modes.size(); ++m) {
      EXPECT_NEAR(found.modes[m].frequency_Hz / bench::kRecordFrequencies_Hz[m], 1.0, 0.005);
      EXPECT_LT(std::abs(found.modes[m].frequency_Hz - bench::kRecordFrequencies_Hz[m]),
                5.0 * found.deviations[m].frequency_Hz);
    }
  }
}

}  // namespace
}  // namespace twindeck::identification
