// Scales of the stated deviations. Oracle: the factor by which errors were drawn larger than stated, of one type of rows only.
#include "diagnosis/scatter_scales.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

const diagnosis::ScatterScale& scale_of(const std::vector<diagnosis::ScatterScale>& scales, const std::string& name) {
  return *std::find_if(scales.begin(), scales.end(), [&](const auto& s) { return s.of == name; });
}

TEST(ScatterScales, FindTheFactorByWhichErrorsAreUnderstated) {
  const Chain chain({.masses = 10});
  int covered = 0, sound = 0;
  double sum = 0.0;
  const int trials = 30;
  for (int i = 0; i < trials; ++i) {
    std::mt19937_64 random(static_cast<std::uint64_t>(900 + i));
    auto features = chain.measure(chain.scattered(random), &random);
    for (auto& row : features.rows)
      if (row.type == diagnosis::RowType::shape) row.std /= 2.0;  // half of what the errors have
    const Examined e = examine(chain, features, {});
    const auto scales = diagnosis::scatter_scales(*e.inference, e.inference->fit({}, {}));
    const auto& shape = scale_of(scales, "shape");
    const auto& frequency = scale_of(scales, "frequency_Hz");
    covered += shape.low < 2.0 && shape.high > 2.0;
    sound += frequency.low < 1.0 && frequency.high > 1.0;
    sum += std::log(shape.scale);
  }
  EXPECT_NEAR(std::exp(sum / trials), 2.0, 0.1);  // 70 entries each: 8.5 % a trial, 1.6 % of the mean
  EXPECT_GE(covered, 22);                         // of thirty at 90 %: 22 or more in 99.8 %
  EXPECT_GE(sound, 22);
}

TEST(ScatterScales, SayLittleOfWhatTheRowsDoNotShow) {
  // Three frequencies: their scale cannot be known to better than a factor.
  const Chain chain({.masses = 10, .modes = 4, .shapes = false});
  std::mt19937_64 random(4);
  const Examined e = examine(chain, chain.measure(chain.scattered(random), &random), {});
  const auto scales = diagnosis::scatter_scales(*e.inference, e.inference->fit({}, {}));
  const auto& frequency = scale_of(scales, "frequency_Hz");
  EXPECT_GT(frequency.high / frequency.low, 3.0);
}

}  // namespace
}  // namespace twindeck::tests
