#include "wind/profile.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace twindeck::wind {

double mean_speed(double friction_velocity_m_s, double z_m, double z0_m) {
  if (!(friction_velocity_m_s > 0.0) || !(z0_m > 0.0) || !(z_m > z0_m)) {
    throw InputError(
        {"", 0, "wind profile"},
        fmt::format("has u* = {} m/s, z = {} m, z0 = {} m, expected u* > 0 and z > z0 > 0", friction_velocity_m_s, z_m, z0_m),
        "give the height above ground and the roughness length in metres");
  }
  return friction_velocity_m_s / von_karman_constant * std::log(z_m / z0_m);
}

double roughness_for(double friction_velocity_m_s, double z_m, double speed_m_s) {
  return z_m * std::exp(-von_karman_constant * speed_m_s / friction_velocity_m_s);
}

}  // namespace twindeck::wind
