// Oracles: the defining sum of the discrete transform, written out; closed forms of single waves; Parseval.
#include "signal/fft.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "noise.hpp"

namespace twindeck::signal {
namespace {

using Complex = std::complex<double>;

Eigen::VectorXd random_values(Eigen::Index n, std::uint64_t seed) {
  test::Noise noise(seed);
  Eigen::VectorXd x(n);
  for (double& value : x) value = noise();
  return x;
}

/// exp(2 pi i m t / n).
Complex wave(Eigen::Index m, Eigen::Index t, Eigen::Index n) {
  return std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(m * t % n) / static_cast<double>(n));
}

// X_m = sum_t x_t exp(-2 pi i m t / n), even and odd lengths, a prime, one and two. Tolerance: rounding of n terms.
TEST(RealFft, IsTheDefiningSum) {
  for (const Eigen::Index n : {1, 2, 3, 8, 15, 31}) {
    const Eigen::VectorXd x = random_values(n, 3);
    RealFft fft(n);
    EXPECT_EQ(fft.size(), n);
    const Eigen::VectorXcd spectrum = fft.forward(x);
    ASSERT_EQ(spectrum.size(), n / 2 + 1);
    for (Eigen::Index m = 0; m < spectrum.size(); ++m) {
      Complex sum = 0.0;
      for (Eigen::Index t = 0; t < n; ++t) sum += x[t] * std::conj(wave(m, t, n));
      EXPECT_LT(std::abs(spectrum[m] - sum), 1e-13) << n << " " << m;
    }
  }
}

TEST(RealFft, TheInverseGivesTheSequenceBack) {
  for (const Eigen::Index n : {1, 2, 7, 16, 45}) {
    const Eigen::VectorXd x = random_values(n, 4);
    RealFft fft(n);
    EXPECT_LT((fft.inverse(fft.forward(x)) - x).norm(), 1e-13) << n;
  }
}

// A shorter sequence counts as followed by zeros, whatever the transform held before.
TEST(RealFft, AShorterSequenceIsFollowedByZeros) {
  RealFft fft(12);
  static_cast<void>(fft.forward(random_values(12, 5)));
  const Eigen::VectorXd x = random_values(5, 6);
  Eigen::VectorXd padded = Eigen::VectorXd::Zero(12);
  padded.head(5) = x;
  RealFft fresh(12);
  EXPECT_EQ((fft.forward(x) - fresh.forward(padded)).norm(), 0.0);
  EXPECT_EQ(fft.forward(Eigen::VectorXd()).norm(), 0.0);
}

// sum x² = 1/n sum |X|², lines between 0 and n/2 twice; of an odd length there is no line at n/2.
TEST(RealFft, Parseval) {
  for (const Eigen::Index n : {20, 21}) {
    const Eigen::VectorXd x = random_values(n, 7);
    RealFft fft(n);
    const Eigen::VectorXd squares = fft.forward(x).cwiseAbs2();
    double sum = 2.0 * squares.sum() - squares[0];
    if (n % 2 == 0) sum -= squares[n / 2];
    EXPECT_NEAR(sum / static_cast<double>(n), x.squaredNorm(), 1e-12);
  }
}

// A cosine of one period in n samples lagging by phi: X_1 = n/2 exp(-i phi).
TEST(RealFft, ALaggingCosineHasANegativePhase) {
  const double phi = 0.7;
  Eigen::VectorXd x(16);
  for (Eigen::Index t = 0; t < 16; ++t) x[t] = std::cos(2.0 * std::numbers::pi * static_cast<double>(t) / 16.0 - phi);
  RealFft fft(16);
  EXPECT_LT(std::abs(fft.forward(x)[1] - std::polar(8.0, -phi)), 1e-13);
}

// A delay of d samples (a turn of the sequence) multiplies X_m by exp(-2 pi i m d / n).
TEST(RealFft, ADelayTurnsThePhases) {
  const Eigen::Index n = 15, d = 4;
  const Eigen::VectorXd x = random_values(n, 8);
  Eigen::VectorXd later(n);
  for (Eigen::Index t = 0; t < n; ++t) later[(t + d) % n] = x[t];
  RealFft fft(n);
  const Eigen::VectorXcd before = fft.forward(x), after = fft.forward(later);
  for (Eigen::Index m = 0; m < before.size(); ++m)
    EXPECT_LT(std::abs(after[m] - before[m] * std::conj(wave(m, d, n))), 1e-13) << m;
}

// x_t = sum 2 Re(w_l exp(2 pi i (first + l) t / n)) by the sum itself; memory aligned as the plan's, and not.
TEST(SumOfWaves, IsTheDefiningSum) {
  const std::vector<Complex> waves = {{1.0, 0.5}, {-0.3, 2.0}, {0.0, -1.0}};
  for (const Eigen::Index n : {16, 17}) {
    for (const Eigen::Index first : {Eigen::Index{1}, (n + 1) / 2 - 3}) {  // the lowest and the highest band
      RealFft fft(n);
      static_cast<void>(fft.forward(random_values(n, 9)));  // what it held before does not matter
      for (const Eigen::Index shift : {0, 1}) {
        Eigen::VectorXd memory = Eigen::VectorXd::Constant(n + 1, 99.0);
        fft.sum_of_waves(waves.data(), first, 3, memory.data() + shift);
        for (Eigen::Index t = 0; t < n; ++t) {
          double sum = 0.0;
          for (Eigen::Index l = 0; l < 3; ++l) sum += 2.0 * (waves[static_cast<std::size_t>(l)] * wave(first + l, t, n)).real();
          EXPECT_NEAR(memory[t + shift], sum, 1e-13) << n << " " << first << " " << t;
        }
        EXPECT_EQ(memory[shift == 0 ? n : 0], 99.0);
      }
    }
  }
}

// The waves may lie where the values go.
TEST(SumOfWaves, MayShareMemoryWithTheWaves) {
  const std::vector<Complex> waves = {{1.0, 0.5}, {-0.3, 2.0}};
  RealFft fft(16);
  Eigen::VectorXd apart(16), shared = Eigen::VectorXd::Zero(16);
  fft.sum_of_waves(waves.data(), 2, 2, apart.data());
  auto* in_place = reinterpret_cast<Complex*>(shared.data());
  std::copy(waves.begin(), waves.end(), in_place);
  fft.sum_of_waves(in_place, 2, 2, shared.data());
  EXPECT_EQ((apart - shared).norm(), 0.0);
}

TEST(SumOfWaves, ABandBeyondTheSpectrumIsOurMistake) {
  const std::vector<Complex> waves(4, Complex(1.0, 0.0));
  RealFft fft(8);
  Eigen::VectorXd values(8);
  EXPECT_THROW(fft.sum_of_waves(waves.data(), 0, 1, values.data()), InternalError);  // a mean is no wave
  EXPECT_THROW(fft.sum_of_waves(waves.data(), 1, 4, values.data()), InternalError);  // n/2 would count twice
  EXPECT_NO_THROW(fft.sum_of_waves(waves.data(), 1, 3, values.data()));
}

TEST(RealFft, WrongSizesAreOurMistake) {
  EXPECT_THROW(RealFft(0), InternalError);
  RealFft fft(8);
  EXPECT_THROW(static_cast<void>(fft.forward(Eigen::VectorXd::Zero(9))), InternalError);
  EXPECT_THROW(static_cast<void>(fft.inverse(Eigen::VectorXcd::Zero(4))), InternalError);
}

// Hamming numbers: 1 2 3 4 5 6 8 9 10 12 15 16 18 20 24 25 27 30 32 36 40 45 48 50 54 60 64 (OEIS A051037).
TEST(FastFftSize, IsTheNextHammingNumber) {
  const std::vector<Eigen::Index> hamming = {1,  2,  3,  4,  5,  6,  8,  9,  10, 12, 15, 16, 18, 20,
                                             24, 25, 27, 30, 32, 36, 40, 45, 48, 50, 54, 60, 64};
  std::size_t at = 0;
  for (Eigen::Index wanted = 1; wanted <= 64; ++wanted) {
    while (hamming[at] < wanted) ++at;
    EXPECT_EQ(fast_fft_size(wanted), hamming[at]) << wanted;
  }
  EXPECT_EQ(fast_fft_size(0), 1);
  EXPECT_EQ(fast_fft_size(-3), 1);
  EXPECT_EQ(fast_fft_size(1000001), 1012500);  // 2² · 3⁴ · 5⁵
}

}  // namespace
}  // namespace twindeck::signal
