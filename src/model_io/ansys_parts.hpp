#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "model_io/ansys_commands.hpp"
#include "model_io/ansys_types.hpp"
#include "model_io/deck_card.hpp"
#include "model_io/deck_model.hpp"

/// Inside of the library: what a deck of ANSYS says, collected command by command in its own numbers, and made into an
/// fe::Model at the end (ansys_members.cpp and its neighbours), since an element may stand before its type, section and
/// material.
namespace twindeck::model_io::ansys {

struct Node {
  Eigen::Vector3d x_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< its own (rows), in which supports, springs and forces count
  [[nodiscard]] bool rotated() const { return !axes.isIdentity(0.0); }
};

struct Element {
  long type = 1, material = 1, real = 1, section = 1;
  std::vector<long> nodes;
  long line = 0;
};

struct Option {
  long value = 0, line = 0;
};
struct TypeDefinition {
  std::string name;                    ///< as written
  const ElementType* type = nullptr;   ///< null: not read, which matters once an element is of it
  std::map<int, Option> options = {};  ///< KEYOPT
  long line = 0;
  [[nodiscard]] long option(int number) const {
    const auto found = options.find(number);
    return found == options.end() ? 0 : found->second.value;
  }
};

struct SectionDefinition {
  std::string type, subtype, name;             ///< "BEAM", "RECT", the user's name
  std::vector<std::vector<double>> data = {};  ///< one row a SECDATA, or a line of SECBLOCK
  std::string offset = {};                     ///< "CENT", "MID", "USER" …; "": the type's own
  std::array<double, 2> offset_m{};            ///< of USER
  long line = 0;
};

struct RealSet {
  std::vector<double> values;
  long line = 0;
  /// Value `i` (from 1, as the manual counts), 0 where it is missing.
  [[nodiscard]] double at(std::size_t i) const { return i <= values.size() ? values[i - 1] : 0.0; }
};

struct Property {
  double value = 0.0;
  long line = 0;
};

struct Component {
  std::string name;
  bool of_nodes = true;
  std::set<long> members;
};

/// Selected nodes or elements. What is defined later is selected too.
struct Selection {
  bool all = true;
  std::set<long> ids;  ///< where it is not all
  [[nodiscard]] bool has(long id) const { return all || ids.contains(id); }
};

struct Hold {
  std::array<bool, 6> fixed{};
  std::string name;  ///< of the component that it was given by, else ""
  long line = 0;
};

struct Link {
  long master, slave, line;
  std::array<bool, 6> tied;  ///< the slave's displacements and rotations that follow
};

/// sum factor · displacement = 0, of nodes by their numbers.
struct Equation {
  struct Term {
    long node;
    int dof;  ///< 0-5
    double factor;
  };
  long id;
  DeckPlace at;
  std::vector<Term> terms;
};

/// Nodes whose displacements a CP ties, by their set number.
struct Couple {
  std::vector<long> nodes;
  int dof;
  long line;
};

/// A pressure on a face of elements; of a beam from one end to the other.
struct ElementPressure {
  long line = 0, face = 1;
  double first = 0.0, second = 0.0;
  bool beam = false;  ///< by SFBEAM
  std::string command;
};
struct InitialState {
  double value = 0.0;      ///< along the axis
  bool is_strain = false;  ///< else a stress
  long line = 0;
};

/// Loads as they stand when a solution begins.
struct Loads {
  std::map<long, std::array<double, 6>> forces;
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  std::map<std::pair<long, long>, ElementPressure> pressures;  ///< by element and face
  std::map<long, double> nodes_K;
  std::optional<double> uniform_K;
  double reference_K = 0.0;
  std::map<long, InitialState> states;
  bool state_is_strain = false;
  std::optional<Command> not_read;  ///< the first load that is not carried
  void leave(const Command& command) {
    if (!not_read) not_read = command;
  }
};

/// A static solution.
struct LoadStep {
  Loads loads;
  bool large = false;
  std::optional<long> substeps;  ///< as in Parts
};

struct Parts : DeckModel {
  explicit Parts(const std::filesystem::path& file) : deck(file, parameters) {}

  Parameters parameters;
  Deck deck;
  std::map<std::string, long> told;  ///< first line of each ignored command that is worth a note, by its name
  /// Remembers an ignored command, unless all that it says is 0 (archives write all loads so).
  void tell(const Command& command) {
    const auto says = [](const std::string& f) { return f.find_first_not_of(" 0.+-Ee") != std::string::npos; };
    if (std::ranges::any_of(command.fields, says)) told.emplace(upper_case(command.name), command.line);
  }
  std::map<long, Node> nodes;
  std::array<long, 2> last_nodes{};  ///< the last two that N gave; 0: none
  std::map<long, Element> elements;
  std::map<long, TypeDefinition> types;
  std::map<long, SectionDefinition> sections;
  std::map<long, RealSet> reals;
  std::map<long, std::map<std::string, Property>> materials;
  std::vector<Component> components;
  Element active;               ///< TYPE, MAT, REAL, SECNUM as they stand
  long section = 0, real = 0;   ///< those that SECDATA and RMORE go on with
  std::size_t real_filled = 0;  ///< constants of that set so far, six a line
  Selection selected_nodes, selected_elements;
  std::string selected_component;  ///< the component of nodes that is selected and nothing else, or ""
  bool own_axes = false;           ///< CSYS is not 0
  std::map<long, Hold> holds;
  std::vector<Link> links;
  std::map<long, std::vector<Couple>> couples;
  std::vector<Equation> equations;
  Loads loads;                                                 ///< as they stand
  std::map<long, std::map<int, Property>> movements;           ///< of supports, by node and direction
  bool prestressed = false, perturbed = false, large = false;  ///< PSTRES, PERTURB, NLGEOM
  bool modal = false, is_static = true;                        ///< ANTYPE: one of them, or neither
  long large_line = 0, prestress_line = 0;
  std::optional<long> substeps = 1;  ///< of a load step; empty where the program chooses them
  std::vector<LoadStep> load_steps;  ///< of the static analysis so far
  bool starts_anew = true;           ///< the next static solution is the first load step of an analysis
  std::optional<Loads> stage;  ///< loads of the static solution that the modes are asked about: the last, if none is named
  bool stage_is_large = false, stage_asked = false;

  [[nodiscard]] DeckPlace at(long line, const std::string& label) const { return {&deck.path(), line, label}; }
  /// Nodes that a first field names: a number, ALL (the selected ones), a component; with an end and a step, a range.
  [[nodiscard]] std::set<long> nodes_of(const Command& command, std::size_t field, std::size_t end_field) const;
  [[nodiscard]] const Component* component(const std::string& name) const;
};

/// Labels of the degrees of freedom of a structure, in the order of directions.
inline const std::vector<std::string> dof_labels = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};

/// The model out of what was collected.
void build_model(Parts& parts);

}  // namespace twindeck::model_io::ansys
