#pragma once

#include <vector>

#include "diagnosis/reduction/element_laws.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "fe/assembly_elements.hpp"

/// Private to src/diagnosis: the candidate locations of a finite element model.
namespace twindeck::diagnosis {

class ElementPlaces {
 public:
  explicit ElementPlaces(const Structure& structure);

  /// Middle of each element other than stays, in the order of `candidates`.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& centroids() const { return centroids_; }
  [[nodiscard]] std::vector<Eigen::Vector3d> node_positions() const;  ///< of nodes of elements that can move
  [[nodiscard]] std::vector<int> measured_nodes() const;              ///< positions in `node_positions`

  /// Set elements: the elements of one group that are nearest to one centre form a location, named after the element in their
  /// middle.
  /// @param points  positions of the centres; empty: the middles of the elements `centres`
  void add_zones(const std::vector<int>& centres, Places& places, std::vector<Eigen::Vector3d> points = {}) const;
  void add_stays(Places& places) const;     ///< set stays
  void add_dampers(Places& places) const;   ///< sets dampers, damper_types
  void add_supports(Places& places) const;  ///< sets supports, foundations
  /// Set groups: every group of elements and of springs between nodes, unless a parameter has the same location. Groups that
  /// belong together by name follow ("groups:a,b").
  void add_groups(Places& places) const;
  /// Set support_moves: other positions of a support on a line of beams.
  void add_support_moves(Places& places) const;
  /// Dampers moved to other nodes: unit forces there, and the nodes as attributes node_0 …
  void add_moves(const std::vector<DamperMove>& moves, Places& places) const;
  void add_nodes(const std::vector<int>& chosen, Places& places) const;  ///< set nodes
  /// Some elements as one location, with their middle; the id is left empty.
  [[nodiscard]] Place part(const std::vector<int>& elements) const;
  /// Dependence of the stiffness of some elements on the parameters.
  [[nodiscard]] ParameterLaw<CompactMatrix> stiffness_law(const std::vector<int>& elements) const {
    return laws_.stiffness(elements);
  }
  void fill_global(Place& global) const;  ///< stiffness of all but stays; mass of the deck (shells, else all elements)

 private:
  using Sum = ElementSum;
  struct Group;
  [[nodiscard]] std::vector<std::pair<std::string, Group>> groups() const;  ///< in the order of the model
  [[nodiscard]] Symmetric free(const Sum& sum) const { return sum.free(expansion_); }
  /// Unit forces over the free degrees of freedom, of their parts at the nodes. @param count  number of directions
  [[nodiscard]] Eigen::SparseMatrix<double> free_directions(const std::vector<Eigen::Triplet<double>>& entries,
                                                            Eigen::Index count) const {
    Eigen::SparseMatrix<double> directions(expansion_.rows(), count);
    directions.setFromTriplets(entries.begin(), entries.end());
    return expansion_.transpose() * directions;
  }
  [[nodiscard]] fe::ElementMatrix stay_stiffness(std::size_t element, double pull) const;
  [[nodiscard]] double pull_of(std::size_t element) const;
  [[nodiscard]] Place damper_place(const fe::Spring& damper) const;
  [[nodiscard]] bool stands_for_rigid(const fe::Spring& spring) const;

  const Structure& structure_;
  const fe::Model& model_;
  std::vector<std::uint8_t> straight_sides_;  ///< of triangles, by element (fe/assembly_elements.hpp)
  Eigen::SparseMatrix<double> expansion_;
  std::vector<int> candidates_;  ///< elements that are no stays
  std::vector<Eigen::Vector3d> centroids_;
  std::vector<int> nodes_;
  ElementLaws laws_;
};

}  // namespace twindeck::diagnosis
