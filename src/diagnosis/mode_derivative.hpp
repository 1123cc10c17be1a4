#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/state_modes.hpp"

namespace twindeck::diagnosis {

/// Derivatives of one mode with respect to changes dK_j, dM_j, from the bordered system (Nelson 1976; Lee, Kim and Jung 1999
/// for damped systems). Amplitudes at friction elements are held.
struct ModeDerivative {
  Eigen::VectorXcd s;       ///< (n_changes)
  Eigen::MatrixXcd shapes;  ///< (n × n_changes)
};
/// @param stiffness, mass  (n_changes) matrices (n × n), size 0 for no change
[[nodiscard]] ModeDerivative differentiate(const StructureState& state, const StateModes& modes, Eigen::Index mode,
                                           const std::vector<Eigen::MatrixXd>& stiffness,
                                           const std::vector<Eigen::MatrixXd>& mass);

}  // namespace twindeck::diagnosis
