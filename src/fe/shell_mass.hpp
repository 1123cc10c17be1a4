#pragma once

#include "fe/element_matrices.hpp"
#include "fe/shell_membrane.hpp"

namespace twindeck::fe {

/// Consistent mass of `mass_per_area` [kg/m²]: bilinear translations; `rotary_per_area` [kg] (rho t³/12) on the bending
/// rotations; drilling rotations have none.
[[nodiscard]] Matrix24 shell_mass(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area);
/// Row sums of the same on the diagonal of each corner.
[[nodiscard]] Matrix24 shell_mass_lumped(const ShellGeometry& geometry, double mass_per_area, double rotary_per_area);
[[nodiscard]] double shell_area(const ShellGeometry& geometry);

}  // namespace twindeck::fe
