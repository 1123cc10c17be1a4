#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <vector>

#include "fe/model.hpp"

/// Inside of the library: elements of a deck with nodes in the middles of their edges, as linear elements of half the size
/// through the same nodes. A shell of eight nodes becomes four quadrilaterals about a node in its centre, one of six nodes four
/// triangles, a hexahedron of twenty nodes eight hexahedra about nodes in the centres of its faces and its own. The new nodes
/// lie where the quadratic shape functions put them. Our shells and solids bend without locking; torsion and higher modes of
/// coarse solids come out up to 2.4 % above those of the quadratic element (docs/import_decks.md).
namespace twindeck::model_io {

/// Nodes that a deck does not have, in the centres of faces that elements share, by the face's corners in ascending order.
using FaceCentres = std::map<std::vector<int>, int>;

struct Splitting {
  std::function<int(const Eigen::Vector3d&)> new_node;  ///< adds a node, returns its position
  std::function<long()> new_element;                    ///< number of a further element
  FaceCentres& centres;
};

/// Adds the element to the model: as it is, or in pieces that follow one another, the first with the element's own number.
/// Nodes in the order of Abaqus and ANSYS: corners as in fe::Element; middles of 1-2, 2-3, 3-4, 4-1 (of 1-2, 2-3, 3-1); of a
/// hexahedron those of the bottom, those of the top, then those of the edges 1-5, 2-6, 3-7, 4-8.
/// @return how many elements it became
std::size_t add_in_pieces(fe::Model& model, const fe::Element& whole, const Splitting& splitting);

}  // namespace twindeck::model_io
