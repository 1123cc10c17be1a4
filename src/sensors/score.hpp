#pragma once

#include <Eigen/Core>

namespace twindeck::sensors {

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
