#include "model_io/ansys_stage.hpp"

#include <fmt/format.h>

#include <array>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "model_io/ansys_ignored.hpp"
#include "model_io/deck_stage.hpp"
#include "model_io/names.hpp"

namespace twindeck::model_io::ansys {
namespace {

/// OMEGA and its like, of the structure, a component or its axes.
bool spins(const Command& c) { return c.key == "OMEG" || c.key == "CMOM" || c.key == "CGOM"; }

bool is_on(const Command& command) { return command.word(0) == "ON" || command.word(0) == "1" || command.word(0) == "YES"; }

void read_nodal_force(Parts& parts, const Command& command) {
  // F,node,label,value,value2,end,step; FDELE,node,label,end,step
  const bool deletes = command.key == "FDEL";
  const int dof = position_of(command.word(1), {"FX", "FY", "FZ", "MX", "MY", "MZ"});
  const bool all = deletes && (command.blank(1) || command.word(1) == "ALL");
  if (dof < 0 && !all) return parts.loads.leave(command);
  for (const long node : parts.nodes_of(command, 0, deletes ? 2 : 4))
    for (int d = 0; d < 6; ++d)
      if (all || d == dof) parts.loads.forces[node][static_cast<std::size_t>(d)] = deletes ? 0.0 : command.number_or(2, 0.0);
}

std::vector<long> loaded_elements(Parts& parts, const Command& command) {
  std::vector<long> ids;
  if (command.word(0) == "ALL") {
    for (const auto& [id, element] : parts.elements)
      if (parts.selected_elements.has(id)) ids.push_back(id);
    return ids;
  }
  if (const Component* named = command.blank(0) ? nullptr : parts.component(command.fields[0]); named != nullptr)
    return {named->members.begin(), named->members.end()};
  return {command.integer(0)};
}

void read_element_pressure(Parts& parts, const Command& command) {
  // SFBEAM,element,key,PRES,value i,value j,…; SFE,element,key,PRES,kind,values
  const bool beam = command.key == "SFBE";
  const std::size_t first = beam ? 3 : 4;
  ElementPressure pressure{command.line, command.integer_or(1, 1), command.number_or(first, 0.0), 0.0, beam, command.name};
  pressure.second = command.number_or(first + 1, pressure.first);
  bool plain = command.word(2).starts_with("PRES");
  for (std::size_t i = first + 2; i < command.fields.size(); ++i)
    plain = plain && (command.blank(i) || command.number_or(i, 0.0) == (beam ? 0.0 : pressure.first));
  if (!beam) plain = plain && command.number_or(3, 0.0) == 0.0 && pressure.second == pressure.first;
  if (!plain) return parts.loads.leave(command);
  for (const long id : loaded_elements(parts, command)) parts.loads.pressures[{id, pressure.face}] = pressure;
}

void read_body_temperature(Parts& parts, const Command& command) {
  // BF,node,TEMP,value; BFUNIF,TEMP,value; TUNIF,value; TREF,value
  if (command.key == "TREF") {
    parts.loads.reference_K = command.number_or(0, 0.0);
  } else if (command.key == "TUNI" || (command.key == "BFUN" && command.word(0).starts_with("TEMP"))) {
    const std::size_t field = command.key == "TUNI" ? 0 : 1;
    parts.loads.uniform_K.reset();
    // Archives write _TINY for no temperature.
    if (command.word(field) != "_TINY") parts.loads.uniform_K = command.number_or(field, 0.0);
  } else if (command.key == "BF" && command.word(1).starts_with("TEMP")) {
    for (const long node : parts.nodes_of(command, 0, command.fields.size())) parts.loads.nodes_K[node] = command.number(2);
  } else {
    parts.loads.leave(command);
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
  for (std::size_t i = 6; i < command.fields.size(); ++i) along_only = along_only && command.number_or(i, 0.0) == 0.0;
  if (!along_only) return parts.loads.leave(command);
  const InitialState state{command.number(5), parts.loads.state_is_strain, command.line};
  if (!command.blank(1) && command.word(1) != "ALL") {
    parts.loads.states[command.integer(1)] = state;
    return;
  }
  for (const auto& [id, element] : parts.elements)
    if (parts.selected_elements.has(id)) parts.loads.states[id] = state;
}

/// Puts loads on the model that is built.
class Loader {
 public:
  explicit Loader(Builder& builder)
      : parts_(builder.parts), stage_(parts_, parts_.stage_is_large, "write the load as forces of nodes by F") {}

  void apply(const Loads& asked) {
    for (const auto& [node, force] : asked.forces) {
      const Eigen::Map<const Eigen::Matrix<double, 6, 1>> own(force.data());
      if (own.isZero(0.0)) continue;
      const Eigen::Matrix3d turn = parts_.nodes.at(node).axes.transpose();
      stage_.load(stage_.node(parts_.at(0, "F"), node), turn * own.head<3>(), turn * own.tail<3>());
    }
    // ACEL accelerates the ground: weight acts against it.
    stage_.accelerate(-asked.acceleration);
    for (const auto& [node, movements] : parts_.movements)
      for (const auto& [dof, movement] : movements) {
        const DeckPlace at = parts_.at(movement.line, "D");
        if (movement.value != 0.0) stage_.move(at, stage_.node(at, node), dof, movement.value, parts_.nodes.at(node).axes);
      }
    for (const auto& [at, pressure] : asked.pressures) press(at.first, pressure);
    for (const auto& [id, state] : asked.states)
      stage_.strain(parts_.at(state.line, "INISTATE"), id, state.value, !state.is_strain);
    if (asked.uniform_K || !asked.nodes_K.empty())
      stage_.warm([&](const fe::Element&, long node, const Expansion& of) {
        const auto own = asked.nodes_K.find(node);
        return (own != asked.nodes_K.end() ? own->second : asked.uniform_K.value_or(of.reference_K)) - of.reference_K;
      });
    stage_.close("the static solution before them");
  }

 private:
  void press(long id, const ElementPressure& p) {
    const std::vector<fe::Element*> pieces = stage_.pieces(id);
    if (pieces.empty() || p.first == 0.0) return;
    const DeckPlace at = parts_.at(p.line, p.command);
    const fe::ElementType type = pieces.front()->type;
    if (type == fe::ElementType::beam && p.beam) return press_beam(at, id, p);
    if (type == fe::ElementType::shell && !p.beam && (p.face == 1 || p.face == 2))
      return stage_.press_shell(at, id, p.face == 1 ? p.first : -p.first);
    const std::size_t nodes = pieces.front()->nodes.size();
    const bool hexahedron = nodes == 8 || nodes == 20, own_type = parts_.elements.at(id).nodes.size() == nodes;
    if (type != fe::ElementType::solid || p.beam || !own_type || p.face < 1 || p.face > (hexahedron ? 6 : 4))
      stage_.refuse(at, id, fmt::format("a pressure on face {}", p.face));
    constexpr std::array<std::size_t, 6> face_of = {0, 2, 3, 4, 5, 1};  // ANSYS counts bottom, four sides, top
    const auto face = static_cast<std::size_t>(p.face - 1);
    stage_.press_solid(at, id, hexahedron ? face_of[face] : face, p.first);
  }

  /// Faces of BEAM188 and BEAM4: 1 presses along -z, 2 along -y, 3 along +x, 4 and 5 on the ends; of BEAM3: 1 along -y, 2 along
  /// +x, 3 and 4 on the ends.
  void press_beam(const DeckPlace& at, long id, const ElementPressure& p) {
    const bool plane = parts_.types.at(parts_.elements.at(id).type).type->kind == Kind::plane_beam;
    const long face = plane ? p.face + 1 : p.face;
    if (face < 1 || face > 5) stage_.refuse(at, id, fmt::format("a pressure on face {}", p.face));
    if (face > 3) {
      const fe::Element& e = stage_.element(at, id);
      const Eigen::Vector3d along = (face == 4 ? 1.0 : -1.0) * member_axes(parts_.model, e).row(0).transpose();
      return stage_.load(e.nodes[face == 4 ? 0 : 1], p.first * along);
    }
    stage_.load_line(at, id, [&](const fe::Element& e) {
      const Eigen::Matrix3d axes = member_axes(parts_.model, e);
      const Eigen::Vector3d direction = (face == 3 ? 1.0 : -1.0) * axes.row(face == 3 ? 0 : face == 2 ? 1 : 2).transpose();
      return LineLoad{p.first * direction, p.second * direction};
    });
  }

  Parts& parts_;
  DeckStage stage_;
};

void take_stage(Parts& parts, const LoadStep& step) {
  parts.stage = step.loads;
  parts.stage_is_large = step.large;
}

/// ANTYPE,STATIC,RESTART,load step,substep,PERTURB: the state that the modes are asked about.
void choose_stage(Parts& parts, const Command& command) {
  if (!parts.is_static)
    command.fail("perturbs the state of another solution than a static one, which is not read",
                 "solve the loads by ANTYPE,STATIC and name that");
  const std::vector<LoadStep>& steps = parts.load_steps;
  const long step = command.integer_or(2, 0), substep = command.integer_or(3, 0);
  if (steps.empty()) return;  // SOLVE says so
  if (step < 0 || step > std::ssize(steps))
    command.fail(fmt::format("names load step {}, but {} static solutions stand before it", step, steps.size()),
                 "name one of them, or none for the last");
  const LoadStep& chosen = step == 0 ? steps.back() : steps[static_cast<std::size_t>(step - 1)];
  if (substep != 0 && substep != chosen.substeps)
    command.fail(fmt::format("asks for modes about substep {} of a load step of {} substeps, of which only the end is read",
                             substep, chosen.substeps ? std::to_string(*chosen.substeps) : "an unknown number of"),
                 "leave the substep blank for the end of the load step, or write the loads of that substep as a load step");
  take_stage(parts, chosen);
}

/// ANTYPE,type,status,load step,substep,action
void read_analysis(Parts& parts, const Command& command) {
  if (!command.blank(0)) {  // else it stays the same
    const std::string type = command.word(0).substr(0, 4);
    parts.modal = type == "MODA" || type == "2";
    parts.is_static = type == "STAT" || type == "0";
  }
  parts.starts_anew = command.blank(1) || !command.word(1).starts_with("REST");
  if (parts.starts_anew) return;
  if (!command.blank(4) && command.word(4).starts_with("PERT")) {
    choose_stage(parts, command);
    parts.is_static = false;
  } else if (const long step = command.integer_or(2, 0); step > 0 && step < std::ssize(parts.load_steps)) {
    parts.load_steps.resize(static_cast<std::size_t>(step));  // what follows takes the place of the later ones
  }
}

/// NSUBST,number,most,least; DELTIM, AUTOTS: how many substeps a load step has, where that is sure.
bool read_substeps(Parts& parts, const Command& command) {
  const bool by_number = command.key == "NSUB", automatic = command.key == "AUTO" && is_on(command);
  if (!by_number && !automatic && command.key != "DELT") return false;
  const long number = by_number ? command.integer_or(0, 1) : 0;
  parts.substeps.reset();
  if (by_number && command.integer_or(1, number) == number && command.integer_or(2, number) == number) parts.substeps = number;
  return true;
}

bool collect_load(Parts& parts, const Command& command) {
  const std::string& key = command.key;
  static const std::vector<std::string> temperatures = {"BF", "BFUN", "TUNI", "TREF", "BFE", "BFEB", "EBLD", "LDRE"};
  if (key == "F" || key == "FDEL") {
    read_nodal_force(parts, command);
  } else if (key == "ACEL") {
    parts.loads.acceleration = command.vector(0);
  } else if (key == "SFBE" || key == "SFE") {
    read_element_pressure(parts, command);
  } else if (key == "INIS") {
    read_initial_state(parts, command);
    return true;
  } else if (contains(temperatures, key)) {
    read_body_temperature(parts, command);
    return true;  // without a stage no word of it: moduli do not depend on it
  } else if (is_load(key)) {
    parts.loads.leave(command);
  } else {
    return false;
  }
  parts.tell(command);
  return true;
}

}  // namespace

bool read_load(Parts& parts, const Command& command) {
  try {
    return collect_load(parts, command);
  } catch (const InputError&) {  // a value that is not known matters where modes under load are asked for, and is said there
    parts.loads.leave(command);
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
    read_analysis(parts, command);
  } else if (command.key == "PERT") {
    parts.perturbed = command.word(0).starts_with("MODA");
    if (parts.perturbed) parts.modal = true, parts.is_static = false;
  } else if (command.key == "CORI" || command.key == "OMEG") {
    constexpr std::size_t softens = 3;  // field of OMEGA
    const bool gyroscopic = command.key == "CORI";
    if (gyroscopic ? command.blank(0) || is_on(command) : command.number_or(softens, 0.0) != 0.0)
      command.fail("asks for the modes of a spinning structure, whose gyroscopic forces and softening are not read",
                   "leave it out for the modes at rest");
    return gyroscopic;
  } else {
    return read_substeps(parts, command);
  }
  return true;
}

bool read_solve(Parts& parts, const Command& command) {
  if (command.word(0).starts_with("ELFO")) return false;  // forms the elements of a perturbation
  if (parts.is_static) {
    if (parts.starts_anew) parts.load_steps.clear();
    parts.starts_anew = false;
    parts.load_steps.push_back({parts.loads, parts.large, parts.substeps});
    take_stage(parts, parts.load_steps.back());
  }
  if (!parts.modal) return false;
  if (parts.prestressed || parts.perturbed) {
    if (!parts.stage)
      command.fail("asks for modes of the loaded structure (PSTRES), but no static solution stands before it",
                   "solve the loads first (ANTYPE,STATIC, PSTRES,ON, SOLVE), or switch PSTRES off");
    parts.stage_asked = true;
  }
  return true;
}

double initial_strain(const Builder& builder, const Member& member, const RealSet& set, std::size_t i) {
  if (set.at(i) != 0.0 && !builder.parts.stage_asked)
    builder.parts.at(set.line, "R")
        .fail(fmt::format("constant {} of set {} is {:g}: an initial strain acts by a static solution with PSTRES,ON "
                          "before the modal one, which the deck does not have",
                          i, member.element.real, set.at(i)),
              "leave it out, or solve the prestress first; the tension of bars may also go into pull_N of the model folder");
  return set.at(i);
}

void apply_stage(Builder& builder) {
  Parts& parts = builder.parts;
  if (!parts.stage_asked) {
    if (!parts.loads.states.empty())
      parts.at(parts.loads.states.begin()->second.line, "INISTATE")
          .fail("acts by a static solution with PSTRES,ON before the modal one, which the deck does not have",
                "solve the prestress first, or leave it out");
    if (parts.prestressed)
      parts.at(parts.prestress_line, "PSTRES")
          .fail("asks for modes of the loaded structure, but no modal solution follows a static one",
                "solve the loads first (ANTYPE,STATIC, PSTRES,ON, SOLVE), then the modes (ANTYPE,MODAL), or switch PSTRES off");
    if (parts.large)
      parts.at(parts.large_line, "NLGEOM")
          .fail("asks for a deformed state, but the modes are not asked about it",
                "switch it off, or follow the static solution by PERTURB,MODAL or PSTRES,ON");
    for (const auto& [node, movements] : parts.movements)
      for (const auto& [dof, movement] : movements)
        if (movement.value != 0.0)
          parts.at(movement.line, "D")
              .fail("prescribes a displacement that is not zero, which is not supported",
                    "supports hold at zero; before modes with PSTRES,ON or PERTURB,MODAL they may move");
    return;
  }
  if (const auto& not_read = parts.stage->not_read)
    not_read->fail("loads the structure whose modes are asked for, and is not read",
                   spins(*not_read)
                       ? "spinning stiffens and softens, which forces by F do not: leave it out for the modes at rest"
                       : "read are F, ACEL, D, SFBEAM, SFE, BF, BFUNIF, TUNIF, INISTATE; write the load as forces "
                         "by F");
  Loader(builder).apply(*parts.stage);
  for (const char* carried : {"F", "ACEL", "SFBEAM", "SFE", "FDELE"}) parts.told.erase(carried);
}

}  // namespace twindeck::model_io::ansys
