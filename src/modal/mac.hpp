#pragma once

#include <Eigen/Core>
#include <vector>

namespace twindeck::modal {

/// Modal assurance criterion, paper Eq. (2):  MAC = |phi_nᴴ phi_x|² / ((phi_nᴴ phi_n)(phi_xᴴ phi_x)).
/// @param phi_n  numerical shapes    [-] (n_sensors × n_N), one mode per column
/// @param phi_x  experimental shapes [-] (n_sensors × n_X), rows in the order of phi_n
/// @return [-] (n_N × n_X), entries in [0, 1]; rows and columns as in Table 10
/// @throws InputError  if row counts differ or a column is zero
/// Reference: Allemang (2003), Sound and Vibration 37(8), 14-23.
[[nodiscard]] Eigen::MatrixXd mac(const Eigen::Ref<const Eigen::MatrixXcd>& phi_n,
                                  const Eigen::Ref<const Eigen::MatrixXcd>& phi_x);
[[nodiscard]] Eigen::MatrixXd mac(const Eigen::Ref<const Eigen::MatrixXd>& phi_n,
                                  const Eigen::Ref<const Eigen::MatrixXd>& phi_x);

/// The same for experimental modes that were measured at different channels. NaN in a column of phi_x means that the mode was
/// not measured at that channel; the shapes are compared over the other channels. A numerical mode that is zero there has MAC
/// 0.
/// @throws InputError  if a mode was measured at no channel
[[nodiscard]] Eigen::MatrixXd mac_where_measured(const Eigen::Ref<const Eigen::MatrixXcd>& phi_n,
                                                 const Eigen::Ref<const Eigen::MatrixXcd>& phi_x);
/// Rows of a column that are not NaN.
[[nodiscard]] std::vector<Eigen::Index> measured_rows(const Eigen::Ref<const Eigen::VectorXcd>& shape);

/// Mass-weighted MAC of two sets of full shapes: squared cosines in the M inner product (1 = the same mode).
/// @param mass_phi_a  M phi_a (n × n_a), so that the product with M is made once
/// @param phi_a, phi_b  mass-normalised (n × n_a), (n × n_b)
[[nodiscard]] Eigen::MatrixXd mass_weighted_mac(const Eigen::Ref<const Eigen::MatrixXd>& mass_phi_a,
                                                const Eigen::Ref<const Eigen::MatrixXd>& phi_b);

}  // namespace twindeck::modal
