// Oracles: the sum of the header in plain complex arithmetic, exp of the standard library, moments of random numbers.
#include "wind/wave_sums.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace twindeck::wind {
namespace {

using Complex = std::complex<double>;

/// Lower triangle with rows of length one.
Eigen::MatrixXd unit_rows(int n, double phase) {
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(n, n);
  for (int j = 0; j < n; ++j)
    for (int m = 0; m <= j; ++m) l(j, m) = std::sin(phase + 1.3 * j + 2.1 * m) + 0.2;
  l.rowwise().normalize();
  return l;
}

// Oracle: rows without what is zero in both anchors; 1 - cosine between rows of (1, 0) and (0.6, 0.8) is 0.4.
TEST(WaveSums, FactorsKeepWhatIsNotNegligible) {
  Eigen::Matrix3d low = Eigen::Matrix3d::Identity(), high = low;
  high.row(1) << 0.6, 0.8, 0.0;
  low(1, 0) = 1.0, low(1, 1) = 0.0;
  low(2, 0) = 1e-19;
  low(0, 2) = 5.0;  // above the diagonal: not read
  const FactorPair pair(low, high);
  ASSERT_EQ(pair.size(), 3);
  EXPECT_EQ(pair.entries(0), 1);
  ASSERT_EQ(pair.entries(1), 2);
  EXPECT_EQ(pair.entries(2), 1);
  EXPECT_EQ(pair.row(1)[1].column, 1);
  EXPECT_EQ(pair.row(1)[1].low, 0.0);
  EXPECT_EQ(pair.row(1)[1].high, 0.8);
  EXPECT_EQ(pair.row(2)[0].column, 2);
  EXPECT_NEAR(pair.apart(0), 0.0, 1e-16);
  EXPECT_NEAR(pair.apart(1), 0.4, 1e-15);
}

// Oracle: exp(-2 pi i turns) of the library, whose argument is rounded to 1e-14 at 20 turns.
TEST(WaveSums, DriftsTurnBackwards) {
  const double turns[kLanes] = {0.0, 0.25, -0.25, 0.5, 1.125, -3.7, 19.99, -0.0};
  double real[kLanes], imaginary[kLanes];
  drifts(turns, real, imaginary);
  for (int i = 0; i < kLanes; ++i) {
    const Complex expected = std::polar(1.0, -2.0 * std::numbers::pi * turns[i]);
    EXPECT_NEAR(real[i], expected.real(), 5e-14) << turns[i];
    EXPECT_NEAR(imaginary[i], expected.imag(), 5e-14) << turns[i];
  }
}

// Oracle: the sum of the header, term by term, at shares of both anchors and between; lanes do not mix.
TEST(WaveSums, EqualsThePlainSum) {
  const int n = 5;
  const Eigen::MatrixXd low = unit_rows(n, 0.3), high = unit_rows(n, 0.9);
  const FactorPair pair(low, high);
  std::vector<double> wave(2 * kLanes * n);
  for (std::size_t i = 0; i < wave.size(); ++i) wave[i] = std::sin(1.0 + 0.7 * static_cast<double>(i));
  WaveLanes lanes{};
  Drift drift{};
  for (int i = 0; i < kLanes; ++i) {
    lanes.share[i] = i / 7.0;
    lanes.amplitude[i] = 1.0 + 0.5 * i;
    drift.real[i] = std::cos(0.4 * i), drift.imaginary[i] = std::sin(0.4 * i);
  }
  const Complex first = std::polar(1.0, 0.8);
  for (int j = 0; j < n; ++j) {
    double out[2 * kLanes];
    wave_sums(pair, j, wave.data(), lanes, first, drift, out);
    for (int i = 0; i < kLanes; ++i) {
      const double t = lanes.share[i];
      const Eigen::RowVectorXd row = ((1.0 - t) * low.row(j) + t * high.row(j)).normalized();
      Complex sum = 0.0;
      for (int m = 0; m <= j; ++m)
        sum += row[m] * Complex(wave[static_cast<std::size_t>(2 * kLanes * m + i)],
                                wave[static_cast<std::size_t>(2 * kLanes * m + kLanes + i)]);
      sum *= lanes.amplitude[i] * first * Complex(drift.real[i], drift.imaginary[i]);
      EXPECT_NEAR(out[2 * i], sum.real(), 1e-13) << j << ' ' << i;
      EXPECT_NEAR(out[2 * i + 1], sum.imag(), 1e-13) << j << ' ' << i;
    }
  }
}

// Oracle: phases alone have size one; normal waves have mean 0, mean square 1, E|z|⁴ = 2 and E z² = 0. Of 8000 numbers the
// standard errors are 0.011, 0.011, 0.05 and 0.016: four of them are allowed.
TEST(WaveSums, RandomWavesHaveTheirMoments) {
  Complex mean = 0.0, square = 0.0, phases = 0.0;
  double second = 0.0, fourth = 0.0;
  const int n = 8000;
  for (int first = 0; first < n; first += kLanes) {
    double real[kLanes], imaginary[kLanes];
    random_waves(11, 3, first, false, real, imaginary);
    for (int i = 0; i < kLanes; ++i) {
      EXPECT_NEAR(std::hypot(real[i], imaginary[i]), 1.0, 1e-15);
      phases += Complex(real[i], imaginary[i]) / double{n};
    }
    random_waves(11, 3, first, true, real, imaginary);
    for (int i = 0; i < kLanes; ++i) {
      const Complex z(real[i], imaginary[i]);
      mean += z / double{n}, square += z * z / double{n};
      second += std::norm(z) / n, fourth += std::norm(z) * std::norm(z) / n;
    }
  }
  EXPECT_LT(std::abs(phases), 0.045);
  EXPECT_LT(std::abs(mean), 0.045);
  EXPECT_LT(std::abs(square), 0.064);
  EXPECT_NEAR(second, 1.0, 0.045);
  EXPECT_NEAR(fourth, 2.0, 0.2);
}

// Oracle: the header: waves are pure functions of seed, stream and position, wherever a call starts.
TEST(WaveSums, RandomWavesDependOnTheirPositionAlone) {
  double a[kLanes], b[kLanes], c[kLanes], d[kLanes];
  for (const bool normal : {false, true}) {
    random_waves(5, 2, 10, normal, a, b);
    random_waves(5, 2, 13, normal, c, d);
    for (int i = 3; i < kLanes; ++i) {
      EXPECT_EQ(a[i], c[i - 3]);
      EXPECT_EQ(b[i], d[i - 3]);
    }
    random_waves(6, 2, 10, normal, c, d);
    EXPECT_NE(a[0], c[0]);
    random_waves(5, 3, 10, normal, c, d);
    EXPECT_NE(a[0], c[0]);
  }
}

}  // namespace
}  // namespace twindeck::wind
