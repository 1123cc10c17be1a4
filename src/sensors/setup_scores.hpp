#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "sensors/layout.hpp"

/// How well setups tell a model's modes apart, and which would do it better (paper section 3.1, Table 3).
namespace twindeck::sensors {

/// A setup with its scores.
struct ScoredSetup {
  std::string name, family;
  std::vector<Eigen::Index> rows;  ///< candidates, in the order of its channels
  std::vector<std::string> channels;
  double score = 0.0;            ///< R_k, Eq. (1)
  double log_determinant = 0.0;  ///< of modes scaled to unit norm over all candidates
  long draws = 0;                ///< candidate setups of its family that were drawn
  double best_drawn = 0.0, median_drawn = 0.0;
  double better_drawn_pct = 0.0;  ///< how many of them score lower
};

/// All candidates: two channels a point, vertical and radial.
[[nodiscard]] std::vector<LayoutChannel> candidate_channels(const std::vector<LayoutPoint>& points);

/// Scores of the given setups; for each, `draws` candidates of its family: the same lines and directions, points that share a
/// place moved together to another at random; and of 16 channels drawn freely the lowest `free_setups`, family "dec" (DC1, DC2,
/// …). Then the searches: effective independence, greatest determinant, least R_k by greedy start and exchange.
/// @param phi  (n_candidates × n_modes)
[[nodiscard]] std::vector<ScoredSetup> score_setups(const LayoutSettings& config, const std::vector<LayoutPoint>& points,
                                                    const std::vector<LayoutChannel>& candidates,
                                                    const std::vector<LayoutChannel>& setups, const Eigen::MatrixXd& phi,
                                                    std::uint64_t seed);

/// @throws InputError  for a setup of the blind test that score_setups will not score
void refuse_unknown_blind_setups(const LayoutSettings& config, const std::vector<LayoutChannel>& setups);

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

/// MAC of a set of shapes with itself, as seen by the sensors: 1 on the diagonal, elsewhere the similarity of two modes.
/// A mode that is zero at all sensors counts as equal to all others: 1.
/// @param phi  [-] (n_sensors × n_modes) @return [-] (n_modes × n_modes)
[[nodiscard]] Eigen::MatrixXd auto_mac(const Eigen::Ref<const Eigen::MatrixXd>& phi);

/// Score of a setup, paper Eq. (1): R_k = sum over i, j ≠ i of MAC(i, j) / (n (n - 1)), the mean MAC outside the diagonal; 0:
/// all modes are distinguished. (The printed lower limit of the sum, "i = j", is taken as i = 1.)
/// @param phi  (n_sensors × n_modes), n_modes >= 2 @return [-] in [0, 1]
[[nodiscard]] double decoupling_score(const Eigen::Ref<const Eigen::MatrixXd>& phi);

/// ln det(Phi' Phi) after each mode is scaled to unit norm over all candidates: the volume that the shapes span at
/// the sensors. -infinity if the shapes are linearly dependent, for example with fewer sensors than modes. By QR with column
/// pivoting of Phi, det(Phi' Phi) = product of r_ii²: the rank of the product Phi' Phi itself is lost in rounding. The scaling
/// by candidates keeps the value comparable between subsets.
/// @param phi  rows of a subset (n_sensors × n_modes), already scaled
[[nodiscard]] double log_determinant(const Eigen::Ref<const Eigen::MatrixXd>& phi);

}  // namespace twindeck::sensors
