/// Oracles: closed moments of a flat spectrum, crossings and first excursions counted in simulated histories of an oscillator
/// under white noise.
#include "reliability/crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"

namespace twindeck::reliability {
namespace {

/// Displacement of an oscillator under white noise, exactly stepped: a Gaussian process of variance 1 and rate variance omega².
class Oscillator {
 public:
  Oscillator(double omega, double ratio, double step, std::uint64_t seed) : seed_(seed) {
    const double damped = omega * std::sqrt(1.0 - ratio * ratio), fade = std::exp(-ratio * omega * step);
    const double c = std::cos(damped * step), s = std::sin(damped * step), slow = ratio * omega / damped;
    xx_ = fade * (c + slow * s);
    xv_ = fade * s / damped * omega;  // the rate is held in units of omega
    vx_ = -fade * omega / damped * s;
    vv_ = fade * (c - slow * s);
    // Covariance of what the noise adds in a step: 1 - A A' of the stationary unit covariance.
    const double p = 1.0 - xx_ * xx_ - xv_ * xv_, q = -(xx_ * vx_ + xv_ * vv_), r = 1.0 - vx_ * vx_ - vv_ * vv_;
    l11_ = std::sqrt(std::max(p, 0.0));
    l21_ = l11_ > 0.0 ? q / l11_ : 0.0;
    l22_ = std::sqrt(std::max(r - l21_ * l21_, 0.0));
    start();
  }
  void start() { start(normal()); }
  void start(double x) {
    x_ = x;
    v_ = normal();
  }
  double next() {
    const double a = normal(), b = normal(), x = xx_ * x_ + xv_ * v_ + l11_ * a;
    v_ = vx_ * x_ + vv_ * v_ + l21_ * a + l22_ * b;
    return x_ = x;
  }
  [[nodiscard]] double now() const { return x_; }

 private:
  double normal() { return normal_number(seed_, 0, index_++); }
  std::uint64_t seed_, index_ = 0;
  double xx_ = 0, xv_ = 0, vx_ = 0, vv_ = 0, l11_ = 0, l21_ = 0, l22_ = 0, x_ = 0, v_ = 0;
};

/// Moments of the oscillator's displacement: lambda_1 of the closed form (Vanmarcke 1972).
SpectralMoments oscillator_moments(double omega, double ratio) {
  SpectralMoments out;
  out.variance = 1.0;
  out.second = omega * omega;
  const double damped = std::sqrt(1.0 - ratio * ratio);
  out.first = omega / damped * (1.0 - 2.0 / std::numbers::pi * std::atan(ratio / damped));
  return out;
}

TEST(Crossings, MomentsOfAFlatSpectrumAreClosed) {
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(2001, 1.0, 3.0), spectrum = Eigen::VectorXd::Constant(2001, 0.5);
  const SpectralMoments found = spectral_moments(f, spectrum);
  const double turn = 2.0 * std::numbers::pi;
  EXPECT_NEAR(found.variance, 1.0, 1e-12);
  EXPECT_NEAR(found.first, turn * 0.25 * (9.0 - 1.0), 1e-6);
  EXPECT_NEAR(found.second, turn * turn * (27.0 - 1.0) / 6.0, 1e-3);
  EXPECT_NEAR(found.fourth, std::pow(turn, 4) * (243.0 - 1.0) / 10.0, 1.0);
}

TEST(Crossings, RicesRateIsTheCountedOne) {
  // One step of the stationary oscillator: the share of starts (x, v) that it takes across the level, over the step. Starts are
  // drawn in a strip below the level alone and weighed by the normal density there, so that 3e6 of them leave 0.2 % of scatter
  // at every level; in a step of 1/8000 period a second crossing is out of reach.
  constexpr double omega = 7.85, step = 1e-4, ratio = 0.02;
  constexpr int starts = 3'000'000;
  const double strip = 6.0 * omega * step;  // six deviations of the rate
  const SpectralMoments moments = oscillator_moments(omega, ratio);
  for (const double level : {2.0, 3.0, 4.0}) {
    Oscillator oscillator(omega, ratio, step, 3);
    double crossed = 0.0;
    for (int k = 0; k < starts; ++k) {
      const double x = level - strip * uniform_number(4, 0, static_cast<std::uint64_t>(k));
      oscillator.start(x);
      if (oscillator.next() >= level) crossed += std::exp(-0.5 * x * x);
    }
    const double counted = crossed / starts * strip / std::sqrt(2.0 * std::numbers::pi) / step;
    EXPECT_NEAR(crossing_rate_Hz(moments, level) / counted, 1.0, 0.01) << level;
  }
}

TEST(Crossings, RicesRateIsThatOfALongHistory) {
  // 2e7 steps of 5 ms: 17,000 crossings of 2 deviations; 20 % of damping keeps clumps short. Tolerance: three deviations.
  constexpr double omega = 7.85, step = 0.005;
  constexpr int steps = 20'000'000;
  Oscillator oscillator(omega, 0.2, step, 3);
  double before = oscillator.now();
  int counted = 0;
  for (int k = 0; k < steps; ++k) {
    const double x = oscillator.next();
    counted += before < 2.0 && x >= 2.0 ? 1 : 0;
    before = x;
  }
  EXPECT_NEAR(counted / (steps * step) / crossing_rate_Hz(oscillator_moments(omega, 0.2), 2.0), 1.0, 0.03);
}

TEST(Crossings, VanmarckesCorrectionTakesClumpsOut) {
  // 2 % of damping, 30 s, 10,000 runs from the stationary state: 0.559 with a deviation of 0.005. Vanmarcke's rate holds for
  // envelopes that forget their past, so that it errs to the safe side in so short a time: 17 % here. Independent crossings are
  // 72 % too many.
  constexpr double omega = 7.85, step = 0.02, level = 2.5, duration = 30.0;
  constexpr int runs = 10000;
  Oscillator oscillator(omega, 0.02, step, 5);
  int exceeded = 0;
  for (int run = 0; run < runs; ++run) {
    oscillator.start();
    bool above = std::abs(oscillator.now()) > level;
    for (int k = 0; k < static_cast<int>(duration / step) && !above; ++k) above = std::abs(oscillator.next()) > level;
    exceeded += above ? 1 : 0;
  }
  const double counted = static_cast<double>(exceeded) / runs;
  const FirstExcursion found = first_excursion(oscillator_moments(omega, 0.02), level, duration);
  EXPECT_NEAR(found.vanmarcke / counted, 1.0, 0.2);
  EXPECT_GT(found.vanmarcke, counted);
  EXPECT_GT(found.poisson, 1.5 * counted);
}

TEST(Crossings, AFarLimitHasItsOwnSmallProbability) {
  // Beyond eight deviations 1 - exp(-x) is rounding. There crossings come alone: 2 nu T exp(-r²/2), Vanmarcke's below
  // Poisson's.
  const SpectralMoments moments = oscillator_moments(7.85, 0.02);
  for (const double level : {9.0, 20.0, 35.0}) {
    const FirstExcursion found = first_excursion(moments, level, 600.0);
    EXPECT_NEAR(found.poisson / (2.0 * 7.85 / (2.0 * std::numbers::pi) * 600.0 * std::exp(-0.5 * level * level)), 1.0, 1e-9);
    EXPECT_GT(found.vanmarcke, 0.3 * found.poisson);
    EXPECT_LE(found.vanmarcke, found.poisson * (1.0 + 1e-2));
  }
}

TEST(Crossings, WithoutMotionNothingIsExceeded) {
  EXPECT_EQ(first_excursion(SpectralMoments{}, 1.0, 600.0).vanmarcke, 0.0);
  EXPECT_EQ(crossing_rate_Hz(SpectralMoments{}, 1.0), 0.0);
}

}  // namespace
}  // namespace twindeck::reliability
