#pragma once

#include <Eigen/Core>

#include "diagnosis/reduction/state_modes.hpp"

namespace twindeck::diagnosis {

/// Derivatives of one mode with respect to changes dK_j, dM_j, from the bordered system (Nelson 1976; Lee, Kim and Jung 1999
/// for damped systems). Amplitudes at friction elements are held.
struct ModeDerivative {
  Eigen::VectorXcd s;       ///< (n_changes)
  Eigen::MatrixXcd shapes;  ///< (n × n_changes)
};
/// @param force  -(dK_j + s² dM_j) phi (n × n_changes); of an undamped state the real part counts
[[nodiscard]] ModeDerivative differentiate(const StructureState& state, const StateModes& modes, Eigen::Index mode,
                                           const Eigen::MatrixXcd& force);

}  // namespace twindeck::diagnosis
