// Oracles: Irvine's equation itself; the stays' frequencies as the paper prints them in Table 5 and the values of T/m and
// lambda² worked out of them by hand (least squares f_n = c n over n = 2 … 5; lambda² from f_1/c); exact harmonics of a taut
// and of a stiff string.
#include "sysid/tension.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "unit/signal/noise.hpp"

namespace twindeck::sysid {
namespace {

TEST(Irvine, RatioSolvesTheTranscendentalEquation) {
  for (const double lambda_squared : {0.1, 0.5, 2.6, 20.0, 39.0, 60.0}) {
    const double half = 0.5 * std::numbers::pi * first_frequency_ratio(lambda_squared);
    EXPECT_NEAR(std::tan(half), half - 4.0 / lambda_squared * half * half * half, 1e-8 * (1.0 + std::abs(std::tan(half))));
    EXPECT_NEAR(lambda_squared_of(first_frequency_ratio(lambda_squared)), lambda_squared, 1e-9 * lambda_squared);
  }
  EXPECT_NEAR(first_frequency_ratio(4.0 * std::numbers::pi * std::numbers::pi), 2.0,
              1e-9);  // the crossover of Irvine and Caughey
  EXPECT_EQ(lambda_squared_of(0.99), 0.0);
}

TEST(FitStay, PrintedFrequenciesOfTable5) {
  struct Row {
    const char* stay;
    double length, f[5], c, tension_per_mass, lambda_squared;
  };
  const Row rows[] = {{"NE8 without", 80.00, {0.84, 1.52, 2.30, 3.05, 3.81}, 0.7628, 14895, 2.60},
                      {"NE8 with", 80.00, {0.86, 1.56, 2.30, 3.02, 3.78}, 0.7593, 14758, 3.46},
                      {"NE7 without", 73.73, {1.06, 2.08, 3.11, 4.16, 5.19}, 1.0385, 23452, 0.51},
                      {"NE7 with", 73.73, {1.13, 2.21, 3.31, 4.41, 5.52}, 1.1035, 26479, 0.59},
                      {"NE5 without", 55.70, {1.66, 3.30, 4.95, 6.61, 8.28}, 1.6535, 33930, 0.10},
                      {"NE5 with", 55.70, {1.72, 3.45, 5.15, 6.89, 8.59}, 1.7196, 36698, 0.00}};
  for (const Row& row : rows) {
    std::vector<Harmonic> harmonics;
    for (int n = 1; n <= 5; ++n) harmonics.push_back({n, row.f[n - 1], 0.01 / std::sqrt(12.0)});  // printed to two decimals
    const StayFit fit = fit_stay(harmonics, row.length, 1.96, {.bending = false, .sag_of_higher = false});
    EXPECT_NEAR(fit.c_Hz.value, row.c, 6e-5) << row.stay;  // printed digits
    EXPECT_NEAR(fit.tension_per_mass.value / row.tension_per_mass, 1.0, 2e-4) << row.stay;
    EXPECT_NEAR(fit.lambda_squared.value, row.lambda_squared, 0.006) << row.stay;
    EXPECT_LE(fit.lambda_squared.low, fit.lambda_squared.value);
    EXPECT_GE(fit.lambda_squared.high, fit.lambda_squared.value);
    std::printf("%-12s c %.4f Hz, T/m %.0f m2/s2 [%.0f, %.0f], lambda2 %.2f [%.2f, %.2f]\n", row.stay, fit.c_Hz.value,
                fit.tension_per_mass.value, fit.tension_per_mass.low, fit.tension_per_mass.high, fit.lambda_squared.value,
                fit.lambda_squared.low, fit.lambda_squared.high);
  }
}

// The sag's effect on odd harmonics, left out of the numbers above, stays within what the printed digits leave open.
TEST(FitStay, SagOfHigherHarmonicsMovesTable5WithinItsInterval) {
  std::vector<Harmonic> harmonics;
  const double f[] = {0.84, 1.52, 2.30, 3.05, 3.81};
  for (int n = 1; n <= 5; ++n) harmonics.push_back({n, f[n - 1], 0.01 / std::sqrt(12.0)});
  const StayFit fit = fit_stay(harmonics, 80.0);
  EXPECT_LT(fit.tension_per_mass.value, 14895.0);
  EXPECT_GT(fit.tension_per_mass.high, 14895.0);
  EXPECT_LT(fit.lambda_squared.low, 2.60);
  EXPECT_GT(fit.lambda_squared.high, 2.60);
}

// Oracle: harmonics of Irvine's equation, solved by frequency_ratio, whose residual is looked at first.
TEST(FitStay, RecoversStringsWithSag) {
  for (const double lambda_squared : {0.1, 2.6, 15.0}) {
    std::vector<Harmonic> harmonics;
    for (int n = 1; n <= 5; ++n) {
      const double ratio = frequency_ratio(n, lambda_squared), half = 0.5 * std::numbers::pi * n * ratio;
      if (n % 2 == 1) {
        EXPECT_NEAR((half - std::tan(half)) * lambda_squared / (4.0 * half * half * half), 1.0, 1e-6) << n;
      }
      harmonics.push_back({n, n * 0.7 * ratio, 1e-3});
    }
    const StayFit fit = fit_stay(harmonics, 80.0);
    EXPECT_NEAR(fit.c_Hz.value, 0.7, 1e-9);
    EXPECT_NEAR(fit.lambda_squared.value, lambda_squared, 1e-6 * lambda_squared);
  }
  // To first order h = h0 + lambda²/(4 h0³) at h0 = 3 pi/2; the next term is h0 lambda²/(4 h0³) = 3 % of that.
  const double first_order = 2.6 / (4.0 * std::pow(1.5 * std::numbers::pi, 4));
  EXPECT_NEAR(frequency_ratio(3, 2.6) - 1.0, first_order, 0.05 * first_order);
  EXPECT_EQ(frequency_ratio(4, 2.6), 1.0);
}

TEST(FitStay, BendingIsSeenOnlyWhereItIs) {
  const double c = 1.2, b = 1e-3;
  std::vector<Harmonic> stiff, taut;
  for (int n = 1; n <= 8; ++n) {
    stiff.push_back({n, n * c * std::sqrt(1.0 + b * n * n), 1e-4 * n * c});
    taut.push_back({n, n * c, 1e-4 * n * c});
  }
  const StayFit with = fit_stay(stiff, 50.0), without = fit_stay(taut, 50.0);
  EXPECT_TRUE(with.bending_seen);
  EXPECT_NEAR(with.bending, b, 1e-9);
  EXPECT_NEAR(with.c_Hz.value, c, 1e-9);
  EXPECT_NEAR(with.lambda_squared.value, 0.0, 1e-6);
  EXPECT_FALSE(without.bending_seen);
  EXPECT_NEAR(without.tension_per_mass.value, std::pow(2.0 * 50.0 * c, 2), 1e-6);
}

// 3,000 stiff strings with errors of the stated deviations: c and b scatter by what is stated of them. 3,000 draws tell a
// deviation to 1.3 %; the errors are small enough for the line through f² to be linear in them.
TEST(FitStay, StatedDeviationsAreWhatStiffStringsScatterBy) {
  constexpr int kDraws = 3000;
  const double c = 1.2, b = 1e-3, relative = 2e-4, quantile = 1.96;
  signal::test::Noise random(23);
  Eigen::ArrayXd string(kDraws), bending(kDraws);
  double stated_string = 0.0, stated_bending = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Harmonic> harmonics;
    for (int n = 1; n <= 8; ++n) {
      const double exact = n * c * std::sqrt(1.0 + b * n * n);
      harmonics.push_back({n, exact * (1.0 + relative * random()), relative * exact});
    }
    const StayFit fit = fit_stay(harmonics, 50.0, quantile, {.bending = true, .sag_of_higher = false, .known_length = false});
    ASSERT_TRUE(fit.bending_seen);
    string[draw] = fit.c_Hz.value;
    bending[draw] = fit.bending;
    stated_string += std::pow(0.5 * (fit.c_Hz.high - fit.c_Hz.low) / quantile, 2) / kDraws;
    stated_bending += std::pow(fit.bending_deviation, 2) / kDraws;
  }
  const auto scatter = [](const Eigen::ArrayXd& x) { return std::sqrt((x - x.mean()).square().mean()); };
  EXPECT_NEAR(std::sqrt(stated_string) / scatter(string), 1.0, 0.05);
  EXPECT_NEAR(std::sqrt(stated_bending) / scatter(bending), 1.0, 0.05);
}

TEST(FitStay, RefusesTooFewHarmonics) {
  EXPECT_THROW(static_cast<void>(fit_stay({{1, 1.0, 0.01}}, 50.0)), InputError);
  EXPECT_THROW(static_cast<void>(fit_stay({{1, 1.0, 0.01}, {1, 1.1, 0.01}}, 50.0)), InputError);
  EXPECT_THROW(static_cast<void>(fit_stay({{1, 1.0, 0.01}, {2, 2.0, 0.01}}, 0.0)), InputError);
}

TEST(NumberHarmonics, FindsTheSeriesAmongOtherModes) {
  const std::vector<double> found = {0.748, 0.84, 1.52, 1.79, 2.30, 3.05, 3.3, 3.81};
  const auto numbered = number_harmonics(found, 0.4, 1.2);
  const std::vector<std::pair<std::size_t, int>> expected = {{1, 1}, {2, 2}, {4, 3}, {5, 4}, {7, 5}};
  EXPECT_EQ(numbered, expected);
}

}  // namespace
}  // namespace twindeck::sysid
