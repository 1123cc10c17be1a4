#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "fe/model.hpp"

/// Inside of the library: a node that follows another as the end of a rigid arm r, u_s = u_m + theta_m × r, theta_s = theta_m.
namespace twindeck::model_io {

/// Factor of the master's degree of freedom `from` (0-5) in the slave's `to`.
inline double rigid_arm_factor(const Eigen::Vector3d& r, int to, int from) {
  if (to == from) return 1.0;
  if (to > 2 || from < 3) return 0.0;
  return Eigen::Vector3d::Unit(from - 3).cross(r)[to];
}

/// One displacement of `slave` that follows `master` so; nodes by their positions in the model.
inline fe::Constraint at_rigid_arm(const std::string& name, const fe::Model& model, int master, int slave, int direction) {
  constexpr double nothing = 1e-12;  ///< [-] of the arm: rounding of coordinates
  const Eigen::Vector3d r =
      model.nodes[static_cast<std::size_t>(slave)].x_m - model.nodes[static_cast<std::size_t>(master)].x_m;
  fe::Constraint c{name, slave, direction, {{master, direction, 1.0}}};
  for (int about = 3; about < 6 && direction < 3; ++about) {
    const double factor = rigid_arm_factor(r, direction, about);
    if (std::abs(factor) > nothing * r.norm()) c.terms.push_back({master, about, factor});
  }
  return c;
}

}  // namespace twindeck::model_io
