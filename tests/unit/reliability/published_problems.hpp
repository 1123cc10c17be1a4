#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "reliability/form.hpp"
#include "reliability/random_inputs.hpp"
#include "reliability/subset_simulation.hpp"

/// Limit states with known probabilities, in standard normal space.
namespace twindeck::reliability::published {

/// R - S with R of (7, 1) and S of (2, 1), both normal: beta 5/sqrt(2).
inline double resistance_less_load(const Eigen::VectorXd& u) { return 5.0 + u[0] - u[1]; }

/// Series system of four branches, k = 7: 2.2228e-3 (Waarts 2000; Schueremans and Van Gemert 2005).
inline double four_branches(const Eigen::VectorXd& u) {
  const double bend = 3.0 + 0.1 * (u[0] - u[1]) * (u[0] - u[1]), sum = (u[0] + u[1]) / std::numbers::sqrt2;
  const double end = 7.0 / std::numbers::sqrt2;
  return std::min({bend - sum, bend + sum, u[0] - u[1] + end, u[1] - u[0] + end});
}

/// Problems 22, 25 and 31 of the reliability benchmark (Rozsas and Slobbe 2019): 4.2073e-3, 4.1486e-5, 3.2267e-3.
inline double rp22(const Eigen::VectorXd& u) {
  return 2.5 - (u[0] + u[1]) / std::numbers::sqrt2 + 0.1 * (u[0] - u[1]) * (u[0] - u[1]);
}
inline double rp25(const Eigen::VectorXd& u) { return std::max(u[0] * u[0] - 8.0 * u[1] + 16.0, -16.0 * u[0] + u[1] + 32.0); }
inline double rp31(const Eigen::VectorXd& u) { return 2.0 - u[1] + 256.0 * std::pow(u[0], 4); }

/// A rod of 20 mm in tension: strength lognormal (3 MPa, 0.3 MPa), force normal (750 N, 50 N); 0.029198 (OpenTURNS' example).
inline std::function<double(const Eigen::VectorXd&)> axial_beam() {
  RandomInput strength, force;
  strength.name = "R";
  strength.kind = LawKind::lognormal;
  strength.mean = 3e6;
  strength.deviation = 3e5;
  force.name = "F";
  force.mean = 750.0;
  force.deviation = 50.0;
  return [inputs = RandomVector({strength, force})](const Eigen::VectorXd& u) {
    const Eigen::VectorXd x = inputs.values(u);
    return x[0] - x[1] / (std::numbers::pi * 1e-4);
  };
}

/// Linear limit state at a distance beta from the origin in any dimension: Phi(-beta).
inline std::function<double(const Eigen::VectorXd&)> linear(double beta) {
  return [beta](const Eigen::VectorXd& u) { return beta - u.sum() / std::sqrt(static_cast<double>(u.size())); };
}

/// Two regions of which the slope of g at the origin hides the more probable one: Phi(-4) + Phi(-5), 3.2e-5 (Breitung 2019).
inline double hidden_region(const Eigen::VectorXd& u) {
  const double first = u[0] > 3.5 ? 4.0 - u[0] : 0.85 - 0.1 * u[0], second = u[1] > 2.0 ? 0.5 - 0.1 * u[1] : 2.3 - u[1];
  return std::min(first, second);
}

/// A problem of the comparison with a peer (tests/bench, docs/reliability.md), by its name there.
struct Problem {
  std::string name;
  std::function<double(const Eigen::VectorXd&)> g;
  Eigen::Index n;  ///< dimension
};
inline std::vector<Problem> all() {
  return {{"R-S", resistance_less_load, 2},
          {"four_branches", four_branches, 2},
          {"beam", axial_beam(), 2},
          {"RP22", rp22, 2},
          {"RP25", rp25, 2},
          {"RP31", rp31, 2},
          {"RP107", linear(5.0), 10},
          {"linear_2", linear(3.5), 2},
          {"linear_20", linear(3.5), 20},
          {"linear_200", linear(3.5), 200}};
}

/// The comparison's search: from the medians alone, without the test for further points.
inline FormOptions design_point_alone(std::uint64_t seed = 1) {
  FormOptions options;
  options.starts = 0;
  options.largest_test = 0;
  options.seed = seed;
  return options;
}

/// Mean of this many runs of subset simulation, of the seeds from 1 on, with their calls in the mean.
inline constexpr int kSubsetRuns = 20;
struct MeanSubset {
  double probability = 0.0;
  int calls = 0;
};
inline MeanSubset mean_subset(const Problem& problem) {
  MeanSubset out;
  for (int seed = 1; seed <= kSubsetRuns; ++seed) {
    SubsetOptions options;
    options.seed = static_cast<std::uint64_t>(seed);
    const SubsetResult run = subset_simulation(problem.g, problem.n, options);
    out.probability += run.probability / kSubsetRuns;
    out.calls += run.calls;
  }
  out.calls /= kSubsetRuns;
  return out;
}

}  // namespace twindeck::reliability::published
