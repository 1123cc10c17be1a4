#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace twindeck::fe {

/// A finite element model as data: the content of a model folder (docs/my_model.md), without computed values. SI units.
/// References between parts are positions in the vectors below (0-based), -1 = none.

struct Node {
  long id = 0;          ///< as in nodes.csv
  Eigen::Vector3d x_m;  ///< coordinates [m]
};

struct Material {
  std::string name;
  double youngs_modulus_Pa = 0.0;
  double shear_modulus_Pa = 0.0;  ///< follows E in proportion when E is a parameter
  double poisson_ratio = 0.0;
  double density_kg_m3 = 0.0;
};

struct Section {
  std::string name;
  // beams and bars
  double area_m2 = 0.0;
  double inertia_y_m4 = 0.0;     ///< bending in the local x-z plane
  double inertia_z_m4 = 0.0;     ///< bending in the local x-y plane
  double inertia_yz_m4 = 0.0;    ///< product of inertia (unsymmetric sections)
  double torsion_m4 = 0.0;       ///< St Venant
  double shear_area_y_m2 = 0.0;  ///< 0: rigid in shear (Euler)
  double shear_area_z_m2 = 0.0;
  // shells
  double thickness_m = 0.0;
  double bending_inertia_ratio = 1.0;  ///< multiplies t³/12 alone (RMI): not membrane, not mass
  double shear_thickness_ratio = 0.0;  ///< thickness that carries transverse shear over t: 5/6 of a homogeneous plate
                                       ///< (Mindlin); 0: rigid in transverse shear (Kirchhoff)
};
/// Section::shear_thickness_ratio of a homogeneous plate. Reference: Reissner (1945), J. Appl. Mech. 12, A69-A77.
inline constexpr double homogeneous_shear_ratio = 5.0 / 6.0;

enum class ElementType { beam, bar, stay, shell, solid };

/// Nodes of an element of this type; a shell may also have three, a solid four, ten or twenty (has_node_count).
[[nodiscard]] constexpr std::size_t node_count(ElementType type) {
  return type == ElementType::solid ? 8 : type == ElementType::shell ? 4 : 2;
}
/// Whether an element of this type can have so many nodes: shells have three or four; solids four or eight, with nodes in the
/// middles of their edges ten or twenty (solid_quadratic.hpp).
[[nodiscard]] constexpr bool has_node_count(ElementType type, std::size_t count) {
  return count == node_count(type) || (type == ElementType::shell && count == 3) ||
         (type == ElementType::solid && (count == 4 || count == 10 || count == 20));
}

struct Element {
  long id = 0;
  ElementType type = ElementType::beam;
  std::string name;   ///< stays: "NE8"; else ""
  std::string group;  ///< "foot_top_chord", "slab_foot_B", "stay_44": the unit of parameters and of diagnosis
  int material = -1;
  int section = -1;        ///< none (-1) for a solid
  int section2 = -1;       ///< beams: section at the second end of a tapered one (see beam.hpp); -1 = uniform
  std::vector<int> nodes;  ///< 2 (beam, bar, stay), 3 or 4 (shell, anticlockwise), 4 or 8 (solid.hpp) or 10 or 20
                           ///< (solid_quadratic.hpp)
  Eigen::Vector3d orientation = Eigen::Vector3d::Zero();  ///< beams: local z lies in the plane of axis and this vector, as near
                                                          ///< to it as can be; 0 = global Z (X for vertical beams)
  std::array<Eigen::Vector3d, 2> offset_m = {Eigen::Vector3d::Zero(),
                                             Eigen::Vector3d::Zero()};  ///< node -> beam end, global axes
  std::uint16_t releases = 0;  ///< beams: bit i set = local end degree of freedom i (0-11) carries no force
  double pull_N = 0.0;         ///< stays: pretension (given, or the site value that shape finding blends with; 0 = none); bars:
                               ///< tension in the geometry of nodes.csv
  double free_strain = 0.0;    ///< [-] strain without forces in the static state, alike in all directions: α ΔT of a warming;
                               ///< along the axis alone for beams and bars; stays have none
};

/// Spring, dashpot or friction element between a node and ground, or two nodes, along a direction.
struct Spring {
  std::string name, group;
  int node = -1, node2 = -1;  ///< node2 = -1: ground
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  bool rotation = false;    ///< acts on rotations about `direction`
  double stiffness = 0.0;   ///< [N/m] or [N m/rad]
  double damping = 0.0;     ///< [N s/m] or [N m s/rad]
  double friction_N = 0.0;  ///< Coulomb threshold; 0 = none
  bool series = false;      ///< true: spring and dashpot in series (Maxwell); false: in parallel (Kelvin)
  bool active = true;       ///< false: carried as data (a damper that is not fitted), not assembled

  [[nodiscard]] bool is_damper() const { return damping > 0.0 || friction_N > 0.0; }
  /// Name of the support that a spring to the ground stands for.
  [[nodiscard]] const std::string& support_name() const { return group.empty() ? name : group; }
};

/// Element given by its matrices: force f = M a + C v + K u on its degrees of freedom and on unknowns of its own. The matrices
/// may be unsymmetric (self-excited forces, the state space of a damper). The modes of the structure use the conservative part:
/// own unknowns are condensed statically, then the symmetric part of K and M is taken. The dynamic system uses the whole
/// element.
struct MatrixElement {
  struct Dof {
    int node = -1;
    int direction = 0;
  };  ///< direction 0-5 = x y z rx ry rz
  std::string name, group;
  std::vector<Dof> dofs;
  int internal = 0;                          ///< unknowns of its own, which follow `dofs` in the matrices
  Eigen::MatrixXd stiffness, damping, mass;  ///< (dofs + internal)²; empty = zero
};

struct RigidLink {
  std::string name;
  int master = -1;
  int slave = -1;
};  ///< slave moves as a rigid body with master (6 dof)

/// One displacement that follows others: u(node, direction) = sum of factor · u(term), for small displacements. Ties between
/// meshes that do not match, averages (RBE3) and hinges are such equations.
struct Constraint {
  struct Term {
    int node = -1;
    int direction = 0;  ///< 0-5 = x y z rx ry rz
    double factor = 0.0;
  };
  std::string name;
  int node = -1;
  int direction = 0;  ///< of the dependent displacement
  std::vector<Term> terms;
};

struct PointMass {
  std::string group;
  int node = -1;
  double mass_kg = 0.0;
  Eigen::Vector3d inertia_kg_m2 = Eigen::Vector3d::Zero();  ///< rotary, global axes
};

struct Support {
  std::string name;
  int node = -1;
  std::array<bool, 6> fixed{};
};  ///< x y z rx ry rz

/// What a parameter scales.
enum class Target {
  youngs_modulus,
  density,  ///< of a material
  thickness,
  bending_inertia_ratio,
  area,  ///< of a section (area: axial stiffness and mass of bars, stays and beams)
  spring_stiffness,
  point_mass,  ///< of a group of springs, of point masses (a factor, initial 1)
  matrix_stiffness,
  matrix_mass  ///< of a matrix model: coefficient of K_i, M_i
};

struct Parameter {
  std::string name;  ///< "E_c1"
  Target target = Target::youngs_modulus;
  std::vector<std::string> of;  ///< names of materials, sections or groups it applies to
  std::string unit;             ///< "Pa", "kg/m3", "-"
  double initial = 0.0;
  double lower = 0.0;  ///< bounds; equal to `initial` on both sides means fixed
  double upper = 0.0;
  std::optional<double> nominal = std::nullopt;  ///< value before it was fitted to measurements; none: never fitted

  [[nodiscard]] double expected() const { return nominal.value_or(initial); }  ///< without those measurements
};

/// Displacements under dead load and cable forces.
enum class Displacements {
  linear,  ///< small: equilibrium in the geometry of nodes.csv
  large    ///< co-rotational, equilibrium in the deformed geometry; the modes are those about it
};

enum class PullRule {
  none,          ///< no prestress
  given,         ///< Element::pull_N unchanged
  shape_finding  ///< least cable forces for zero displacement at the conditions, blended with site values (Element::pull_N)
};

struct Prestress {
  PullRule rule = PullRule::none;
  bool geometric_stiffness = true;
  double minimum_pull_N = 30e3;  ///< least cable force of shape finding, so that no stay is slack
  double ridge = 1e-3;           ///< weight of small cable forces against zero displacement (dimensionless)
  double site_weight = 0.0;      ///< weight of the site values against zero displacement (dimensionless), 0 = ignored
  struct Condition {
    int node;
    int dof;
  };  ///< displacement that should be zero (dof 0-2)
  std::vector<Condition> conditions;
  Displacements displacements = Displacements::linear;
  int load_steps = 1;              ///< large displacements: number of equal steps of dead load and cable forces
  bool shells_and_solids = false;  ///< their stresses stiffen and soften too, as the forces of beams, bars and stays always do
  /// A force [N], a moment [N m], or a movement of a support [m] that acts beside dead load and cable forces.
  struct Load {
    int node = -1;
    int direction = 0;  ///< 0-5 = x y z rx ry rz; movements 0-2
    double value = 0.0;
    bool movement = false;
  };
  std::string load_case = {};    ///< of loads.csv, which `loads` are; "" = none
  std::vector<Load> loads = {};  ///< of this load case
};

/// Options of the element formulation.
struct Formulation {
  bool shear_flexible = true;        ///< false: Euler-Bernoulli and Kirchhoff, shear areas and ratios are ignored
  bool beam_rotary_inertia = true;   ///< false: translational and torsional mass of beams only
  bool shell_rotary_inertia = true;  ///< false: translational mass only
  /// penalty: Hughes-Brezzi; diagonal: factor E t A on each corner, spread so that a rigid rotation meets no resistance
  enum class Drilling { penalty, diagonal } drilling = Drilling::penalty;
  double drilling_factor = 0.0;  ///< 0 = the formulation's own default
  bool lumped_mass = false;      ///< true: masses at the nodes (diagonal but for arms and releases); false: consistent
};

/// Index of node, element or degree of freedom `i` for a vector.
[[nodiscard]] inline std::size_t slot(int i) { return static_cast<std::size_t>(i); }

struct Model {
  std::string title;
  double gravity_m_s2 = 9.81;
  Eigen::Vector3d gravity_direction = -Eigen::Vector3d::UnitZ();  ///< unit vector
  Formulation formulation;
  Prestress prestress;
  std::vector<Node> nodes;
  std::vector<Material> materials;
  std::vector<Section> sections;
  std::vector<Element> elements;
  std::vector<Spring> springs;
  std::vector<MatrixElement> matrix_elements;
  std::vector<RigidLink> links;
  std::vector<Constraint> constraints;
  std::vector<PointMass> masses;
  std::vector<Support> supports;
  std::vector<Parameter> parameters;
  std::map<std::string, int> monitoring_points;  ///< "M1" -> node
  std::string source;                            ///< folder or generator it came from, for messages
};

}  // namespace twindeck::fe
