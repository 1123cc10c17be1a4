#pragma once

#include "fe/elements.hpp"

namespace twindeck::fe {

/// Spread of the diagonal drilling rule over a shell's corners: adds -k/3 n n' between the rotations of every two corners,
/// where k = factor·E·t·A stands on each corner's rotation about the normal n (DrillingRule::diagonal). Rows of the total, k
/// (δ_ij - (1 - δ_ij)/3), sum to zero: equal rotations of all corners meet no resistance. The diagonal alone would tie the
/// rotations to ground. Over a deck of hundreds of shells this would be a false stiffness in plan (a radial mode of the Ponte
/// del Mare rises by 17 %). Reference: Zienkiewicz and Taylor (2000), The Finite Element Method, vol. 2, section 6.5 (there
/// with -1/2 for triangles).
/// @param factor  0 = the default 0.03 of DrillingRule::diagonal
[[nodiscard]] Matrix24 drilling_spread(const ShellGeometry& geometry, const ShellProperties& properties, double factor);

}  // namespace twindeck::fe
