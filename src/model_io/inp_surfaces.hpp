#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "model_io/inp_parts.hpp"

/// Inside of the library: surfaces of an .inp file, the point on a facet of one that is nearest to a node, and how it moves.
namespace twindeck::model_io {

/// *SURFACE of TYPE=ELEMENT (faces S1-S6 of hexahedra, sides SPOS and SNEG of shells, edges E1-E4 of shells) or TYPE=NODE.
void read_inp_surface(InpParts& parts, const InpCard& card);

/// A point on (or just beside) a facet.
struct Foot {
  std::vector<double> share;                       ///< of the facet's nodes: its shape functions there, sum 1
  Eigen::Matrix<double, Eigen::Dynamic, 2> slope;  ///< derivatives of the shape functions (n × 2; n × 1 used of an edge)
  double distance_m = 0.0;                         ///< of the node to the nearest point within the facet
};

/// A facet with its nodes' positions in the model: bilinear with 4 nodes, flat with 3, straight with 2.
struct Facet {
  std::vector<int> nodes = {};
  std::vector<Eigen::Vector3d> x_m = {};
  bool turning = false;
  Eigen::Vector3d middle_m;
  double radius_m = 0.0;  ///< about the middle, holds all nodes

  /// Square root of the area; the length of an edge.
  [[nodiscard]] double size_m() const;
  [[nodiscard]] Eigen::Vector3d point(const Foot& foot) const;
  /// The foot of a node at x: the nearest point of the facet, continued a little beyond its edges.
  [[nodiscard]] Foot foot_of(const Eigen::Vector3d& x) const;
  /// Movement of a point that stands off by `gap` from the foot and follows the facet as a rigid arm: one 3 × 3 matrix a node,
  /// u = sum A_i u_i. The normal turns with the tangents: dn = -sum_a (n · du/dxi_a) a^a, a^a the dual tangents.
  [[nodiscard]] std::vector<Eigen::Matrix3d> motion(const Foot& foot, const Eigen::Vector3d& gap) const;
};

/// @throws InputError  for a facet without area
[[nodiscard]] Facet make_facet(const InpParts& parts, const DeckPlace& at, const InpFacet& facet);

/// The facet nearest to x within `tolerance`, with its foot.
[[nodiscard]] std::optional<std::pair<const Facet*, Foot>> nearest_facet(const std::vector<Facet>& facets,
                                                                         const Eigen::Vector3d& x, double tolerance);

}  // namespace twindeck::model_io
