#pragma once

#include <Eigen/Core>
#include <string>

#include "aero/derivatives.hpp"
#include "aero/polar.hpp"
#include "aero/yaw_rule.hpp"

namespace twindeck::aero {

/// The mean wind: the same at every aerodynamic node.
struct Wind {
  double density_kg_m3 = 1.25;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitY();  ///< horizontal unit vector, where it blows to
};

/// Aerodynamic properties of one deck's section.
struct SectionAero {
  std::string name;  ///< the deck's
  double chord_m = 0.0;
  Polar polar;
  DerivativesPtr derivatives;
};

/// An aerodynamic node: a strip of deck that takes wind forces at one point.
struct Strip {
  std::string deck;
  int section = 0;         ///< position in the list of sections
  double station_m = 0.0;  ///< along the deck, for output
  double length_m = 0.0;   ///< influence length L
  Eigen::Vector3d x_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  ///< horizontal unit normal of the deck, to the lee side
  double yaw_rad = 0.0;    ///< theta, from the normal to the wind, anticlockwise in plan, |theta| < 90 degrees
  double alpha_rad = 0.0;  ///< mean angle of attack, nose-up
};

/// A strip of a deck that runs along `tangent`; normal and yaw follow from the wind.
/// @throws InputError  where the wind blows along the deck (|yaw| of 90 degrees)
[[nodiscard]] Strip make_strip(const std::string& deck, int section, double station_m, double length_m,
                               const Eigen::Vector3d& x_m, const Eigen::Vector3d& tangent, const Wind& wind);

/// Global motions (x y z rx ry rz) of a strip's point -> (y, z, alpha) along the rule's axes; its transpose takes (D, L, M) to
/// global forces and moments. alpha is nose-up: about e_z × e_y.
using Kinematics = Eigen::Matrix<double, 3, 6>;
[[nodiscard]] Kinematics kinematics(const Strip& strip, ForceAxes axes, const Wind& wind);
/// Nose-up rotation about the deck's own axis of a rotation vector.
[[nodiscard]] double nose_up(const Strip& strip, const Eigen::Vector3d& rotation);

}  // namespace twindeck::aero
