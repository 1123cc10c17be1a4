// Oracles: harmonics of a string, n c; hand-made lists.
#include <gtest/gtest.h>

#include <algorithm>

#include "identification/tension.hpp"

namespace twindeck::identification {
namespace {

TEST(NumbersNear, OneAHarmonicTheNearest) {
  const TensionedBeam string{1e7, 0.0, 0.0};
  const Numbers expected = {{1, 0}, {2, 1}, {4, 4}};
  EXPECT_EQ(numbers_near({1.01, 2.02, 2.5, 3.9, 3.98}, 1.0, string, 0.05), expected);
  EXPECT_TRUE(numbers_near({1.4, 2.6}, 1.0, string, 0.05).empty());
}

// The true numbering of a hinged hanger of xi = 10 with a foreign mode is among the candidates, and the range of c holds.
TEST(CandidateNumbers, HoldTheTrueOne) {
  const TensionedBeam hanger{10.0, 0.5, 0.0};
  std::vector<double> frequencies;
  for (int n = 1; n <= 5; ++n) frequencies.push_back(2.0 * frequency_ratio(n, hanger));
  frequencies.push_back(7.1);
  std::sort(frequencies.begin(), frequencies.end());
  Numbers expected;
  for (int n = 1; n <= 5; ++n) {
    const auto at = std::lower_bound(frequencies.begin(), frequencies.end(), 2.0 * frequency_ratio(n, hanger) - 1e-9);
    expected[n] = static_cast<std::size_t>(at - frequencies.begin());
  }
  const auto candidates = candidate_numbers(frequencies, 0.0, 0.0);
  EXPECT_NE(std::find(candidates.begin(), candidates.end(), expected), candidates.end());
  EXPECT_LE(candidates.size(), 12U);
  EXPECT_TRUE(candidate_numbers(frequencies, 50.0, 60.0).empty());
}

}  // namespace
}  // namespace twindeck::identification
