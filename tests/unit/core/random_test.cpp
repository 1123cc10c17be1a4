/// Oracles: moments of the two distributions, a chi-square of cells, independence of neighbours, fixed numbers.
#include "core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace twindeck {
namespace {

TEST(Random, UniformNumbersFillTheirInterval) {
  std::array<int, 100> cells{};
  const int n = 100000;
  double neighbours = 0.0, streams = 0.0;
  for (int i = 0; i < n; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    const double u = uniform_number(1, 2, index);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++cells[static_cast<std::size_t>(100.0 * u)];
    neighbours += (u - 0.5) * (uniform_number(1, 2, index + 1) - 0.5) * 12.0 / n;
    streams += (u - 0.5) * (uniform_number(1, 3, index) - 0.5) * 12.0 / n;
  }
  double chi_square = 0.0;
  for (const int count : cells) chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chi_square, 149.0);  // 99.9 % point of 99 degrees of freedom
  EXPECT_GT(chi_square, 61.0);   // and 0.1 %
  EXPECT_NEAR(neighbours, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(streams, 0.0, 4.0 / std::sqrt(n));
}

TEST(Random, NormalNumbersHaveTheirMoments) {
  const int n = 100000;
  double mean = 0.0, square = 0.0, fourth = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = normal_number(5, 0, static_cast<std::uint64_t>(i));
    mean += x / n;
    square += x * x / n;
    fourth += x * x * x * x / n;
  }
  EXPECT_NEAR(mean, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(square, 1.0, 4.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth, 3.0, 4.0 * std::sqrt(96.0 / n));
}

TEST(Random, WhiteNumbersHaveTheirMoments) {
  const int n = 100000;
  double mean = 0.0, square = 0.0, fourth = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = white_number(5, 0, static_cast<std::uint64_t>(i));
    mean += x / n;
    square += x * x / n;
    fourth += x * x * x * x / n;
  }
  EXPECT_NEAR(mean, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(square, 1.0, 4.0 * std::sqrt(0.8 / n));         // 9/5 - 1
  EXPECT_NEAR(fourth, 9.0 / 5.0, 4.0 * std::sqrt(5.76 / n));  // 81/9 - 81/25
}

TEST(Random, SameArgumentsSameNumber) {
  EXPECT_EQ(uniform_number(1, 2, 3), uniform_number(1, 2, 3));
  EXPECT_NE(uniform_number(1, 2, 3), uniform_number(3, 2, 1));
}

}  // namespace
}  // namespace twindeck
