#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace twindeck::sensors {

/// Score of a subset of candidates; larger is better. @param phi  its rows (n_chosen × n_modes)
using Worth = std::function<double(const Eigen::MatrixXd& phi)>;

struct Layout {
  std::vector<Eigen::Index> rows;  ///< candidates, ascending
  double worth = 0.0;
  int exchanges = 0;  ///< made by the search after its start
};

/// Effective independence: of all candidates the one that adds least to det(Phi' Phi) is dropped, until `count` are left. Its
/// contribution is the diagonal of Phi (Phi' Phi)^-1 Phi', which gives the relative fall of the determinant without it.
/// @param phi  (n_candidates × n_modes), of full column rank @param count  >= n_modes
/// @throws InputError  if fewer sensors than modes are requested, or the candidates cannot distinguish the modes
/// Reference: Kammer (1991), Journal of Guidance, Control, and Dynamics 14, 251-259.
[[nodiscard]] Layout effective_independence(const Eigen::Ref<const Eigen::MatrixXd>& phi, Eigen::Index count);

/// Greedy start (the best candidate is added, one by one), then exchanges of one chosen for one unchosen candidate, the best
/// exchange first. The search ends when no single exchange improves the layout.
/// @param start  rows to begin with (may be empty, up to `count`)
/// @param count  sensors wanted, at most n_candidates
[[nodiscard]] Layout greedy_exchange(const Eigen::Ref<const Eigen::MatrixXd>& phi, Eigen::Index count, const Worth& worth,
                                     const std::vector<Eigen::Index>& start = {});

}  // namespace twindeck::sensors
