#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/state_space.hpp"

namespace twindeck::identification {

/// A small change dH of the Hankel or Toeplitz matrix, reduced to the parts that affect poles of any order: small matrices made
/// from  W = dH V  (one product with the n_max right singular vectors). No matrix of the size of vec(H) is formed.
struct SubspaceChange {
  Eigen::MatrixXd inner;     ///< U' W (n_max × n_max)
  Eigen::MatrixXd up, down;  ///< Q' W_perp of its upper and lower rows (n_max × n_max), W_perp = (1 - U U') W
  Eigen::MatrixXd cross;     ///< O_down' W_perp,up (n_max × n_max)
  Eigen::MatrixXd top;       ///< first n_outputs rows of W_perp
};

/// @param w  dH V (rows of H × n_max)
[[nodiscard]] SubspaceChange subspace_change(const Observability& observability, const ShiftModels& models,
                                             const Eigen::MatrixXd& w);

/// First-order change of a pole.
struct PoleChange {
  double frequency_Hz = 0.0, damping_ratio = 0.0;
  Eigen::VectorXcd shape;  ///< (n_outputs) of the normalised shape (unit norm, phase as in normalised_shape)
};

/// First-order change of all poles of one order. The subspace of the leading n singular vectors changes by
///
///     dU = sum over k > n of u_k (sigma_j u_k' dH v_j + sigma_k u_j' dH v_k) / (sigma_j² - sigma_k²),
///
/// exact for k up to n_max and with sigma_k = 0 beyond; then  dA = R^-1 [Q'(dO_down - dO_up A) + R^-T dO_up' (O_down - O_up
/// A)], d mu = chi' dA phi,  and the shape C phi follows from dC and d phi.
/// @param order  position in models.orders @return one entry for each of its poles
/// References: Reynders, Pintelon and De Roeck (2008), Mech. Syst. Signal Process. 22, 948-969; Doehler and Mevel (2013), Mech.
/// Syst. Signal Process. 38, 346-366 (structured form).
[[nodiscard]] std::vector<PoleChange> pole_changes(const Observability& observability, const ShiftModels& models,
                                                   std::size_t order, const SubspaceChange& change);

}  // namespace twindeck::identification
