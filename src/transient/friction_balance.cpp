#include "transient/friction_balance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace twindeck::transient {

using Eigen::Index;

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
  return false;
}

}  // namespace twindeck::transient
