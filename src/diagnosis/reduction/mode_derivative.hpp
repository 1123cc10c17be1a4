#pragma once

#include <Eigen/Core>

#include "diagnosis/reduction/state_modes.hpp"

namespace twindeck::diagnosis {

/// Derivatives of one mode with respect to changes dK_j, dM_j, from the bordered system (Nelson 1976; Lee, Kim and Jung 1999
/// for damped systems). Amplitudes at friction elements are held.
struct ModeDerivative {
  Eigen::VectorXcd s;       ///< (n_changes)
  Eigen::MatrixXcd shapes;  ///< (n × n_changes) but for a part along the shape itself
  Eigen::VectorXcd along;   ///< (n_changes) that part: d phi = shapes + phi along'
};
/// @param force  -(dK_j + s² dM_j) phi (n × n_changes); of an undamped state the real part counts
[[nodiscard]] ModeDerivative differentiate(const StructureState& state, const StateModes& modes, Eigen::Index mode,
                                           const Eigen::MatrixXcd& force);

/// What keeps phi' T'(s) phi = 2 s (phi' M phi = 1 of an undamped state) while s and M change: the part of the derivative along
/// the shape.
/// @param ds  (n_changes) of s @param inertia  dM_j phi (n × n_changes) @return (n_changes)
[[nodiscard]] Eigen::VectorXcd along_the_shape(const StructureState& state, const StateModes& modes, Eigen::Index mode,
                                               const Eigen::VectorXcd& ds, const Eigen::MatrixXcd& inertia);

}  // namespace twindeck::diagnosis
