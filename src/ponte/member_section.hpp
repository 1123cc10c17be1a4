#pragma once

#include <string>

#include "fe/model.hpp"

namespace twindeck::ponte {

class DefinitionFile;

/// Circular tube: A = pi/4 (D² - d²), I = pi/64 (D⁴ - d⁴), J = 2 I, shear areas A/2 (thin tube, Cowper 1966).
[[nodiscard]] fe::Section tube_section(const std::string& name, double diameter_m, double wall_m);
/// Solid circle; shear areas 0.9 A.
[[nodiscard]] fe::Section solid_circle_section(const std::string& name, double diameter_m);
/// Solid rectangle; `depth` along local z, `width` along local y; torsion b t³ (1/3 - 0.21 t/b (1 - t⁴/(12 b⁴))) for b >= t
/// (Roark), shear areas 5/6 A.
[[nodiscard]] fe::Section rectangle_section(const std::string& name, double depth_m, double width_m);
/// A, I_y, I_z, J and the shear areas times a factor: an effective section, fitted.
[[nodiscard]] fe::Section scaled(fe::Section section, double factor);

/// The table `path` of bridge.toml: shape (tube | square_hollow | rolled) with its sizes, and scale.
/// @throws InputError for a size out of range, a wall of more than half the width
[[nodiscard]] fe::Section read_member_section(DefinitionFile& file, const std::string& path, const std::string& name);

}  // namespace twindeck::ponte
