#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model_io/deck_model.hpp"

/// Inside of the library: the static stage about which a deck asks for its modes. Each dialect reads its own load cards and
/// says here what they do; loads of nodes, gravity and free strains of the model come out of it. Units are those of the deck.
/// Beam loads become the forces and moments of a clamped member; what no function here takes is refused by the card's name.
namespace twindeck::model_io {

/// A load per length of a member, linear from q1 to q2 between two places of its length.
struct LineLoad {
  Eigen::Vector3d q1, q2;       ///< global axes
  double from = 0.0, to = 1.0;  ///< [-] of the length from the first end
};

class DeckStage {
 public:
  /// Loads of the case "static" act, gravity is none until accelerate, stresses of shells and solids count.
  /// @param deck its nodes and elements in their final order
  /// @param large the deck asks for equilibrium in the deformed geometry (NLGEOM)
  /// @param remedy of a load that is refused
  DeckStage(DeckModel& deck, bool large, std::string remedy);

  /// Position of a node. @throws InputError for one that no element joins
  [[nodiscard]] int node(const DeckPlace& at, long id) const;
  /// What became of an element of the deck; nothing for one without stiffness.
  [[nodiscard]] std::vector<fe::Element*> pieces(long id);
  /// The first piece. @throws InputError for an element that is not in the model
  [[nodiscard]] fe::Element& element(const DeckPlace& at, long id);

  /// Adds a force (direction 0-2) or a moment (3-5).
  void load(int node, int direction, double value);
  void load(int node, const Eigen::Vector3d& force, const Eigen::Vector3d& moment = Eigen::Vector3d::Zero());
  /// Sets the movement of a support, in place of an earlier one. @throws InputError for a rotation, or a movement along an axis
  /// that is skew to the global ones, that is not 0
  /// @param axes  the node's own (rows)
  void move(const DeckPlace& at, int node, int direction, double value,
            const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());
  /// Adds an acceleration of everything that has mass: the vector along which things fall.
  void accelerate(const Eigen::Vector3d& acceleration);
  /// The same of one element alone, as forces of its nodes.
  void accelerate(long id, const Eigen::Vector3d& acceleration);
  /// Loads a beam or bar along its length. @throws InputError for other elements, and for a rotation released at one end
  void load_line(const DeckPlace& at, long id, const std::function<LineLoad(const fe::Element& piece)>& load);
  /// Presses a shell along the normal of its nodes' anticlockwise turn.
  void press_shell(const DeckPlace& at, long id, double pressure);
  /// Presses a face of a solid, by its position in solid_faces, inwards.
  void press_solid(const DeckPlace& at, long id, std::size_t face, double pressure);
  /// Pressure p on the facet of three or four nodes: force -p n dA, n as the nodes run anticlockwise about it.
  void press(const std::vector<int>& nodes, double pressure);
  /// The same with the force along `direction` (a unit vector) instead of -n.
  void draw(const std::vector<int>& nodes, const Eigen::Vector3d& direction, double traction);
  /// Initial strain, or stress, along a beam or bar. @throws InputError for other elements
  void strain(const DeckPlace& at, long id, double value, bool is_stress);
  /// Warms the elements whose material expands, by the mean over their nodes.
  void warm(const std::function<double(const fe::Element& element, long node, const Expansion& of)>& rise_K);
  [[noreturn]] void refuse(const DeckPlace& at, long id, const std::string& what) const;
  /// Falls back to small displacements where large ones are not computed, and notes what acts. @param of "the static step"
  void close(const std::string& of, bool strained = false);

 private:
  DeckModel& deck_;
  fe::Model& model_;
  bool large_;
  std::string remedy_;
  std::map<long, std::size_t> position_;  ///< of an element of the deck in the model; its further pieces follow
};

/// Shape functions and their slopes on a facet of n = 4 or 8 nodes at (r, s) in [-1, 1]², of 3 or 6 at the areas r and s of its
/// second and third corner. Corners first, then the nodes in the middles of 1-2, 2-3, …; what is beyond n has no meaning.
void facet_functions(std::size_t n, double r, double s, std::array<double, 8>& share, std::array<Eigen::Vector2d, 8>& slope);

/// Unit vectors of a member's local axes, rows x, y, z.
[[nodiscard]] Eigen::Matrix3d member_axes(const fe::Model& model, const fe::Element& member);

/// Faces of a solid by the positions of its nodes, each anticlockwise as seen from outside: six of a hexahedron in the order
/// bottom (nodes 1-4), top (5-8), then the sides above the edges 1-2, 2-3, 3-4, 4-1; four of a tetrahedron in the order 1-2-3,
/// then the sides of the edges 1-2, 2-3, 3-1. Of a solid of ten or twenty nodes those in the middles of edges follow.
[[nodiscard]] const std::vector<std::vector<std::size_t>>& solid_faces(std::size_t nodes);

}  // namespace twindeck::model_io
