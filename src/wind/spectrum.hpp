#pragma once

#include "wind/component.hpp"

namespace twindeck::wind {

/// von Karman spectrum, one-sided per Hz, n = f L / V with L the component's length scale along the wind:
///
///     along            f S / sigma² = 4 n / (1 + 70.8 n²)^(5/6)                          paper Eq. (16)
///     across, vertical f S / sigma² = 4 n (1 + 755.2 n²) / (1 + 283.2 n²)^(11/6)
///
/// The paper prints only the first and uses it "both for the horizontal and the vertical component"; isotropic turbulence
/// requires the second. Both integrate to sigma² (to the four digits of their constants).
/// @param f_Hz  > 0  @param sigma  [m/s]  @param length_m  L  @param speed_m_s  V
/// @return  S [(m/s)²/Hz]
/// Reference: Teunissen (1980), Boundary-Layer Meteorol. 19, 187-221.
[[nodiscard]] double von_karman_spectrum(Component component, double f_Hz, double sigma, double length_m, double speed_m_s);

}  // namespace twindeck::wind
