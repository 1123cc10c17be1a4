// Oracles: harmonics of tensioned beams in closed form (identification/tensioned_beam, tested by itself); the stays'
// frequencies as the paper prints them in Table 5, with T/m worked out of them by hand as of a taut string (least squares f_n =
// c n over n = 2 … 5).
#include "identification/tension.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/signal/noise.hpp"

namespace twindeck::identification {
namespace {

std::vector<Harmonic> harmonics_of(double c_Hz, const TensionedBeam& beam, const std::vector<int>& numbers, double relative,
                                   std::uint64_t seed = 0) {
  signal::test::Noise random(seed);
  std::vector<Harmonic> harmonics;
  for (const int n : numbers) {
    const double f = c_Hz * frequency_ratio(n, beam);
    harmonics.push_back({n, f * (seed > 0 ? 1.0 + relative * random() : 1.0), relative * f});
  }
  return harmonics;
}

std::vector<int> numbers_of(const StayFit& fit) {
  std::vector<int> numbers;
  for (const Harmonic& h : fit.numbering.harmonics) numbers.push_back(h.number);
  return numbers;
}

// The printed frequencies are rounded to 0.01 Hz. Bending, which they leave open and a string leaves out, can only lower T/m:
// the interval of 99 % begins below the string's value and ends at it or up to a per cent below (NE5's spacing grows with n),
// and the median lies within five per cent of it.
TEST(FitNumbered, PrintedFrequenciesOfTable5) {
  struct Row {
    const char* stay;
    double length, f[5], tension_per_mass;
  };
  const Row rows[] = {{"NE8 without", 80.00, {0.84, 1.52, 2.30, 3.05, 3.81}, 14895},
                      {"NE7 without", 73.73, {1.06, 2.08, 3.11, 4.16, 5.19}, 23452},
                      {"NE5 without", 55.70, {1.66, 3.30, 4.95, 6.61, 8.28}, 33930},
                      {"NE5 with", 55.70, {1.72, 3.45, 5.15, 6.89, 8.59}, 36698}};
  for (const Row& row : rows) {
    std::vector<Harmonic> harmonics;
    for (int n = 1; n <= 5; ++n) harmonics.push_back({n, row.f[n - 1], 0.01 / std::sqrt(12.0)});
    const StayFit fit = fit_numbered(harmonics, {row.length}, 0.99);
    EXPECT_NEAR(fit.tension_per_mass.value / row.tension_per_mass, 1.0, 0.05) << row.stay;
    EXPECT_LT(fit.tension_per_mass.low, row.tension_per_mass) << row.stay;
    EXPECT_GT(fit.tension_per_mass.high, 0.99 * row.tension_per_mass) << row.stay;
  }
}

// The three hangers of a published comparison of formulas: T/m = 41,667 m²/s², 80 m, xi 30 and 60. Each interval of 95 % holds
// it. At xi = 30 six harmonics known to 2e-4 show the ends; at xi = 60 they do not, and the interval spans both: 4/60 of the
// force.
TEST(FitStay, HingedAndClampedHangersHaveTheirForce) {
  struct Row {
    std::vector<double> f;
    double width;
  };
  const Row rows[] = {{{1.2828, 2.6069, 4.0118, 5.5327, 7.2004, 9.0402}, 4.4 / 30.0},
                      {{1.3745, 2.7936, 4.2991, 5.9277, 7.7101, 9.6710}, 4.4 / 30.0},
                      {{1.3216, 2.6541, 4.0082, 5.3944, 6.8226, 8.3021}, 4.8 / 60.0}};
  for (const Row& row : rows) {
    std::vector<Harmonic> found;
    for (const double f : row.f) found.push_back({0, f, 2e-4 * f});
    const StayFit fit = fit_stay(found, {80.0}, 0.95);
    EXPECT_EQ(numbers_of(fit), (std::vector<int>{1, 2, 3, 4, 5, 6}));
    EXPECT_LT(fit.tension_per_mass.low, 41667.0) << row.f[0];
    EXPECT_GT(fit.tension_per_mass.high, 41667.0) << row.f[0];
    EXPECT_LT((fit.tension_per_mass.high - fit.tension_per_mass.low) / 41667.0, row.width) << row.f[0];
  }
}

// Without errors: the force of a clear case is exact to what the priors move within the interval, a tenth of a per cent.
TEST(FitStay, RecoversForceSagAndEnds) {
  for (const double fixity : {0.0, 1.0}) {
    const auto found = harmonics_of(1.5, {15.0, 8.0, fixity}, {1, 2, 3, 4, 5, 6}, 2e-4);
    const StayFit fit = fit_stay(found, {40.0}, 0.9);
    EXPECT_NEAR(fit.c_Hz.value, 1.5, 1e-3 * 1.5);
    EXPECT_NEAR(fit.tension_per_mass.value, 6400.0 * fit.c_Hz.value * fit.c_Hz.value, 1e-6);
    EXPECT_NEAR(fit.lambda_squared.value, 8.0, 0.1);
    EXPECT_NEAR(fit.xi.value, 15.0, 0.15);
    EXPECT_GT(fixity > 0.5 ? fit.clamped : fit.hinged, 0.95);
  }
}

// A mode of the deck beside the series, and a harmonic that the sensor does not show.
TEST(FitStay, NumbersAreThoseThatExplainTheSeries) {
  auto found = harmonics_of(0.762, {700.0, 2.6, 0.0}, {1, 2, 3, 4, 5}, 1e-3, 5);
  found.push_back({0, 0.65, 1e-3});
  found.push_back({0, 1.79, 2e-3});
  found.push_back({0, 3.3, 3e-3});
  std::sort(found.begin(), found.end(), [](const Harmonic& a, const Harmonic& b) { return a.frequency_Hz < b.frequency_Hz; });
  const StayFit fit = fit_stay(found, {80.0}, 0.95);
  EXPECT_EQ(numbers_of(fit), (std::vector<int>{1, 2, 3, 4, 5}));
  EXPECT_EQ(fit.numbering.positions, (std::vector<std::size_t>{1, 2, 4, 5, 7}));

  const StayFit gap = fit_stay(harmonics_of(2.0, {20.0, 1.0, 1.0}, {1, 2, 4, 5, 6, 7}, 3e-4, 6), {30.0}, 0.95);
  EXPECT_EQ(numbers_of(gap), (std::vector<int>{1, 2, 4, 5, 6, 7}));
}

// Two harmonics of a hanger: their numbers, bending and sag are all open.
TEST(FitStay, TooFewHarmonicsGiveAWideInterval) {
  const StayFit few = fit_stay(harmonics_of(2.0, {10.0, 0.5, 1.0}, {1, 2}, 3e-4), {30.0}, 0.9);
  ASSERT_EQ(few.numbering.harmonics.size(), 2U);
  EXPECT_GT(few.tension_per_mass.high / few.tension_per_mass.low, 1.5);
  EXPECT_LT(few.tension_per_mass.low, 14400.0);
  EXPECT_GT(few.tension_per_mass.high, 14400.0);
  EXPECT_TRUE(fit_stay({{0, 1.0, 1e-3}}, {30.0}, 0.9).numbering.harmonics.empty());
}

// A stay of xi = 60 whose ends its harmonics do not show: 7 % of the force. Ends or EI, where known, narrow that.
TEST(FitStay, WhatIsKnownOfTheSectionNarrowsTheInterval) {
  const auto found = harmonics_of(1.0, {60.0, 1.0, 1.0}, {1, 2, 3, 4, 5}, 4e-4, 3);
  const auto width = [&](const StaySection& section) {
    const StayFit fit = fit_stay(found, section, 0.9);
    EXPECT_LT(fit.tension_per_mass.low, 6400.0);
    EXPECT_GT(fit.tension_per_mass.high, 6400.0);
    return (fit.tension_per_mass.high - fit.tension_per_mass.low) / 6400.0;
  };
  const double open = width({40.0});
  StaySection clamped{40.0};
  clamped.fixity = 1.0;
  EXPECT_LT(width(clamped), 0.3 * open);
  // EI/m = (T/m) L²/xi². With two harmonics alone it tells what they cannot.
  const double bending = 6400.0 * 1600.0 / 3600.0;
  const auto two = harmonics_of(1.0, {60.0, 0.0, 0.0}, {2, 4}, 4e-4);
  const StayFit with = fit_numbered(two, {40.0, bending}, 0.9), without = fit_numbered(two, {40.0}, 0.9);
  EXPECT_NEAR(with.xi.value, 60.0, 6.0);
  EXPECT_GE(without.xi.high - without.xi.low, with.xi.high - with.xi.low);
}

// 60 random stays and hangers: of intervals of 90 % at least 48 hold, which 60 at 90 % miss once in 500 (binomial).
TEST(FitStay, IntervalsHoldTheForce) {
  signal::test::Noise random(77);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * 0.5 * std::erfc(-random() / std::sqrt(2.0));
  };
  int held = 0;
  for (int stay = 0; stay < 60; ++stay) {
    const TensionedBeam beam{std::exp(uniform(std::log(6.0), std::log(400.0))), uniform(0.0, 30.0), stay % 2 == 0 ? 0.0 : 1.0};
    std::vector<int> numbers;
    const int most = static_cast<int>(uniform(4.0, 11.0)), missing = stay % 3 == 0 ? 2 : 0;
    for (int n = 1; n <= most; ++n) {
      if (n != missing) numbers.push_back(n);
    }
    const StayFit fit = fit_stay(harmonics_of(1.3, beam, numbers, 5e-4, static_cast<std::uint64_t>(stay) + 1), {50.0}, 0.9);
    if (fit.c_Hz.low <= 1.3 && 1.3 <= fit.c_Hz.high) ++held;
  }
  EXPECT_GE(held, 48);
  std::printf("intervals of 90 %% hold %d of 60 forces\n", held);
}

TEST(FitNumbered, RefusesWhatIsNoSeries) {
  EXPECT_THROW(static_cast<void>(fit_numbered({{1, 1.0, 0.01}}, {50.0}, 0.9)), InputError);
  EXPECT_THROW(static_cast<void>(stay_posterior({{1, 1.0, 0.01}, {1, 1.1, 0.01}}, {50.0}, Effort::quick)), InputError);
  EXPECT_THROW(static_cast<void>(stay_posterior({{1, 1.0, 0.0}}, {50.0}, Effort::quick)), InputError);
  EXPECT_THROW(static_cast<void>(stay_posterior({}, {50.0}, Effort::quick)), InputError);
}

}  // namespace
}  // namespace twindeck::identification
