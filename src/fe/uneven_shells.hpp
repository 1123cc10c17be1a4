#pragma once

#include "fe/model.hpp"

namespace twindeck::fe {

/// Slabs as they are poured: the thickness of each shell element is that of its section times
///
///     1 + u f(x),   f a sum of cosines of x with unit mean square, wavelengths from `wavelength_m` to a third of it,
///
/// rounded to seven classes, for which sections are added ("slab_foot_B~+2"). Phases are fixed by the section's group of names, so
/// that two decks are uneven in different places.
/// @param unevenness    u, standard deviation of the thickness over its nominal value [-], in [0, 0.3]
/// @param wavelength_m  longest, along x
[[nodiscard]] Model with_uneven_shells(Model model, double unevenness, double wavelength_m);

}  // namespace twindeck::fe
