/// Oracles: published probabilities (published_problems.hpp); first excursion of an oscillator under white noise by direct
/// simulation (4e6 runs). Tolerance: three and a half of the deviations that the runs state themselves, which have to be 0.35
/// at most.
#include "reliability/subset_simulation.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "core/distributions.hpp"
#include "published_problems.hpp"
#include "reliability/form.hpp"

namespace twindeck::reliability {
namespace {

constexpr int kRuns = 5;
constexpr double kLargestVariation = 0.35;

void meets(const LimitState& g, Eigen::Index n, double probability, int samples = 4000) {
  double sum = 0.0, variance = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    SubsetOptions options;
    options.samples = samples;
    options.seed = static_cast<std::uint64_t>(100 + run);
    const SubsetResult found = subset_simulation(g, n, options);
    ASSERT_TRUE(found.status.converged) << found.status.message;
    EXPECT_LT(found.variation, kLargestVariation);
    sum += found.probability;
    variance += found.variation * found.variation;
  }
  EXPECT_NEAR(sum / kRuns / probability, 1.0, 3.5 * std::sqrt(variance) / kRuns);
}

TEST(SubsetSimulation, MeetsThePublishedProbabilities) {
  meets(published::four_branches, 2, 2.2228e-3);
  meets(published::rp22, 2, 4.2073e-3);
  meets(published::rp31, 2, 3.2267e-3);
  meets(published::rp25, 2, 4.1486e-5);
  meets(published::linear(5.0), 10, 2.8665e-7);  // problem 107
  meets(published::axial_beam(), 2, 0.029198);
}

TEST(SubsetSimulation, IsRightInTheMean) {
  // Forty runs of 8000 samples have 0.09/sqrt(40) = 1.4 % of scatter. Chains whose step depends on the value of their seed are
  // 7 % too high at any number of samples.
  double sum = 0.0;
  constexpr int runs = 40;
  for (int run = 0; run < runs; ++run) {
    SubsetOptions options;
    options.samples = 8000;
    options.seed = static_cast<std::uint64_t>(7919 * (run + 1));
    sum += subset_simulation(published::linear(3.5), 2, options).probability;
  }
  EXPECT_NEAR(sum / runs / normal_tail(3.5), 1.0, 0.045);
}

TEST(SubsetSimulation, DoesNotDependOnTheDimension) {
  for (const int n : {2, 20, 200}) meets(published::linear(3.5), n, normal_tail(3.5), n == 200 ? 2000 : 4000);
}

TEST(SubsetSimulation, FindsFirstExcursionsOfAnOscillator) {
  // omega 7.85 rad/s, 2 %, white force of two-sided density 1 per rad/s held over 0.02 s, 30 s from rest.
  constexpr double omega = 7.85, ratio = 0.02, step = 0.02;
  constexpr int steps = 1500;
  const double damped = omega * std::sqrt(1.0 - ratio * ratio), fade = std::exp(-ratio * omega * step);
  const double c = std::cos(damped * step), s = std::sin(damped * step), slow = ratio * omega / damped;
  // Exact step of free motion about the rest position f/omega² of the held force.
  const double xx = fade * (c + slow * s), xv = fade * s / damped, vx = -fade * omega * omega / damped * s,
               vv = fade * (c - slow * s);
  const double force = std::sqrt(2.0 * std::numbers::pi / step);
  const auto largest = [&](const Eigen::VectorXd& u) {
    double x = 0.0, v = 0.0, top = 0.0;
    for (Eigen::Index k = 0; k < steps; ++k) {
      const double rest = force * u[k] / (omega * omega), from = x - rest;
      x = rest + xx * from + xv * v;
      v = vx * from + vv * v;
      top = std::max(top, std::abs(x));
    }
    return top;
  };
  for (const auto& [level, probability] :
       {std::pair{1.2, 0.1802}, {1.4, 0.0454}, {1.6, 8.33e-3}, {1.8, 1.15e-3}, {2.0, 1.24e-4}}) {
    meets([&](const Eigen::VectorXd& u) { return level - largest(u); }, steps, probability, 1000);
  }
}

TEST(SubsetSimulation, FormShowsTheRegionThatItMisses) {
  // In 100 runs of 1000 samples, 44 miss the more probable region or find it with few chains, and are warned of. The others lie
  // between a third of 3.2e-5 and eight times as much, more than their stated variation of 0.4 says.
  const FormResult points = form(published::hidden_region, 2);
  ASSERT_TRUE(points.status.converged);
  int warned = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SubsetOptions options;
    options.samples = 1000;
    options.seed = seed;
    const SubsetResult subset = subset_simulation(published::hidden_region, 2, options);
    const bool hidden = hidden_region(subset, published::hidden_region, points.points.front().u, seed);
    warned += hidden ? 1 : 0;
    EXPECT_TRUE(hidden || subset.probability > 0.3 * 3.2e-5) << subset.probability;
  }
  EXPECT_GE(warned, 3);
}

TEST(SubsetSimulation, AFoundRegionIsNotHidden) {
  for (const published::Problem& problem : published::all()) {
    const FormResult points = form(problem.g, problem.n);
    if (!points.status.converged) continue;  // problem 25
    EXPECT_FALSE(hidden_region(subset_simulation(problem.g, problem.n), problem.g, points.points.front().u)) << problem.name;
  }
}

TEST(SubsetSimulation, SaysThatALimitIsAlwaysOrNeverExceeded) {
  EXPECT_THROW((void)subset_simulation([](const Eigen::VectorXd&) { return -1.0; }, 2), InputError);
  EXPECT_FALSE(subset_simulation([](const Eigen::VectorXd& u) { return 1.0 + u.squaredNorm(); }, 2).status.converged);
}

}  // namespace
}  // namespace twindeck::reliability
