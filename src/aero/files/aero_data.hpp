#pragma once

#include <filesystem>

#include "aero/derivative_table.hpp"
#include "aero/derivatives.hpp"
#include "aero/polar.hpp"

namespace twindeck::aero {

/// Reads a polar: `alpha_deg,C_D,C_L,C_M` (nose-up, lift up, all on the chord B) and, where they are there, the slopes
/// `dC_D_per_rad,dC_L_per_rad,dC_M_per_rad`; missing slopes come from central differences of the rows.
/// @throws InputError  with file, line and column
[[nodiscard]] Polar read_polar(const std::filesystem::path& file);

/// Reads flutter derivatives: one reduced velocity, named by its column `V_over_fB` or `V_over_omegaB` (= V_over_fB/2π), the
/// angle of attack `alpha_deg` (one for all if the column is missing), and the eighteen values, whose names tell the
/// convention: `h1 … h6, p1 … p6, a1 … a6` Zasso's, `H1 … H6, P1 … P6, A1 … A6` Scanlan's with ½ρV²B. Rows are a full grid in
/// any order.
/// @throws InputError  for a reduced velocity under any other name, both at once, mixed conventions, an incomplete grid
[[nodiscard]] DerivativeTable read_flutter_derivatives(const std::filesystem::path& file, OutOfRange below = OutOfRange::refuse,
                                                       OutOfRange above = OutOfRange::refuse);

}  // namespace twindeck::aero
