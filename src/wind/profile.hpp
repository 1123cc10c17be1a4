#pragma once

namespace twindeck::wind {

/// von Karman's constant as printed in paper Eq. (11).
inline constexpr double von_karman_constant = 0.4;

/// Logarithmic profile of the mean speed, paper Eq. (11):  V(z) = (u* / 0.4) ln(z / z0).
/// @param friction_velocity_m_s  u* = sqrt(tau_0 / rho)  @param z_m  height above ground  @param z0_m  roughness length
/// @return  [m/s]
/// @throws InputError  unless u* > 0 and z > z0 > 0
[[nodiscard]] double mean_speed(double friction_velocity_m_s, double z_m, double z0_m);

/// The roughness length for which the profile has a speed at a height: z0 = z exp(-0.4 V / u*). [m]
[[nodiscard]] double roughness_for(double friction_velocity_m_s, double z_m, double speed_m_s);

}  // namespace twindeck::wind
