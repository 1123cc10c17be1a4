#pragma once

#include "fe/model.hpp"

namespace twindeck::fe {

/// Slabs with uneven thickness: the thickness of each shell element is that of its section times
///
///     1 + u f(x),   f a sum of cosines of x with unit mean square, wavelengths from `wavelength_m` to a third of it,
///
/// rounded to seven classes, for which sections are added ("slab_foot_B~+2"). The name of the section's group fixes the phases,
/// so that two decks are uneven at different locations.
/// @param unevenness    u, standard deviation of the thickness over its nominal value [-], in [0, 0.3]
/// @param wavelength_m  longest, along x
[[nodiscard]] Model with_uneven_shells(Model model, double unevenness, double wavelength_m);

}  // namespace twindeck::fe
