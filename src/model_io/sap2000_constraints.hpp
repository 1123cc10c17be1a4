#pragma once

#include <string>
#include <vector>

#include "model_io/deck_model.hpp"

/// Inside of the library: joints of SAP2000 that move alike.
namespace twindeck::model_io {

/// A constraint of the type Body or Diaphragm and its joints.
struct SapConstraint {
  DeckPlace at;      ///< its definition
  std::string name;  ///< of the type and its own
  std::string axis;  ///< normal of a diaphragm: X, Y, Z or AUTO; empty: a body
  bool by_level = false;
  std::vector<int> joints;  ///< by their positions in the model
};

/// Ties the joints of a body in six directions. Those of a diaphragm are tied in the two displacements across its normal n and
/// the rotation about it, u_s = u_m + theta_n n × (x_s - x_m), theta_n,s = theta_n,m: all together, or those of each level
/// along n. They follow the joint with the most supports in tied directions, else the first. An equation whose displacements
/// supports hold is left out, thus supports come first.
/// @throws InputError  for an unknown axis, or for AUTO where no global axis is normal to the plane of the joints
void tie_joints(DeckModel& deck, const SapConstraint& constraint);

}  // namespace twindeck::model_io
