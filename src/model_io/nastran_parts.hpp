#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "model_io/deck_model.hpp"
#include "model_io/nastran_cards.hpp"

/// Inside of the library: what a Nastran deck says, in the deck's own units until deck_units.hpp turns the finished model
/// into SI. Cards are indexed first, since each may refer to one further down.
namespace twindeck::model_io::nastran {

/// A coordinate system resolved to the basic one.
struct System {
  char type = 'R';  ///< R rectangular, C cylindrical, S spherical
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: x, y, z in basic axes
  /// Basic coordinates of a point given in this system (angles in degrees, as on the cards).
  [[nodiscard]] Eigen::Vector3d to_basic(const Eigen::Vector3d& x) const;
  /// Rows: the three directions of this system at a point, in basic axes.
  [[nodiscard]] Eigen::Matrix3d axes_at(const Eigen::Vector3d& basic) const;
};

struct Parts : DeckModel {
  explicit Parts(const Deck& d) : deck(d) { last_node = last_element = 100'000'000; }  // the deck's numbers have eight digits

  const Deck& deck;

  std::map<long, const Card*> grids, system_cards, materials;
  std::map<long, std::array<long, 3>> first_kind;          ///< CORD1x: its three grids by the system's number
  std::map<long, std::vector<const Card*>> properties;     ///< by number: one of each kind at most
  std::map<long, double> spring_constants, scalar_masses;  ///< PELAS, PMASS
  std::set<long> scalar_points;                            ///< SPOINT
  const Card* grid_defaults = nullptr;                     ///< GRDSET
  std::map<std::string, const Card*> member_defaults;      ///< BAROR, BEAMOR by the card that they are for
  double wtmass = 1.0;                                     ///< PARAM WTMASS

  std::map<long, Eigen::Vector3d> places;  ///< of the grids asked for so far
  std::map<long, System> systems;          ///< resolved so far
  std::set<long> resolving;                ///< systems on the way to being resolved
  std::set<long> element_ids;
  std::map<std::string, int> material_position;
  std::map<int, Eigen::Matrix<double, 6, 6>> added_mass;  ///< CMASS1, CMASS2 by node, basic axes
  struct Twist {
    const Card* card;
    int a, b;
    double stiffness;
  };
  std::vector<Twist> twists;                                ///< torsion of rods: it needs rotations that something else holds
  std::map<long, std::pair<Directions, const Card*>> held;  ///< supports by grid, in its displacement axes

  // nastran_grids.cpp
  /// @throws InputError for a grid that no GRID card defines
  [[nodiscard]] Eigen::Vector3d grid_place(const DeckPlace& from, long grid);
  [[nodiscard]] const System& system(const DeckPlace& from, long id);
  /// Directions in which the displacements of a grid are counted (CD), rows in basic axes.
  [[nodiscard]] Eigen::Matrix3d displacement_axes(const DeckPlace& from, long grid);
  /// Position of the grid's node in the model, which is made when the first part asks for it.
  [[nodiscard]] int node(const DeckPlace& from, long grid) { return add_node(grid, grid_place(from, grid)); }
  /// Grids from field `start` on, with THRU. @param exact  false: a range may pass over numbers that are no grids (SPC1)
  [[nodiscard]] std::vector<long> grid_list(const Card& card, std::size_t start, bool exact) const;

  // nastran_properties.cpp
  /// The property that an element names. @throws InputError if it is none of `kinds`
  [[nodiscard]] const Card& property(const DeckPlace& element, long id, const std::vector<std::string>& kinds) const;
  /// What CELAS1 and CMASS1 take from the PELAS or PMASS that they name, by default that of their own number.
  [[nodiscard]] std::pair<long, double> constant(const Card& card, const std::map<long, double>& of, const char* kind) const;
  /// Constants of MAT1 `id`, without a name.
  [[nodiscard]] fe::Material elastic(const DeckPlace& from, long id) const;
  /// Position of MAT1 `id` in the model; `added_density` (mass per volume, not structural) makes a material of its own for
  /// `owner`.
  [[nodiscard]] int material(const DeckPlace& from, long id, double added_density = 0.0, const std::string& owner = "");
};

/// Section and material that a member takes from its property, at both ends.
struct MemberProperty {
  int material = -1, section = -1, section2 = -1;
};

}  // namespace twindeck::model_io::nastran
