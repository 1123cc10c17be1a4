#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/reduction/structure.hpp"

/// Places between the candidate locations of a structure: nodes on the ways from one to the next, halves of a zone or a group.
/// Takes the structure and where candidates are; gives places in full coordinates.
namespace twindeck::diagnosis {

/// Nodes that move, joined where the stiffness couples them: along the elements, or the couplings of a matrix model. A way is
/// as long as its edges [m], an edge counts 1 where coordinates are unknown.
class NodeGraph {
 public:
  explicit NodeGraph(const Structure& structure);

  /// Nodes to look at next round a location. On the shortest way to each location beside it: the node nearest to the middle.
  /// And the node farthest from all locations, where it is farther than those middles: an open end, the inside of a field.
  /// @param centre   name of a node, one of `located`
  /// @param located  names of the nodes that are candidate locations; unknown names are passed over
  /// @return         names, the shortest way first; empty where every neighbour of the centre is a location
  [[nodiscard]] std::vector<std::string> between(const std::string& centre, const std::vector<std::string>& located) const;

 private:
  struct Reached {
    double length;
    int owner, before;  ///< the nearest location; the node before on the way from it
  };
  [[nodiscard]] int position(const std::string& name) const;
  [[nodiscard]] std::vector<Reached> reached_from(const std::vector<int>& located) const;
  [[nodiscard]] int middle_of_way(const std::vector<Reached>& reached, int from, int to) const;

  std::vector<std::string> names_;
  std::map<std::string, int> positions_;
  std::vector<std::vector<std::pair<int, double>>> edges_;  ///< (n_nodes) neighbours with lengths
};

/// A node as a candidate location, by name.
[[nodiscard]] Place node_place(const Structure& structure, const std::string& name);

/// Two halves of a place that is made of elements (a zone, a group of elements, a parameter that scales a modulus), cut across
/// its longest direction. A half is called after the element nearest to its middle whose name no place has yet ("element:17").
/// @return  none for a place of one element, and for one that is not made of elements
[[nodiscard]] std::vector<Place> halves_of(const Structure& structure, const Places& places, const Place& whole);

}  // namespace twindeck::diagnosis
