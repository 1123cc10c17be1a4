// Oracle: the modes that the record of the benchmark was made with: fourteen of fourteen within 0.5 %, none spurious, by both
// methods.
#include <gtest/gtest.h>

#include <numeric>

#include "bench/sysid_record.hpp"
#include "signal/condition.hpp"
#include "sysid/identify.hpp"

namespace twindeck::sysid {
namespace {

TEST(BenchRecord, FourteenOfFourteenModesAndNoneSpurious) {
  const Eigen::MatrixXd data = signal::detrended(bench::sysid_record());
  std::vector<Eigen::Index> references(16);
  std::iota(references.begin(), references.end(), 0);
  const auto blocks = signal::correlations(data, references, 100, 20);
  IdentifyOptions options;
  options.block_rows = 50;
  options.limits.highest_Hz = 8.0;  // the generator's band
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
