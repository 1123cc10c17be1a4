#pragma once

#include <string>

#include "fe/mass_properties.hpp"

namespace twindeck::fe {

/// Mass, centre of mass and inertia of an imported model in one line, to be held against what the other program prints:
/// "mass 275.07 kg, centre of mass at (1, 0, 2.5) m; inertia about it, axes x y z: xx 12, yy …, xy … kg m2". Off the diagonal
/// stands -∫ x y dm. Where masses act in some directions alone, the mass is given for each.
[[nodiscard]] std::string mass_words(const MassProperties& properties);

}  // namespace twindeck::fe
