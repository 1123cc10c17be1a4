#pragma once

#include <Eigen/Core>

#include "diagnosis/reduction/structure_state.hpp"
#include "diagnosis/reduction/undamped_modes.hpp"

namespace twindeck::diagnosis {

/// Modes of a state: eigenvalues s = -zeta omega ± i omega sqrt(1 - zeta²) with positive imaginary part.
struct StateModes {
  Eigen::VectorXcd s;       ///< (n_modes) [rad/s], ascending in |s|
  Eigen::MatrixXcd shapes;  ///< (n × n_modes) phi' T'(s) phi = 2 s (mass-normalised where undamped)
  [[nodiscard]] double frequency_Hz(Eigen::Index i) const;  ///< |s| / 2 pi
  [[nodiscard]] double damping(Eigen::Index i) const;       ///< -Re s / |s|
};

/// Modes up to `highest_Hz`. Undamped states are solved by a symmetric eigenproblem, damped ones, T(s) phi = 0 with T = s² M +
/// K + sum d_k(s, X_k) b_k b_k' and X_k the mode's own amplitude at the element, by Newton on their characteristic equation in
/// the undamped modes. It starts from the roots of `neighbour` (same attachments, other matrices) if there is one, else from
/// the eigenvalues of the low modes. If two roots end in one, or one is lost, a larger state space is solved and each root
/// refined.
/// @param store  undamped modes known so far
[[nodiscard]] StateModes solve_state(const StructureState& state, double highest_Hz, UndampedStore& store,
                                     const StateModes* neighbour = nullptr);

}  // namespace twindeck::diagnosis
