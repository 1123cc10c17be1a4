#pragma once

#include <Eigen/Core>

#include "aero/aeroelastic_system.hpp"

namespace twindeck::aero {

/// A of ẋ = A x, x = (q, q̇, e): coordinates, their velocities, and the elongation e of the dashpot of each Maxwell unit,
/// c ė = k (d·q - e).
/// @param air  self-excited forces of one speed and frequency; empty matrices: still air
/// @return (2m + n × 2m + n) for n Maxwell units
[[nodiscard]] Eigen::MatrixXd state_matrix(const ReducedStructure& structure, const AeroelasticSystem::Block& air = {});

}  // namespace twindeck::aero
