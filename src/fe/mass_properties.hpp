#pragma once

#include <Eigen/Core>
#include <string>

#include "fe/model.hpp"

namespace twindeck::fe {

/// Mass, centre of mass and inertia of a whole model as a rigid body: elements, point masses, elements given by matrices;
/// whether supported or not. They are what other programs print of a model, so they show what an import has lost.
struct MassProperties {
  Eigen::Vector3d mass_kg = Eigen::Vector3d::Zero();        ///< that moves along x, y, z; they differ only where masses act in
                                                            ///< some directions alone
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();       ///< of the mean of the three; the origin without mass
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about the centre; off the diagonal -∫ x y dm
};

/// M = Rᵀ M_e R summed over all parts, R the six rigid motions of a part's nodes: what a consistent mass matrix has exactly.
/// @pre  a valid model (validate.hpp)
[[nodiscard]] MassProperties mass_properties(const Model& model);

/// Mass, centre of mass and inertia of an imported model in one line, to be held against what the other program prints:
/// "mass 275.07 kg, centre of mass at (1, 0, 2.5) m; inertia about it, axes x y z: xx 12, yy …, xy … kg m2". Off the diagonal
/// stands -∫ x y dm. Where masses act in some directions alone, the mass is given for each.
[[nodiscard]] std::string mass_words(const MassProperties& properties);

}  // namespace twindeck::fe
