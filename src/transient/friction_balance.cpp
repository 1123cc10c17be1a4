#include "transient/friction_balance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace twindeck::transient {

using Eigen::Index;

namespace {

/// The same forces as the minimum of 1/2 F' (G + 1/k) F - F' (x_free - x_p) within ±F_c, by active sets. It is strictly convex
/// and each step lowers it, so that no set of sliding units comes twice. @param force  in: any; out: the forces
bool minimise_within_thresholds(const Eigen::VectorXd& shift_N, const Eigen::MatrixXd& stiff_flexibility,
                                const Eigen::VectorXd& limit_N, Eigen::VectorXd& force_N) {
  const Index n = shift_N.size();
  force_N = force_N.cwiseMin(limit_N).cwiseMax(-limit_N);
  std::vector<double> side(static_cast<std::size_t>(n), 0.0);  // +1, -1 where the unit slides
  for (Index i = 0; i < n; ++i) {
    if (std::abs(force_N[i]) >= limit_N[i]) side[static_cast<std::size_t>(i)] = std::copysign(1.0, force_N[i]);
  }
  for (Index iteration = 0; iteration < 100 + 20 * n; ++iteration) {
    std::vector<Index> stuck;
    for (Index i = 0; i < n; ++i) {
      if (side[static_cast<std::size_t>(i)] == 0.0) stuck.push_back(i);
    }
    // 1. Towards the balance of the stuck units, as far as the first threshold.
    if (!stuck.empty()) {
      const auto size = static_cast<Index>(stuck.size());
      Eigen::VectorXd sliding = force_N;
      sliding(stuck).setZero();
      const Eigen::VectorXd right = (shift_N - stiff_flexibility * sliding)(stuck), from = force_N(stuck);
      const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(size, size) + stiff_flexibility(stuck, stuck);
      const Eigen::VectorXd to = left.partialPivLu().solve(right);
      double step = 1.0;
      Index first = -1;
      for (Index i = 0; i < size; ++i) {
        const double limit = limit_N[stuck[static_cast<std::size_t>(i)]];
        if (std::abs(to[i]) <= limit) continue;
        const double part = (std::copysign(limit, to[i]) - from[i]) / (to[i] - from[i]);
        if (first < 0 || part < step) step = part, first = i;
      }
      force_N(stuck) = Eigen::VectorXd(from + step * (to - from));
      if (first >= 0) {
        const Index at = stuck[static_cast<std::size_t>(first)];
        side[static_cast<std::size_t>(at)] = std::copysign(1.0, to[first]);
        force_N[at] = side[static_cast<std::size_t>(at)] * limit_N[at];
        continue;
      }
    }
    // 2. The sliding unit whose spring asks for least beyond its threshold sticks again.
    const Eigen::VectorXd flexible = stiff_flexibility * force_N, excess = shift_N - flexible - force_N;
    Index release = -1;
    double worst = 0.0;
    for (Index i = 0; i < n; ++i) {
      const double back = -side[static_cast<std::size_t>(i)] * excess[i];
      const double rounding = 1e-12 * (std::abs(shift_N[i]) + std::abs(flexible[i]) + std::abs(force_N[i]));
      if (limit_N[i] > 0.0 && back > rounding && back > worst) worst = back, release = i;
    }
    if (release < 0) return true;
    side[static_cast<std::size_t>(release)] = 0.0;
  }
  return false;
}

}  // namespace

bool balance_friction(const Eigen::Ref<const Eigen::VectorXd>& free_m, const Eigen::Ref<const Eigen::MatrixXd>& flexibility,
                      const Eigen::Ref<const Eigen::VectorXd>& stiffness_N_m,
                      const Eigen::Ref<const Eigen::VectorXd>& threshold_N, const Eigen::Ref<const Eigen::VectorXd>& plastic_m,
                      Eigen::VectorXd& force_N) {
  const Index n = free_m.size();
  std::vector<Index> stuck;
  for (int iteration = 0; iteration < 100; ++iteration) {
    // Which units the trial force of the present guess leaves stuck; the others carry their threshold.
    const Eigen::VectorXd trial = stiffness_N_m.cwiseProduct(free_m - flexibility * force_N - plastic_m);
    Eigen::VectorXd next(n);
    stuck.clear();
    for (Index i = 0; i < n; ++i) {
      if (std::abs(trial[i]) <= threshold_N[i]) {
        stuck.push_back(i);
        next[i] = 0.0;
      } else {
        next[i] = std::copysign(threshold_N[i], trial[i]);
      }
    }
    if (!stuck.empty()) {
      const auto size = static_cast<Index>(stuck.size());
      const Eigen::VectorXd k = stiffness_N_m(stuck);
      const Eigen::VectorXd right = k.cwiseProduct((free_m - plastic_m - flexibility * next)(stuck));
      const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(size, size) + k.asDiagonal() * flexibility(stuck, stuck);
      next(stuck) = Eigen::VectorXd(left.partialPivLu().solve(right));
    }
    const double change = (next - force_N).cwiseAbs().maxCoeff();
    force_N = next;
    if (change <= 1e-10 * std::max(1.0, threshold_N.maxCoeff())) return true;
  }
  // Where springs are stiff beside the structure's own flexibility, k G > 1, the sets may come in a circle.
  const Eigen::VectorXd limit = (stiffness_N_m.array() > 0.0).select(threshold_N, 0.0);
  return minimise_within_thresholds(stiffness_N_m.cwiseProduct(free_m - plastic_m), stiffness_N_m.asDiagonal() * flexibility,
                                    limit, force_N);
}

}  // namespace twindeck::transient
