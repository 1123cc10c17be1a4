#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "fe/dof_map.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"
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

/// Where the modes of a model are known, and which of several nodes at one position a sensor may stand on. A finite element
/// model has six values a node, a matrix model single degrees of freedom.
struct ModelPoints {
  std::vector<std::string> node;                  ///< name of each node
  std::vector<Eigen::Vector3d> x_m;               ///< NaN where unknown
  std::vector<std::array<Eigen::Index, 6>> row;   ///< rows of the expanded shapes; -1 where the node lacks the direction
  std::map<std::string, int> named;               ///< points.csv of the model: position in `node`
  const fe::Model* model = nullptr;               ///< null for a matrix model
  mutable std::shared_ptr<const fe::DofMap> map;  ///< of the model: made when nodes that coincide are first looked at
};

/// @param model  null for a matrix model, whose points are those of its `dofs`
[[nodiscard]] ModelPoints points_of(const fe::Model* model, const std::vector<fe::DofLabel>& dofs);

/// Nodes at the position of one node, itself among them, in the order of the model.
[[nodiscard]] std::vector<std::size_t> nodes_at_the_place_of(const ModelPoints& points, std::size_t node);

/// Nodes among several at one position that a sensor may stand on. The node that bears the sensor's name (in points.csv of the
/// model, or as its id) comes first. Otherwise all nodes that can move are possible; in a matrix model, those with a degree of
/// freedom along the sensor. Never empty.
/// @param cosine  of the sensor along x … rz; zeros where unknown
[[nodiscard]] std::vector<std::size_t> possible_nodes(const ModelPoints& points, const std::vector<std::size_t>& there,
                                                      const std::string& name, const std::array<double, 6>& cosine);

/// Whether links, supports or constraints make nodes move alike along a sensor in any motion of the structure.
/// @param cosine  as above
[[nodiscard]] bool move_as_one(const ModelPoints& points, const std::vector<std::size_t>& nodes,
                               const std::array<double, 6>& cosine);

}  // namespace twindeck::matching
