#include "aero/strip.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace twindeck::aero {

Strip make_strip(const std::string& deck, int section, double station_m, double length_m, const Eigen::Vector3d& x_m,
                 const Eigen::Vector3d& tangent, const Wind& wind) {
  Strip strip{.deck = deck, .section = section, .station_m = station_m, .length_m = length_m, .x_m = x_m};
  // The slope of the deck is small: chord, normal and yaw are taken in plan.
  Eigen::Vector3d normal(-tangent.y(), tangent.x(), 0.0);
  normal.normalize();
  if (normal.dot(wind.direction) < 0.0) normal = -normal;
  strip.normal = normal;
  strip.yaw_rad = std::atan2(normal.cross(wind.direction).z(), normal.dot(wind.direction));
  static_cast<void>(yaw_cosine(strip.yaw_rad));  // throws along the deck
  return strip;
}

Kinematics kinematics(const Strip& strip, ForceAxes axes, const Wind& wind) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ(), y = axes == ForceAxes::deck ? strip.normal : wind.direction;
  Kinematics r = Kinematics::Zero();
  r.block<1, 3>(0, 0) = y.transpose();
  r.block<1, 3>(1, 0) = up.transpose();
  r.block<1, 3>(2, 3) = up.cross(y).transpose();
  return r;
}

double nose_up(const Strip& strip, const Eigen::Vector3d& rotation) {
  return Eigen::Vector3d::UnitZ().cross(strip.normal).dot(rotation);
}

}  // namespace twindeck::aero
