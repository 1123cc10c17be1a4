#pragma once

#include <Eigen/Sparse>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "diagnosis/features/load_tests.hpp"
#include "diagnosis/reduction/compact_matrix.hpp"
#include "diagnosis/reduction/parameter_law.hpp"
#include "fe/assembly.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

/// The structure to be diagnosed, in full coordinates, and the candidate locations of causes.
namespace twindeck::diagnosis {

/// Displacements at the channels: (n × m) vectors over the free dofs in, (4 n_channels × m) out; the four rows of a channel are
/// its own direction, then global x, y, z at its node (zero if the model lacks the direction).
using SensorValues = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& vectors)>;

/// Part of the name of springs that replace a rigid support, before their direction.
inline constexpr const char* kRigidSpring = "_rigid_";

/// Attribute of a support whose springs stand at several nodes. Each of these bearings is also a location of its own.
inline constexpr const char* kSeveralBearings = "several_bearings";
inline constexpr const char* kOneBearing = "one_bearing";  ///< attribute of such a location
/// Name of the bearing at a spring's node: "pelas_52 at node 109".
[[nodiscard]] inline std::string one_bearing(const fe::Model& model, const fe::Spring& spring) {
  return spring.support_name() + " at node " + std::to_string(model.nodes[static_cast<std::size_t>(spring.node)].id);
}

/// A finite element or matrix model for the diagnosis. Pointers are borrowed.
struct Structure {
  const fe::ParametricSystem* system = nullptr;
  const fe::Model* model = nullptr;           ///< null for a matrix model
  const fe::PrestressState* state = nullptr;  ///< null for a matrix model
  Eigen::VectorXd theta;                      ///< (n_parameters) values of the unchanged model
  SensorValues sensors;
  std::vector<std::string> sensor_nodes;    ///< (n_channels) name of each channel's node, "" where unknown
  std::vector<std::string> rigid_supports;  ///< groups of springs that replace a rigid support
  LoadTests load_tests;                     ///< over the free dofs (load_tests_of); empty where none was made
  std::string source;
};

/// A candidate location of a cause, with its matrices and directions over the free dofs.
struct Place {
  std::string id;                               ///< "element:17", "node:4", "stay:NE5", "damper:C1", "group:E_s" …
  Eigen::Vector3d x_m;                          ///< NaN where unknown
  CompactMatrix stiffness = {}, mass = {};      ///< matrices that a factor scales; size 0 for none
  Eigen::SparseMatrix<double> directions = {};  ///< (n × k) unit forces: x y z of a node, a damper's line; size 0 where none
  std::map<std::string, double> attributes =
      {};                          ///< numbers for a catalogue's expressions: "damping", "stiffness", "k_drive" …
  std::vector<int> elements = {};  ///< positions of the elements that belong to it
  ParameterLaw<CompactMatrix> stiffness_law = {}, mass_law = {};  ///< dependence of its matrices on the parameters
};

/// The candidate locations of a structure by set: elements, nodes, stays, dampers, damper_types ("dampers:C1,C2", all of a
/// make), supports, foundations, groups, global. If there are more than `max_zones` elements, and they are closer than
/// `zone_spacing_m`, the structure is cut into zones around elements far from each other. Every element belongs to the zone of
/// the nearest one.
struct Places {
  std::map<std::string, std::vector<Place>> sets;
  double total_mass_kg = 0.0;
};

/// An alternative position of dampers.
struct DamperMove {
  std::string name;                  ///< of the alternative, "foot_57m"
  std::vector<std::string> dampers;  ///< names as in springs.csv
  std::vector<Eigen::Vector3d> x_m;  ///< (n_dampers) each goes to the nearest node
};

/// Whether a spring may be moved as a damper: between a node and the ground, against a displacement.
[[nodiscard]] inline bool can_be_moved(const fe::Spring& spring) { return !spring.rotation && spring.node2 < 0; }

struct PlaceOptions {
  int max_zones = 24;                                         ///< of elements
  int max_nodes = 24;                                         ///< nodes of channels first, then nodes far from each other
  double zone_spacing_m = 0.0, node_spacing_m = 0.0;          ///< more are added until none are farther apart; 0: never more
  std::vector<DamperMove> moves;                              ///< set "damper_moves": "dampers:C1,C2@foot_57m"
  std::vector<Eigen::Vector3d> zone_centres, node_positions;  ///< given, for example of another mesh; empty: chosen
};

[[nodiscard]] Places find_places(const Structure& structure, const PlaceOptions& options);

/// Zone of a point among centres: position of the nearest.
[[nodiscard]] int nearest(const std::vector<Eigen::Vector3d>& centres, const Eigen::Vector3d& x);

}  // namespace twindeck::diagnosis
