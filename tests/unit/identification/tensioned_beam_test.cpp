// Oracles: the closed forms of a string, of a hinged beam under tension and of a clamped beam without tension; Irvine's
// equation; the formula of Mehrabi and Tabatabai (1998), ASCE Journal of Structural Engineering 124, 1313-1322, for clamped
// stays; a beam of 120 cubic elements with the sag's term, solved once by an eigenvalue solver of SciPy.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "identification/stay_posterior.hpp"

namespace twindeck::identification {
namespace {

using std::numbers::pi;

TEST(TensionedBeam, HingedEndsHaveTheirClosedForm) {
  for (const double xi : {6.0, 30.0, 400.0}) {
    for (int n = 1; n <= 10; ++n)
      EXPECT_NEAR(frequency_ratio(n, {xi, 0.0, 0.0}), n * std::sqrt(1.0 + n * n * pi * pi / (xi * xi)), 1e-12 * n);
  }
}

// f/c of a beam without tension is k² /(pi xi), k = 4.730041, 7.853205, 10.995608 (tables); a tension of xi = 0.01 adds some
// xi².
TEST(TensionedBeam, ClampedEndsWithoutTensionAreThoseOfABeam) {
  const double xi = 0.01;
  const double k[] = {4.730041, 7.853205, 10.995608};
  for (int n = 1; n <= 3; ++n)
    EXPECT_NEAR(frequency_ratio(n, {xi, 0.0, 1.0}) * pi * xi / (k[n - 1] * k[n - 1]), 1.0, 1e-5) << n;
}

TEST(TensionedBeam, AStringWithSagSolvesIrvinesEquation) {
  for (const double lambda_squared : {0.1, 2.6, 20.0, 39.0, 60.0}) {
    for (const int n : {1, 3, 5}) {
      const double half = 0.5 * pi * frequency_ratio(n, {1e7, lambda_squared, 0.0});
      EXPECT_NEAR((half - std::tan(half)) * lambda_squared / (4.0 * half * half * half), 1.0, 1e-6)
          << lambda_squared << " " << n;
    }
    EXPECT_NEAR(frequency_ratio(2, {1e7, lambda_squared, 0.0}), 2.0, 1e-12);
  }
  EXPECT_NEAR(frequency_ratio(1, {1e7, 4.0 * pi * pi, 0.0}), 2.0, 1e-9);  // the crossover of Irvine and Caughey
}

// f_n/(n c) = alpha beta_n - 0.24 mu/xi, alpha = 1 + 0.039 mu, beta_n = 1 + 2/xi + (4 + n² pi²/2)/xi², mu = lambda² for n = 1
// and 0 above: stated for xi >= 50 and lambda² <= 3.1, within a per cent.
TEST(TensionedBeam, ClampedStaysAgreeWithMehrabiAndTabatabai) {
  for (const double xi : {50.0, 100.0, 300.0}) {
    for (const double lambda_squared : {0.0, 1.0, 3.0}) {
      for (int n = 1; n <= 5; ++n) {
        const double mu = n == 1 ? lambda_squared : 0.0, alpha = 1.0 + 0.039 * mu;
        const double beta = 1.0 + 2.0 / xi + (4.0 + 0.5 * n * n * pi * pi) / (xi * xi);
        EXPECT_NEAR(frequency_ratio(n, {xi, lambda_squared, 1.0}) / (n * (alpha * beta - 0.24 * mu / xi)), 1.0, 0.01);
      }
    }
  }
}

// The elements' own error is largest in the sixth mode: 1e-5.
TEST(TensionedBeam, EndsAndSagTogetherAreThoseOfABeamOfElements) {
  struct Row {
    TensionedBeam beam;
    std::vector<double> ratios;
  };
  const Row rows[] = {{{6.0, 10.0, 1.0}, {1.828488, 3.916313, 7.16041, 11.392791, 16.663236, 22.967205}},
                      {{30.0, 3.0, 0.5}, {1.149271, 2.112528, 3.252798, 4.474897, 5.816581, 7.289991}},
                      {{60.0, 25.0, 0.0}, {1.7247, 2.010936, 3.085486, 4.086788, 5.177236, 6.289122}},
                      {{20.0, 30.0, 0.3}, {1.848189, 2.157037, 3.458385, 4.83781, 6.502389, 8.39901}}};
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.ratios.size(); ++i)
      EXPECT_NEAR(frequency_ratio(static_cast<int>(i) + 1, row.beam) / row.ratios[i], 1.0, 1e-5) << row.beam.xi << " " << i + 1;
  }
}

// Sag raises odd modes and never lowers them; a stiffer end raises all.
TEST(TensionedBeam, RatiosRiseWithSagAndFixity) {
  for (const double xi : {6.0, 40.0, 1000.0}) {
    for (const double fixity : {0.0, 0.4, 1.0}) {
      for (const int n : {1, 3, 7}) {
        double before = 0.0;
        for (const double lambda_squared : {0.0, 1e-9, 0.01, 1.0, 10.0, 30.0, 60.0}) {
          const double ratio = frequency_ratio(n, {xi, lambda_squared, fixity});
          EXPECT_GE(ratio, before * (1.0 - 1e-11)) << xi << " " << fixity << " " << n << " " << lambda_squared;
          before = ratio;
        }
      }
    }
    for (int n = 1; n <= 6; ++n)
      EXPECT_LT(frequency_ratio(n, {xi, 5.0, 0.3}), frequency_ratio(n, {xi, 5.0, 0.7})) << xi << " " << n;
  }
}

}  // namespace
}  // namespace twindeck::identification
