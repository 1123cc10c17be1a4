#pragma once

#include <Eigen/Core>
#include <array>

#include "fe/element_matrices.hpp"

namespace twindeck::fe {

/// Bar or stay: axial stiffness EA/L along the chord; string stiffness T/L across it; mass. Translations of two nodes.
/// @throws InputError for a bar without length
[[nodiscard]] Matrix6 bar_stiffness(const std::array<Eigen::Vector3d, 2>& node_m, double youngs_modulus_Pa, double area_m2);
[[nodiscard]] Matrix6 string_stiffness(const std::array<Eigen::Vector3d, 2>& node_m, double pull_N);
[[nodiscard]] Matrix6 bar_mass_consistent(const std::array<Eigen::Vector3d, 2>& node_m, double mass_per_length_kg_m);
[[nodiscard]] Matrix6 bar_mass_lumped(const std::array<Eigen::Vector3d, 2>& node_m, double mass_per_length_kg_m);

}  // namespace twindeck::fe
