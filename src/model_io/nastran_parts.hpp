#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "model_io/nastran_cards.hpp"

/// Inside of the library: what a Nastran deck says, in the deck's own units until nastran_units.hpp turns the finished model
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

struct Parts {
  explicit Parts(const Deck& d) : deck(d) {}

  const Deck& deck;
  fe::Model model;
  std::vector<std::string> notes;

  std::map<long, const Card*> grids, system_cards, materials;
  std::map<long, std::array<long, 3>> first_kind;          ///< CORD1x: its three grids by the system's number
  std::map<long, std::vector<const Card*>> properties;     ///< by number: one of each kind at most
  std::map<long, double> spring_constants, scalar_masses;  ///< PELAS, PMASS
  std::set<long> scalar_points;                            ///< SPOINT
  const Card* grid_defaults = nullptr;                     ///< GRDSET

  std::map<long, Eigen::Vector3d> places;  ///< of the grids asked for so far
  std::map<long, System> systems;          ///< resolved so far
  std::set<long> resolving;                ///< systems on the way to being resolved
  std::map<long, int> node_position;       ///< grids that something joins, in the order met
  std::set<long> element_ids;
  std::set<int> turning;  ///< nodes whose rotations a beam or a shell holds
  std::map<std::string, int> section_position, material_position;
  std::map<int, Eigen::Matrix<double, 6, 6>> added_mass;  ///< CMASS1, CMASS2 by node, basic axes
  struct Twist {
    const Card* card;
    int a, b;
    double stiffness;
  };
  std::vector<Twist> twists;                 ///< torsion of rods: it needs rotations that something else holds
  std::map<long, std::array<bool, 6>> held;  ///< supports by grid, basic axes

  // nastran_grids.cpp
  /// @throws InputError for a grid that no GRID card defines
  [[nodiscard]] Eigen::Vector3d place(const Card& from, long grid);
  [[nodiscard]] const System& system(const Card& from, long id);
  /// Directions in which the displacements of a grid are counted (CD), rows in basic axes.
  [[nodiscard]] Eigen::Matrix3d displacement_axes(const Card& from, long grid);
  /// Position of the grid's node in the model, which is made when the first part asks for it.
  [[nodiscard]] int node(const Card& from, long grid);
  /// Grids from field `start` on, with THRU. @param exact  false: a range may pass over numbers that are no grids (SPC1)
  [[nodiscard]] std::vector<long> grid_list(const Card& card, std::size_t start, bool exact) const;

  // nastran_properties.cpp
  /// The property that an element names. @throws InputError if it is none of `kinds`
  [[nodiscard]] const Card& property(const Card& element, long id, const std::vector<std::string>& kinds) const;
  /// Position of MAT1 `id` in the model; `added_density` (mass per volume, not structural) makes a material of its own for
  /// `owner`.
  [[nodiscard]] int material(const Card& from, long id, double added_density = 0.0, const std::string& owner = "");
  /// Position of a section, added under its name where that is new.
  int section(const fe::Section& s);
};

/// "pbar_7": group and section of a property.
[[nodiscard]] std::string property_name(const Card& property);
/// A note that is made once, however many cards cause it.
void note_once(Parts& parts, const std::string& note);
/// Components "1" to "6" of a field as flags. @throws InputError for anything else, scalar points (0 or blank) included
[[nodiscard]] std::array<bool, 6> components(const Parts& parts, const Card& card, std::size_t i);

/// Section and material that a member takes from its property, at both ends.
struct MemberProperty {
  int material = -1, section = -1, section2 = -1;
};
// nastran_beams.cpp
[[nodiscard]] MemberProperty bar_property(Parts& parts, const Card& element, long id);   ///< PBAR, PBARL
[[nodiscard]] MemberProperty beam_property(Parts& parts, const Card& element, long id);  ///< PBEAM, PBEAML

// Readers of cards, in the order in which they run.
void index_card(Parts& parts, const Card& card);          // nastran_grids.cpp: what others refer to
void read_member(Parts& parts, const Card& card);         // nastran_elements.cpp: CBAR, CBEAM
void read_rod(Parts& parts, const Card& card);            // CROD, CONROD
void read_shell(Parts& parts, const Card& card);          // CQUAD4
void read_solid(Parts& parts, const Card& card);          // CHEXA
void read_scalar_spring(Parts& parts, const Card& card);  // nastran_springs.cpp: CELAS1, CELAS2
void read_bush(Parts& parts, const Card& card);           // CBUSH
void read_mass(Parts& parts, const Card& card);           // nastran_masses.cpp: CONM1, CONM2
void read_scalar_mass(Parts& parts, const Card& card);    // CMASS1, CMASS2
void read_rigid(Parts& parts, const Card& card);          // nastran_supports.cpp: RBE2, RBAR
void read_supports(Parts& parts);                         // SPC, SPC1, SPCADD of the chosen set, and what GRID holds
void refuse_multipoint(Parts& parts);                     // MPC
void finish_masses(Parts& parts);                         // nastran_masses.cpp: CMASS of a node together
void finish_rods(Parts& parts);                           // nastran_elements.cpp: torsion of rods

/// A spring or mass given by a matrix on the six displacements of each node; displacements that it does not touch are left out.
void add_matrix(Parts& parts, const std::string& name, const std::vector<int>& nodes, const Eigen::MatrixXd& stiffness,
                const Eigen::MatrixXd& mass);

}  // namespace twindeck::model_io::nastran
