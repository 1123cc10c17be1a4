#include "model_io/ansys_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "model_io/ansys_ignored.hpp"
#include "model_io/deck_stage.hpp"
#include "model_io/inp_cards.hpp"

namespace twindeck::model_io::ansys {
namespace {

/// Place of a label among six, or -1.
int force_of(const std::string& label) {
  static const std::vector<std::string> forces = {"FX", "FY", "FZ", "MX", "MY", "MZ"};
  const auto found = std::find(forces.begin(), forces.end(), label);
  return found == forces.end() ? -1 : static_cast<int>(found - forces.begin());
}

bool is_on(const Command& command) { return command.word(0) == "ON" || command.word(0) == "1" || command.word(0) == "YES"; }

void read_nodal_force(Parts& parts, const Command& command) {
  // F,node,label,value,value2,end,step; FDELE,node,label,end,step
  const bool deletes = command.key == "FDEL";
  const int dof = force_of(command.word(1));
  const bool all = deletes && (command.blank(1) || command.word(1) == "ALL");
  if (dof < 0 && !all) {
    if (!parts.loads.not_read) parts.loads.not_read = command;
    return;
  }
  for (const long node : parts.nodes_of(command, 0, deletes ? 2 : 4))
    for (int d = 0; d < 6; ++d)
      if (all || d == dof)
        parts.loads.forces[node][static_cast<std::size_t>(d)] = deletes ? 0.0 : parts.number_or(command, 2, 0.0);
}

std::vector<long> loaded_elements(Parts& parts, const Command& command) {
  std::vector<long> ids;
  if (command.word(0) == "ALL") {
    for (const auto& [id, element] : parts.elements)
      if (parts.selected_elements.all || parts.selected_elements.ids.contains(id)) ids.push_back(id);
    return ids;
  }
  if (const Component* named = command.blank(0) ? nullptr : parts.component(command.fields[0]); named != nullptr)
    return {named->members.begin(), named->members.end()};
  return {parts.integer(command, 0)};
}

void read_element_pressure(Parts& parts, const Command& command) {
  // SFBEAM,element,key,PRES,value i,value j,…; SFE,element,key,PRES,kind,values
  const bool beam = command.key == "SFBE";
  const std::size_t first = beam ? 3 : 4;
  ElementPressure pressure{command.line, parts.integer_or(command, 1, 1), parts.number_or(command, first, 0.0), 0.0, beam,
                           command.name};
  pressure.second = parts.number_or(command, first + 1, pressure.first);
  bool plain = command.word(2).starts_with("PRES");
  for (std::size_t i = first + 2; i < command.fields.size(); ++i)
    plain = plain && (command.blank(i) || parts.number_or(command, i, 0.0) == (beam ? 0.0 : pressure.first));
  if (!beam) plain = plain && parts.number_or(command, 3, 0.0) == 0.0 && pressure.second == pressure.first;
  if (!plain) {
    if (!parts.loads.not_read) parts.loads.not_read = command;
    return;
  }
  for (const long id : loaded_elements(parts, command)) parts.loads.pressures[{id, pressure.face}] = pressure;
}

void read_body_temperature(Parts& parts, const Command& command) {
  // BF,node,TEMP,value; BFUNIF,TEMP,value; TUNIF,value; TREF,value
  if (command.key == "TREF") {
    parts.loads.reference_K = parts.number_or(command, 0, 0.0);
  } else if (command.key == "TUNI" || (command.key == "BFUN" && command.word(0).starts_with("TEMP"))) {
    const std::size_t field = command.key == "TUNI" ? 0 : 1;
    parts.loads.uniform_K.reset();
    // Archives write _TINY for no temperature.
    if (command.word(field) != "_TINY") parts.loads.uniform_K = parts.number_or(command, field, 0.0);
  } else if (command.key == "BF" && command.word(1).starts_with("TEMP")) {
    for (const long node : parts.nodes_of(command, 0, command.fields.size()))
      parts.loads.nodes_K[node] = parts.number(command, 2);
  } else if (!parts.loads.not_read) {
    parts.loads.not_read = command;
  }
}

void read_initial_state(Parts& parts, const Command& command) {
  // INISTATE,SET,DTYP,EPEL or STRE; INISTATE,DEFINE,element,point,layer,place,values
  const std::string action = command.word(0).substr(0, 4);
  if (action == "SET") {
    if (command.word(1).starts_with("DTYP")) parts.loads.state_is_strain = command.word(2).starts_with("EPEL");
    return;
  }
  bool along_only = action == "DEFI" && !command.blank(5);
  for (std::size_t i = 6; i < command.fields.size(); ++i) along_only = along_only && parts.number_or(command, i, 0.0) == 0.0;
  if (!along_only) {
    if (!parts.loads.not_read) parts.loads.not_read = command;
    return;
  }
  const InitialState state{parts.number(command, 5), parts.loads.state_is_strain, command.line};
  if (!command.blank(1) && command.word(1) != "ALL") {
    parts.loads.states[parts.integer(command, 1)] = state;
    return;
  }
  for (const auto& [id, element] : parts.elements)
    if (parts.selected_elements.all || parts.selected_elements.ids.contains(id)) parts.loads.states[id] = state;
}

/// Puts loads on the model that is built.
class Loader {
 public:
  explicit Loader(Builder& builder) : builder_(builder), parts_(builder.parts), model_(builder.parts.model) {
    for (std::size_t i = 0; i < model_.elements.size(); ++i) {
      const long id = model_.elements[i].id;
      if (!parts_.elements.contains(id)) continue;  // a further piece
      const auto count = builder.pieces.find(id);
      for (std::size_t piece = 0; piece < (count == builder.pieces.end() ? 1 : count->second); ++piece)
        elements_[id].push_back(i + piece);
    }
  }

  void apply(const Loads& asked) {
    for (const auto& [node, force] : asked.forces)
      for (int d = 0; d < 6; ++d)
        if (const double size = force[static_cast<std::size_t>(d)]; size != 0.0) add_load(model_, placed(node, "F"), d, size);
    // ACEL accelerates the ground: weight acts against it.
    add_gravity(model_, -asked.acceleration);
    for (const auto& [node, movements] : parts_.movements)
      for (const auto& [dof, movement] : movements) {
        if (dof > 2 && movement.value != 0.0)
          parts_.fail(movement.line, "D", "turns a support by an angle that is not zero, which is not read",
                      "move supports, or load the model by forces");
        if (movement.value != 0.0) set_movement(model_, placed(node, "D"), dof, movement.value);
      }
    for (const auto& [at, pressure] : asked.pressures) press(at.first, pressure);
    for (const auto& [id, state] : asked.states) strain(id, state);
    warm_all(asked);
  }

 private:
  int placed(long node, const char* command) const {
    if (!builder_.has_node(node))
      parts_.fail(0, command, fmt::format("loads node {}, which no element holds", node), "load a node of the structure");
    return builder_.node(node);
  }

  void press(long id, const ElementPressure& p) {
    const auto found = elements_.find(id);
    if (found == elements_.end() || p.first == 0.0) return;
    for (const std::size_t at : found->second) {
      const fe::Element e = model_.elements[at];
      std::string problem;
      if (e.type == fe::ElementType::beam && p.beam) {
        problem = press_beam(e, id, p);
      } else if (e.type == fe::ElementType::shell && !p.beam && (p.face == 1 || p.face == 2)) {
        add_pressure(model_, e.nodes, p.face == 1 ? -p.first : p.first);
      } else if (e.type == fe::ElementType::solid && found->second.size() == 1 && !p.beam && e.nodes.size() == 8 &&
                 p.face >= 1 && p.face <= 6) {
        constexpr std::array<std::size_t, 6> face_of = {0, 2, 3, 4, 5, 1};  // ANSYS counts bottom, four sides, top
        std::vector<int> nodes;
        for (const std::size_t i : solid_faces(8)[face_of[static_cast<std::size_t>(p.face - 1)]]) nodes.push_back(e.nodes[i]);
        add_pressure(model_, nodes, p.first);
      } else {
        problem = fmt::format("is loaded on face {}, on which it is not read", p.face);
      }
      if (!problem.empty())
        parts_.fail(p.line, p.command, fmt::format("element {} {}", id, problem), "write the load as forces of nodes by F");
    }
  }

  /// Faces of BEAM188 and BEAM4: 1 presses along -z, 2 along -y, 3 along +x, 4 and 5 on the ends; of BEAM3: 1 along -y, 2 along
  /// +x, 3 and 4 on the ends.
  std::string press_beam(const fe::Element& e, long id, const ElementPressure& p) {
    const bool plane = parts_.types.at(parts_.elements.at(id).type).type->kind == Kind::plane_beam;
    const Eigen::Matrix3d axes = member_axes(model_, e);
    const long face = plane ? p.face + 1 : p.face;
    if (face == 4 || face == 5) {
      const Eigen::Vector3d along = (face == 4 ? 1.0 : -1.0) * axes.row(0).transpose();
      add_load(model_, e.nodes[face == 4 ? 0 : 1], p.first * along, Eigen::Vector3d::Zero());
      return "";
    }
    if (face < 1 || face > 3) return fmt::format("has no face {}", p.face);
    const Eigen::RowVector3d x = axes.row(0), y = axes.row(1), z = axes.row(2);
    const Eigen::Vector3d direction = (face == 3 ? x : face == 2 ? Eigen::RowVector3d(-y) : Eigen::RowVector3d(-z)).transpose();
    return add_line_load(model_, e, {p.first * direction, p.second * direction});
  }

  void strain(long id, const InitialState& state) {
    const auto found = elements_.find(id);
    if (found == elements_.end()) return;
    for (const std::size_t at : found->second) {
      fe::Element& e = model_.elements[at];
      if (e.type != fe::ElementType::beam && e.type != fe::ElementType::bar)
        parts_.fail(state.line, "INISTATE", fmt::format("strains element {}, and is read for beams and bars alone", id),
                    "load the model by forces, imposed movements or temperatures");
      const double modulus = model_.materials[static_cast<std::size_t>(e.material)].youngs_modulus_Pa;
      e.free_strain -= state.is_strain ? state.value : state.value / modulus;
    }
  }

  void warm_all(const Loads& asked) {
    if (!asked.uniform_K && asked.nodes_K.empty()) return;
    for (const auto& [id, positions] : elements_) {
      const auto material = parts_.materials.find(parts_.elements.at(id).material);
      if (material == parts_.materials.end() || !material->second.contains("ALPX")) continue;
      const auto reference = material->second.find("REFT");
      const double cold = reference == material->second.end() ? asked.reference_K : reference->second.value;
      double rise = 0.0, nodes = 0.0;
      for (const long node : parts_.elements.at(id).nodes) {
        if (!builder_.has_node(node)) continue;  // one that gives a direction alone
        const auto own = asked.nodes_K.find(node);
        rise += (own != asked.nodes_K.end() ? own->second : asked.uniform_K.value_or(cold)) - cold;
        nodes += 1.0;
      }
      for (const std::size_t at : positions) warm(model_.elements[at], material->second.at("ALPX").value, rise / nodes);
    }
  }

  Builder& builder_;
  Parts& parts_;
  fe::Model& model_;
  std::map<long, std::vector<std::size_t>> elements_;  ///< positions of what became of an element
};

}  // namespace

namespace {

bool collect_load(Parts& parts, const Command& command) {
  const std::string& key = command.key;
  static const std::vector<std::string> temperatures = {"BF", "BFUN", "TUNI", "TREF", "BFE", "BFEB", "EBLD", "LDRE"};
  if (key == "F" || key == "FDEL") {
    read_nodal_force(parts, command);
  } else if (key == "ACEL") {
    for (std::size_t i = 0; i < 3; ++i) parts.loads.acceleration[static_cast<int>(i)] = parts.number_or(command, i, 0.0);
  } else if (key == "SFBE" || key == "SFE") {
    read_element_pressure(parts, command);
  } else if (key == "INIS") {
    read_initial_state(parts, command);
    return true;
  } else if (std::find(temperatures.begin(), temperatures.end(), key) != temperatures.end()) {
    read_body_temperature(parts, command);
    return true;  // without a stage no word of it: moduli do not depend on it
  } else if (is_load(key)) {
    if (!parts.loads.not_read) parts.loads.not_read = command;
  } else {
    return false;
  }
  parts.told.emplace(upper_case(command.name), command.line);
  return true;
}

}  // namespace

bool read_load(Parts& parts, const Command& command) {
  try {
    return collect_load(parts, command);
  } catch (const InputError&) {  // a value that is not known matters where modes under load are asked for, and is said there
    if (!parts.loads.not_read) parts.loads.not_read = command;
    return true;
  }
}

bool read_solution(Parts& parts, const Command& command) {
  if (command.key == "PSTR") {
    parts.prestressed = is_on(command);
    if (parts.prestressed) parts.prestress_line = command.line;
  } else if (command.key == "NLGE") {
    parts.large = is_on(command);
    if (parts.large) parts.large_line = command.line;
  } else if (command.key == "ANTY") {
    const std::string type = command.word(0).substr(0, 4);
    parts.modal = type == "MODA" || type == "2";
  } else if (command.key == "PERT") {
    parts.perturbed = command.word(0).starts_with("MODA");
    parts.modal = parts.modal || parts.perturbed;
  } else {
    return false;
  }
  return true;
}

bool read_solve(Parts& parts, const Command& command) {
  if (command.word(0).starts_with("ELFO")) return false;  // forms the elements of a perturbation
  if (!parts.modal) {
    parts.stage = parts.loads;
    parts.stage_is_large = parts.large;
    return false;
  }
  if (parts.prestressed || parts.perturbed) {
    if (!parts.stage)
      parts.fail(command, "asks for modes of the loaded structure (PSTRES), but no static solution stands before it",
                 "solve the loads first (ANTYPE,STATIC, PSTRES,ON, SOLVE), or switch PSTRES off");
    parts.stage_asked = true;
  }
  return true;
}

double initial_strain(const Builder& builder, const Member& member, const RealSet& set, std::size_t i) {
  if (set.at(i) != 0.0 && !builder.parts.stage_asked)
    builder.parts.fail(set.line, "R",
                       fmt::format("constant {} of set {} is {:g}: an initial strain acts by a static solution with PSTRES,ON "
                                   "before the modal one, which the deck does not have",
                                   i, member.element.real, set.at(i)),
                       "leave it out, or solve the prestress first; the tension of bars may also go into pull_N of the model "
                       "folder");
  return set.at(i);
}

void apply_stage(Builder& builder) {
  Parts& parts = builder.parts;
  if (!parts.stage_asked) {
    if (!parts.loads.states.empty())
      parts.fail(parts.loads.states.begin()->second.line, "INISTATE",
                 "acts by a static solution with PSTRES,ON before the modal one, which the deck does not have",
                 "solve the prestress first, or leave it out");
    if (parts.prestressed)
      parts.fail(
          parts.prestress_line, "PSTRES", "asks for modes of the loaded structure, but no modal solution follows a static one",
          "solve the loads first (ANTYPE,STATIC, PSTRES,ON, SOLVE), then the modes (ANTYPE,MODAL), or switch PSTRES off");
    if (parts.large)
      parts.fail(parts.large_line, "NLGEOM", "asks for a deformed state, but the modes are not asked about it",
                 "switch it off, or follow the static solution by PERTURB,MODAL or PSTRES,ON");
    for (const auto& [node, movements] : parts.movements)
      for (const auto& [dof, movement] : movements)
        if (movement.value != 0.0)
          parts.fail(movement.line, "D", "prescribes a displacement that is not zero, which is not supported",
                     "supports hold at zero; before modes with PSTRES,ON or PERTURB,MODAL they may move");
    return;
  }
  if (const auto& not_read = parts.stage->not_read)
    parts.fail(*not_read, "loads the structure whose modes are asked for, and is not read",
               "read are F, ACEL, D, SFBEAM, SFE, BF, BFUNIF, TUNIF, INISTATE; write the load as forces by F");
  open_stage(parts.model, parts.stage_is_large);
  Loader(builder).apply(*parts.stage);
  if (const std::string note = settle_displacements(parts.model); !note.empty()) parts.notes.push_back(note);
  for (const char* carried : {"F", "ACEL", "SFBEAM", "SFE", "FDELE"}) parts.told.erase(carried);
  parts.notes.push_back(
      fmt::format("the modes are those about the state of the static solution before them{}: {} loads of nodes{}",
                  parts.stage_is_large ? " (in the deformed geometry)" : "", parts.model.prestress.loads.size(),
                  parts.model.gravity_m_s2 > 0.0 ? ", gravity" : ""));
}

}  // namespace twindeck::model_io::ansys
