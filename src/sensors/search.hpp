#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace twindeck::sensors {

/// What a subset of candidates is worth; larger is better. @param phi  its rows (n_chosen × n_modes)
using Worth = std::function<double(const Eigen::MatrixXd& phi)>;

struct Layout {
  std::vector<Eigen::Index> rows;  ///< candidates, ascending
  double worth = 0.0;
  int exchanges = 0;               ///< that the search made after its start
};

/// Effective independence: of all candidates the one that adds least to det(Phi' Phi) is dropped, until `count` are left. Its share is
/// the diagonal of Phi (Phi' Phi)^-1 Phi', which tells by what factor the determinant falls without it.
/// @param phi  (n_candidates × n_modes), of full column rank @param count  >= n_modes
/// @throws InputError  if fewer sensors than modes are asked for, or the candidates can't tell the modes apart
/// Reference: Kammer (1991), Journal of Guidance, Control, and Dynamics 14, 251-259.
[[nodiscard]] Layout effective_independence(const Eigen::Ref<const Eigen::MatrixXd>& phi, Eigen::Index count);

/// Greedy start (the candidate that is worth most is added, one by one), then exchanges of one chosen for one not chosen candidate,
/// the best of all first, until none helps: a layout that no single exchange betters.
/// @param start  rows to begin with (may be empty, up to `count`)
/// @param count  sensors wanted, at most n_candidates
[[nodiscard]] Layout greedy_exchange(const Eigen::Ref<const Eigen::MatrixXd>& phi, Eigen::Index count, const Worth& worth,
                                     const std::vector<Eigen::Index>& start = {});

}  // namespace twindeck::sensors
