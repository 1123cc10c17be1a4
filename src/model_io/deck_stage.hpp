#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fe/model.hpp"

/// Inside of the library: the static stage about which a deck asks for its modes. Each dialect reads its own load cards and
/// calls these functions, which turn them into loads of nodes, gravity and free strains of the model. Units are those of the
/// deck. Beam loads become the forces and moments of a clamped member; what no function here takes, a dialect refuses by name.
namespace twindeck::model_io {

/// Opens the stage: loads of the case "static" act, gravity is none until add_gravity, stresses of shells and solids count.
/// @param large  the deck asks for equilibrium in the deformed geometry (NLGEOM)
void open_stage(fe::Model& model, bool large);

/// Falls back to small displacements where large ones are not computed: with constraints, movements of supports, or free
/// strains of other elements than bars. Call it when the stage is complete. @return a note of it, or ""
[[nodiscard]] std::string settle_displacements(fe::Model& model);

/// Adds a force (direction 0-2) or a moment (3-5).
void add_load(fe::Model& model, int node, int direction, double value);
/// Adds a force and a moment, global axes.
void add_load(fe::Model& model, int node, const Eigen::Vector3d& force, const Eigen::Vector3d& moment);
/// Sets the movement of a support (direction 0-2), in place of an earlier one.
void set_movement(fe::Model& model, int node, int direction, double value);
/// Adds an acceleration of everything that has mass: the vector along which things fall.
void add_gravity(fe::Model& model, const Eigen::Vector3d& acceleration);

/// A load per length of a member, linear from q1 to q2 between two places of its length.
struct LineLoad {
  Eigen::Vector3d q1, q2;       ///< global axes
  double from = 0.0, to = 1.0;  ///< [-] of the length from the first end
};
/// @return  what stands against it, or "": a member with a released rotation at one of its ends
[[nodiscard]] std::string add_line_load(fe::Model& model, const fe::Element& member, const LineLoad& load);

/// Pressure p on the facet of three or four nodes: force -p n dA, n as the nodes run anticlockwise about it.
void add_pressure(fe::Model& model, const std::vector<int>& nodes, double pressure);
/// The same with the force along `direction` (a unit vector) instead of -n.
void add_traction(fe::Model& model, const std::vector<int>& nodes, const Eigen::Vector3d& direction, double traction);

/// Unit vectors of a member's local axes, rows x, y, z.
[[nodiscard]] Eigen::Matrix3d member_axes(const fe::Model& model, const fe::Element& member);

/// Faces of a solid by the positions of its nodes, each anticlockwise as seen from outside: six of a hexahedron in the order
/// bottom (nodes 1-4), top (5-8), then the sides above the edges 1-2, 2-3, 3-4, 4-1; four of a tetrahedron in the order 1-2-3,
/// then the sides of the edges 1-2, 2-3, 3-1.
[[nodiscard]] const std::vector<std::vector<std::size_t>>& solid_faces(std::size_t nodes);

/// Warms an element by ΔT: adds α ΔT to its free strain.
void warm(fe::Element& element, double expansion_per_K, double warming_K);

}  // namespace twindeck::model_io
