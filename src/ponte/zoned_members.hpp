#pragma once

#include "fe/model.hpp"

namespace twindeck::ponte {

/// Gives every kind of deck member (foot_top_chord, cycle_long_diagonal, …) a modulus of its own in each of `zones` stretches
/// from mid-length to the ends, and the non-structural mass of each deck a factor in each, as parameters
///
///     E_foot_top_chord_1 (Young's modulus),   m_foot_nonstructural_mass_1 (factor),   …
///
/// Stretches are alike north and south. This is how members come out of a workshop and a site: no two stretches the same.
/// Values stay as they are until the parameters are changed.
/// @param zones  >= 1
[[nodiscard]] fe::Model with_zoned_members(fe::Model model, int zones);

}  // namespace twindeck::ponte
