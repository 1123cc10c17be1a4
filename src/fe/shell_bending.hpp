#pragma once

#include "fe/element_matrices.hpp"
#include "fe/shell_membrane.hpp"

namespace twindeck::fe {

/// Bending part, linear in E t³ · bending_inertia_ratio; rx = dw/dy, ry = -dw/dx at the corners.
[[nodiscard]] Matrix24 shell_bending_stiffness(const ShellGeometry& geometry, const ShellProperties& properties);

}  // namespace twindeck::fe
