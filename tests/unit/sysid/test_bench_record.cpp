// Oracle: the modes that the record of the benchmark was made with: fourteen of fourteen within 0.5 %, none spurious, by both
// methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "bench/sysid_record.hpp"
#include "signal/condition.hpp"
#include "sysid/identify.hpp"

namespace twindeck::sysid {
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

// Other noise and other shapes of the same modes. Of record 20260131 the mode at 7.4 Hz is missing: from order 30 on it is
// split in two halves, and the records know neither.
TEST(BenchRecord, FiftyOtherRecords) {
  if (std::getenv("TWINDECK_SLOW") == nullptr) GTEST_SKIP() << "half a minute: set TWINDECK_SLOW=1";
  int whole = 0;
  for (std::uint64_t seed = 20260101; seed < 20260151; ++seed) {
    const Eigen::MatrixXd data = signal::detrended(bench::sysid_record(60000, seed));
    const Identification found =
        identify(signal::correlations(data, all_channels(), 100, 20), bench::kRecordRate_Hz, bench_options());
    EXPECT_LE(found.modes.size(), bench::kRecordFrequencies_Hz.size()) << "a spurious mode, seed " << seed;
    const auto is_found = [&](double f) {
      return std::count_if(found.modes.begin(), found.modes.end(),
                           [&](const Cluster& mode) { return std::abs(mode.frequency_Hz / f - 1.0) < 0.005; }) == 1;
    };
    if (std::all_of(bench::kRecordFrequencies_Hz.begin(), bench::kRecordFrequencies_Hz.end(), is_found)) ++whole;
  }
  EXPECT_GE(whole, 49);
}

TEST(BenchRecord, FourteenOfFourteenModesAndNoneSpurious) {
  const Eigen::MatrixXd data = signal::detrended(bench::sysid_record());
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
}  // namespace twindeck::sysid
