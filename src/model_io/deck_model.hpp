#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "model_io/deck_card.hpp"
#include "model_io/inp.hpp"

/// Inside of the library: the neutral deck, from which a model is built once. A dialect parses its cards and says here what
/// they mean: nodes, sections, elements, ties, springs, supports. Numbers are those of the deck, in its units.
namespace twindeck::model_io {

using Directions = std::array<bool, 6>;  ///< x y z rx ry rz

/// sum factor · displacement = 0; nodes by their positions in the model.
struct DeckEquation {
  DeckPlace at;
  std::vector<fe::Constraint::Term> terms;
};

/// Expansion of a material.
struct Expansion {
  double per_K = 0.0;
  double reference_K = 0.0;  ///< temperature without strain
};

struct DeckModel {
  fe::Model model;
  std::vector<std::string> notes;            ///< for people: what was read over or interpreted
  std::map<long, int> node_position;         ///< by the number that the deck or we gave
  std::set<int> turning;                     ///< nodes whose rotations a beam or a shell holds
  std::map<long, std::size_t> pieces;        ///< elements of the deck that several of the model follow one another for
  std::vector<DeckPlace> constraint_origin;  ///< of the model's constraints
  std::set<long> made_nodes;                 ///< nodes that the deck does not have
  std::map<int, Expansion> expansion;        ///< of materials, by position
  long last_node = 0,
       last_element = 0;  ///< new nodes and elements get numbers above these and the deck's own

  [[nodiscard]] const Eigen::Vector3d& place(int node) const { return model.nodes[fe::slot(node)].x_m; }
  /// Whether two nodes lie at one place, but for `tolerance` [-] of their distance from the origin.
  [[nodiscard]] bool together(int a, int b, double tolerance = 1e-6) const;
  void note_once(const std::string& note);
  int add_node(long id, const Eigen::Vector3d& x);
  /// Position of a section of these numbers and this name; its name gets a number where another section has it.
  int add_section(const fe::Section& section);

  /// Adds an element other than a beam. Solids stay as they are. A shell with nodes in the middles of its edges becomes linear
  /// ones of half the size through the same nodes, which follow one another, the first with its number: of eight nodes four
  /// quadrilaterals about a node where its shape functions put the centre, of six nodes four triangles (docs/my_model.md).
  void add_element(const fe::Element& whole);
  /// Adds a beam of the nodes first, (middle,) last: two where it has a middle one. `turn` gives a piece its orientation and
  /// offsets, from the vector between its nodes.
  void add_beam(const fe::Element& whole, const std::function<void(fe::Element& piece, const Eigen::Vector3d& axis)>& turn);
  /// Local z of a member from a vector in its x-y plane. @throws InputError at `at` where that lies along the axis
  [[nodiscard]] static Eigen::Vector3d local_z(const DeckPlace& at, const std::string& member, const Eigen::Vector3d& axis,
                                               const Eigen::Vector3d& in_plane, const std::string& mend);
  /// Moves a beam, whose orientation is its local z, off its nodes to a point of the section's y and z.
  static void put_beside(fe::Element& piece, const Eigen::Vector3d& axis, const Eigen::Vector2d& point);
  /// @throws InputError for a ratio out of ]-1, 0.5[
  static void check_poisson_ratio(const DeckPlace& at, double ratio);

  /// A rigid link, "link_7" without a name.
  void add_link(int master, int slave, const std::string& name = "");
  void add_constraint(const fe::Constraint& c, const DeckPlace& at);
  /// "coupling_7": the next constraint of that kind.
  [[nodiscard]] std::string numbered(const std::string& kind) const;
  /// Whether these are all directions in which the node has stiffness of its own: a node of solids and bars alone has no
  /// rotation.
  [[nodiscard]] bool is_whole(const Directions& tied, int slave) const;
  /// The slave follows the master at the end of a rigid arm in some directions, a constraint each. @param name by direction
  void tie_at_arm(const DeckPlace& at, const std::function<std::string(int)>& name, int master, int slave,
                  const Directions& tied);
  /// The terms with those that a skew support makes follow others expressed by these, each displacement once.
  [[nodiscard]] std::vector<fe::Constraint::Term> free_terms(const std::vector<fe::Constraint::Term>& terms) const;
  /// The first term follows the others. @throws InputError for one that has the factor 0, or follows nothing
  void follow_first(const std::string& name, const DeckEquation& equation);
  /// Whether the equations say what `slave` does as part of `master`, each one direction, all of them together.
  [[nodiscard]] bool is_rigid_link(const std::vector<const DeckEquation*>& equations, int master, int slave) const;
  /// A displacement or rotation of a node that a mean counts.
  struct Sample {
    int node = -1;
    Eigen::RowVector3d direction;  ///< unit, global axes
    bool rotation = false;
    double weight = 1.0;  ///< above 0
  };
  /// The reference node moves as the weighted mean of the samples, as Nastran's RBE3 and Abaqus' distributing coupling have it,
  /// in the directions that are asked for: q with min sum w (u - S q)². A rotation counts with the square of the mean distance
  /// of the samples, so that all terms are lengths. @param mend where the samples do not determine one
  void tie_to_mean(const DeckPlace& at, const std::function<std::string(int)>& name, int reference,
                   const std::vector<Sample>& samples, const Directions& wanted, const std::string& mend);

  /// Holds a node; what holds it already stays.
  void hold(const std::string& name, int node, const Directions& fixed);
  /// Holds a node along its own axes (rows), three displacements and three rotations: a component that is skew to the global
  /// axes becomes equations of the node's displacements.
  void hold_along(const DeckPlace& at, const std::string& name, int node, const Eigen::Matrix3d& axes, const Directions& own);
  /// A spring given by the node's own directions 0-5 in `axes` (rows).
  void add_spring(const std::string& name, const std::string& group, int node, int node2, int direction,
                  const Eigen::Matrix3d& axes, double stiffness, double damping = 0.0);
  /// Leaves out nodes that nothing joins; without one a model that holds is refused later.
  void drop_unused_nodes();
  /// The model, with the keys of the TOML file of the same stem beside the deck. @throws InputError where it has no element
  [[nodiscard]] ImportedModel finished(std::vector<std::filesystem::path> files, const std::string& expected);

 private:
  long next_node();
  std::map<int, std::size_t> support_position_;
};

/// Calls f on every number by which an element, spring, link, constraint or mass names a node; -1 is no node and left out.
/// Supports are not among them: a support alone joins a node to nothing.
void for_each_joined_node(fe::Model& model, const std::function<void(int&)>& f);

/// Gives the nodes another order, or leaves some out.
/// @param now  new position of each node (n_nodes); -1: left out, with its supports. No element, spring, link, constraint or
///             mass may name a node that is left out.
void renumber_nodes(fe::Model& model, const std::vector<int>& now);

/// Puts point masses of one mass into one group, mass_of_ with that number: cards of decks name no group, and a group for each
/// card would be a place of its own for a diagnosis. A mass that no other equals keeps its group.
/// @param masses  in the deck's own units
void group_equal_masses(std::vector<fe::PointMass>& masses);

/// Of a node that follows another as the end of a rigid arm r, u_s = u_m + theta_m × r, theta_s = theta_m: factor of the
/// master's degree of freedom `from` (0-5) in the slave's `to`.
inline double rigid_arm_factor(const Eigen::Vector3d& r, int to, int from) {
  if (to == from) return 1.0;
  if (to > 2 || from < 3) return 0.0;
  return Eigen::Vector3d::Unit(from - 3).cross(r)[to];
}

/// One displacement of `slave` that follows `master` so; nodes by their positions in the model.
inline fe::Constraint at_rigid_arm(const std::string& name, const fe::Model& model, int master, int slave, int direction) {
  constexpr double nothing = 1e-12;  ///< [-] of the arm: rounding of coordinates
  const Eigen::Vector3d r =
      model.nodes[static_cast<std::size_t>(slave)].x_m - model.nodes[static_cast<std::size_t>(master)].x_m;
  fe::Constraint c{name, slave, direction, {{master, direction, 1.0}}};
  for (int about = 3; about < 6 && direction < 3; ++about) {
    const double factor = rigid_arm_factor(r, direction, about);
    if (std::abs(factor) > nothing * r.norm()) c.terms.push_back({master, about, factor});
  }
  return c;
}

}  // namespace twindeck::model_io
