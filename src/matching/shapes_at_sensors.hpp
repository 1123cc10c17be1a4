#pragma once

#include <Eigen/Core>

#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "matching/measured.hpp"

namespace twindeck::matching {

/// Model shapes at the measured degrees of freedom: at the node whose id is the point's name and otherwise at the nearest node
/// to the channel's position, along the channel's direction cosines (or along x … rz where the dof names that).
/// Where nodes coincide, it is the one that bears the point's name (in points.csv of the model, or as its id).
/// @return [-] (n_measured_dofs × n_modes), rows as in measured.modes.dofs
/// @throws InputError  for a point that can be placed neither by name nor by coordinates, and for one that is over
/// `tolerance_m` from
///                     every node
[[nodiscard]] Eigen::MatrixXcd shapes_at_sensors(const Measured& measured, const dynamics::LoadedModel& model,
                                                 const dynamics::EigenModes& modes, double tolerance_m);

/// @throws InputError  as above, before anything is solved; and for a sensor where nodes coincide that can move apart, if it
///                     bears the name of none of them
void refuse_unplaced_channels(const Measured& measured, const dynamics::ReadModel& model, double tolerance_m);

/// The same as vectors over the model's free degrees of freedom: channel c shows c' phi.
/// @return [-] (n × n_measured_dofs)
/// @throws InputError  as above
[[nodiscard]] Eigen::MatrixXd sensor_vectors(const Measured& measured, const dynamics::LoadedModel& model, double tolerance_m);

}  // namespace twindeck::matching
