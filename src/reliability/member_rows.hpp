#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/loaded_model.hpp"

namespace twindeck::reliability {

/// Forces or strokes of members, as rows of sensors.
struct MemberRows {
  std::vector<std::string> names;
  Eigen::VectorXd area_m2, pull_N;  ///< of stays: section and static force (dead load and cable forces, no wind)
  Eigen::MatrixXd rows;             ///< (n_members × m) force [N] or elongation [m] per unit of each coordinate
};
/// Axial forces of the stays, E A/L times the elongation of the chord, with Dischinger's modulus
/// at the static force.
/// @param vectors  (n × m) coordinates over the free degrees of freedom
[[nodiscard]] MemberRows stay_forces(const dynamics::LoadedModel& loaded, const Eigen::MatrixXd& vectors);
/// Elongations of the dampers between their ends; of one in series with a spring, of both together.
[[nodiscard]] MemberRows damper_strokes(const dynamics::LoadedModel& loaded, const Eigen::MatrixXd& vectors);

}  // namespace twindeck::reliability
