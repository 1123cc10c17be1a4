#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "aero/strip.hpp"
#include "fe/model.hpp"
#include "linalg/sparse.hpp"

namespace twindeck::aero {

/// Points of a model's decks at which wind acts.
struct AeroNode {
  std::string deck;
  double station_m = 0.0;  ///< along the deck's axis from the middle between its end nodes
  double length_m = 0.0;   ///< influence length
  Eigen::Vector3d x_m = Eigen::Vector3d::Zero(), tangent = Eigen::Vector3d::UnitX();
};

struct AeroNodes {
  std::vector<AeroNode> nodes;
  /// Motions (x y z rx ry rz of node 0, …) from displacements of all nodes of the model, (6 n_aero × 6 n_nodes); its transpose
  /// takes wind forces to nodal ones.
  linalg::SparseMatrix motion;
};

/// Aerodynamic nodes of a finite element model, `per_deck` between the end stays of each deck.
///
/// If points.csv of the model names as many nodes as asked for (aero_<deck>_01 …), these nodes and their rotations are used in
/// the order of their numbers. The influence length of each reaches half way to its neighbours; that of an outermost node
/// reaches as far outwards. Otherwise the nodes are evenly spaced, by interpolation between the deck's cross sections. A cross
/// section is a line of elements of the group `cross_group` across the deck. A section moves with the mean of its two edges.
/// Its two horizontal rotations follow from the difference of its edges and from the slope to the next section. They are exact
/// for a rigid motion, on a curved deck too. Rotation about the vertical does not meet any wind force and is left zero. A deck
/// without stays is taken from end to end.
/// @throws InputError  for a deck that the model does not have, and for two points of one number
[[nodiscard]] AeroNodes find_aero_nodes(const fe::Model& model, const std::vector<std::string>& decks,
                                        const std::vector<std::string>& cross_groups, int per_deck);

/// Strips of the nodes in a wind. @param alpha_rad  mean angle of attack of each node
[[nodiscard]] std::vector<Strip> strips_of(const AeroNodes& nodes, const std::vector<std::string>& decks, const Wind& wind);

/// Motions of each node by columns of displacements of all nodes. @param displacement (6 n_nodes × m)
[[nodiscard]] std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>> motions_of(
    const AeroNodes& nodes, const Eigen::Ref<const Eigen::MatrixXd>& displacement);

}  // namespace twindeck::aero
