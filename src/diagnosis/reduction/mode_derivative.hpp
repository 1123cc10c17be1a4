#pragma once

#include <Eigen/Core>

#include "diagnosis/reduction/state_modes.hpp"

namespace twindeck::diagnosis {

/// Derivatives of one mode with respect to changes dK_j, dM_j, from the bordered system (Nelson 1976; Lee, Kim and Jung 1999
/// for damped systems). Amplitudes at friction elements are constant.
struct ModeDerivative {
  Eigen::VectorXcd s;       ///< (n_changes)
  Eigen::MatrixXcd shapes;  ///< (n × n_changes) without the part along the shape itself
  Eigen::VectorXcd along;   ///< (n_changes) part along the shape: d phi = shapes + phi along'
};
/// @param force  -(dK_j + s² dM_j) phi (n × n_changes); for an undamped state the real part is used
[[nodiscard]] ModeDerivative differentiate(const StructureState& state, const StateModes& modes, Eigen::Index mode,
                                           const Eigen::MatrixXcd& force);

/// Part of the derivative along the shape, from the normalisation phi' T'(s) phi = 2 s (phi' M phi = 1 for an undamped state),
/// while s and M change.
/// @param ds  (n_changes) of s @param inertia  dM_j phi (n × n_changes) @return (n_changes)
[[nodiscard]] Eigen::VectorXcd along_the_shape(const StructureState& state, const StateModes& modes, Eigen::Index mode,
                                               const Eigen::VectorXcd& ds, const Eigen::MatrixXcd& inertia);

}  // namespace twindeck::diagnosis
