#include "model_io/inp_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "fe/assembly_elements.hpp"
#include "model_io/deck_stage.hpp"
#include "model_io/inp_elements.hpp"

namespace twindeck::model_io {
namespace {

const std::set<std::string>& load_keywords() {
  static const std::set<std::string> names = {"CLOAD", "DLOAD", "DSLOAD", "TEMPERATURE"};
  return names;
}

bool is_nonzero_boundary(const InpCard& card) {
  return card.keyword == "BOUNDARY" && std::any_of(card.data.begin(), card.data.end(), [](const InpLine& line) {
           return line.fields.size() > 3 && line.fields[3].find_first_of("123456789") != std::string::npos;
         });
}

bool says_yes(const InpCard& step, const char* parameter) {
  return step.has(parameter) && upper_case(step.get(parameter)) != "NO";
}

/// A line of a load card that is in force.
struct LoadLine {
  std::string key;  ///< what a later step replaces: kind, place, label
  int step = 0;
  int scope = 0;
  const InpCard* card = nullptr;
  const InpLine* line = nullptr;
};

/// Lines in force at the end of the stage.
std::vector<LoadLine> lines_in_force(const InpStage& stage) {
  std::vector<LoadLine> lines;
  std::set<std::string> renewed;
  int step = 0;
  for (const InpReading& reading : stage.cards) {
    const InpCard& card = *reading.card;
    if (card.keyword == "STEP") {
      ++step;
      renewed.clear();
      continue;
    }
    if (upper_case(card.get("OP")) == "NEW" && renewed.insert(card.keyword).second)
      std::erase_if(lines, [&](const LoadLine& old) { return old.card->keyword == card.keyword; });
    for (const InpLine& line : card.data) {
      const std::string label = line.fields.size() > 1 && card.keyword != "TEMPERATURE" ? line.fields[1] : "";
      const std::string key = fmt::format("{}:{}:{}:{}", card.keyword, reading.scope, line.fields[0], upper_case(label));
      std::erase_if(lines, [&](const LoadLine& old) { return old.key == key && old.step < step; });
      lines.push_back({key, step, reading.scope, &card, &line});
    }
  }
  return lines;
}

class InpStageReader {
 public:
  explicit InpStageReader(InpParts& parts) : parts_(parts), model_(parts.model) {
    for (std::size_t i = 0; i < model_.elements.size(); ++i) position_.emplace(model_.elements[i].id, i);
  }

  void read(const LoadLine& load) {
    parts_.scope = load.scope;
    const std::string& keyword = load.card->keyword;
    if (keyword == "CLOAD") return read_forces(*load.card, *load.line);
    if (keyword == "DLOAD") return read_distributed(*load.card, *load.line);
    if (keyword == "DSLOAD") return read_surface_load(*load.card, *load.line);
    if (keyword == "TEMPERATURE") return read_temperature(*load.card, *load.line, now_);
    if (keyword == "BOUNDARY") read_movement(*load.card, *load.line);
  }

  void read_initial(const InpReading& reading) {
    parts_.scope = reading.scope;
    const InpCard& card = *reading.card;
    parts_.file.allow(card, {"TYPE"});
    const std::string type = upper_case(card.get("TYPE"));
    for (const InpLine& line : card.data) {
      if (type == "TEMPERATURE") {
        read_temperature(card, line, before_);
      } else {
        read_stress(card, line);
      }
    }
  }

  /// Free strains of the elements whose nodes are warmer than before, on the mean over their nodes.
  void warm_elements() {
    for (fe::Element& e : model_.elements) {
      const auto expansion = parts_.expansion.find(e.material);
      if (expansion == parts_.expansion.end()) continue;
      double rise = 0.0, nodes = 0.0;
      for (const int node : e.nodes) {
        // Nodes in the centres of split elements are none of the file's.
        if (!parts_.scope_of_node.contains(model_.nodes[static_cast<std::size_t>(node)].id)) continue;
        rise += value(now_, node, value(before_, node, 0.0)) - value(before_, node, 0.0);
        nodes += 1.0;
      }
      warm(e, expansion->second, rise / nodes);
    }
  }

 private:
  static double value(const std::map<int, double>& of, int node, double otherwise) {
    const auto found = of.find(node);
    return found == of.end() ? otherwise : found->second;
  }

  int joined_node(const InpCard& card, const InpLine& line, long id) const {
    const auto found = parts_.node_position.find(id);
    if (found == parts_.node_position.end())
      parts_.file.fail(card, line.line, fmt::format("loads node {}, which no element joins", parts_.node_name(id)),
                       "load a node of the structure");
    return found->second;
  }

  void refuse_turned(const InpCard& card, const InpLine& line) const {
    if (parts_.scopes[static_cast<std::size_t>(parts_.scope)].turned())
      parts_.file.fail(card, line.line, "names a direction by its number in an instance that is rotated, which is not read",
                       "write the card at the level of the assembly");
  }

  void read_forces(const InpCard& card, const InpLine& line) {
    parts_.file.allow(card, {"OP"});
    refuse_turned(card, line);
    const int dof = parts_.file.dof(card, line, 1);
    const double size = parts_.file.number_or(card, line, 2, 0.0);
    for (const long id : parts_.nodes_of(card, line, 0)) add_load(model_, joined_node(card, line, id), dof, size);
  }

  void read_movement(const InpCard& card, const InpLine& line) {
    const double size = parts_.file.number_or(card, line, 3, 0.0);
    if (line.fields.size() < 4) return;
    const int first = parts_.file.dof(card, line, 1);
    const int last = line.fields[2].empty() ? first : parts_.file.dof(card, line, 2);
    if (size != 0.0) refuse_turned(card, line);
    if (size != 0.0 && last > 2)
      parts_.file.fail(card, line.line, "turns a support by an angle that is not zero, which is not read",
                       "load the model by forces, or move its supports");
    for (const long id : parts_.nodes_of(card, line, 0))
      for (int dof = first; dof <= std::min(last, 2); ++dof) set_movement(model_, joined_node(card, line, id), dof, size);
  }

  void read_temperature(const InpCard& card, const InpLine& line, std::map<int, double>& of) {
    if (card.keyword == "TEMPERATURE") parts_.file.allow(card, {"OP"});
    const double kelvin = parts_.file.number(card, line, 1);
    for (const long id : parts_.nodes_of(card, line, 0))
      if (const auto node = parts_.node_position.find(id); node != parts_.node_position.end()) of[node->second] = kelvin;
  }

  std::vector<long> element_ids(const InpCard& card, const InpLine& line) {
    if (parts_.is_number(line.fields[0])) return {parts_.element_id(card, line, 0)};
    return parts_.set(parts_.element_sets, card, line.line, line.fields[0]).members;
  }

  /// The element of the file, and what became of it: two beams of one with a node in its middle.
  const InpElement& file_element(const InpCard& card, const InpLine& line, long id) const {
    const auto found = parts_.elements.find(id);
    if (found == parts_.elements.end())
      parts_.file.fail(card, line.line, fmt::format("element {} is not defined by any *ELEMENT", id), "define it");
    return found->second;
  }
  std::vector<fe::Element*> pieces(long id) {
    std::vector<fe::Element*> found;
    const auto at = position_.find(id);
    if (at == position_.end()) return found;
    const std::size_t count = parts_.pieces.contains(id) ? parts_.pieces.at(id) : 1;
    for (std::size_t i = 0; i < count; ++i) found.push_back(&model_.elements[at->second + i]);
    return found;
  }

  void read_stress(const InpCard& card, const InpLine& line) {
    const double stress = parts_.file.number(card, line, 1);
    for (std::size_t i = 2; i < line.fields.size(); ++i)
      if (parts_.file.number_or(card, line, i, 0.0) != 0.0)
        parts_.file.fail(card, line.line, "gives stresses across the axis, which are not read", "give the axial stress alone");
    for (const long id : element_ids(card, line))
      for (fe::Element* e : pieces(id)) {
        if (e->type != fe::ElementType::beam && e->type != fe::ElementType::bar)
          parts_.file.fail(card, line.line,
                           fmt::format("gives element {} an initial stress, which is read for beams and trusses alone", id),
                           "load the model by forces, imposed movements or temperatures in a static step");
        e->free_strain -= stress / model_.materials[static_cast<std::size_t>(e->material)].youngs_modulus_Pa;
      }
  }

  void read_distributed(const InpCard& card, const InpLine& line) {
    parts_.file.allow(card, {"OP"});
    const std::string label = line.fields.size() > 1 ? upper_case(line.fields[1]) : "";
    if (label == "GRAV") return read_gravity(card, line);
    const double size = parts_.file.number(card, line, 2);
    for (const long id : element_ids(card, line)) {
      const InpElement& element = file_element(card, line, id);
      const InpKind kind = inp_kind(element.type);
      const bool global = label == "PX" || label == "PY" || label == "PZ";
      if ((kind == InpKind::beam || kind == InpKind::truss) && global) {
        const Eigen::Vector3d q = size * Eigen::Vector3d::Unit(label[1] - 'X');
        for (const fe::Element* piece : pieces(id))
          if (const std::string problem = add_line_load(model_, *piece, {q, q}); !problem.empty())
            parts_.file.fail(card, line.line, fmt::format("element {} {}", id, problem), "give forces at nodes by *CLOAD");
      } else if (kind == InpKind::shell && label == "P") {
        for (const fe::Element* piece : pieces(id)) add_pressure(model_, piece->nodes, -size);
      } else if (kind == InpKind::solid && label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '6') {
        press_solid(card, line, id, static_cast<std::size_t>(label[1] - '1'), size);
      } else {
        parts_.file.fail(card, line.line,
                         fmt::format("load {} on element {}, a {}, stiffens or softens the structure and is not read", label,
                                     id, element.type),
                         "read are GRAV; PX, PY, PZ on beams and trusses; P on shells; P1 to P6 on solids; write others as "
                         "forces of nodes by *CLOAD");
      }
    }
  }

  void press_solid(const InpCard& card, const InpLine& line, long id, std::size_t face, double size) {
    if (pieces(id).size() > 1)
      parts_.file.fail(card, line.line, fmt::format("presses element {}, which has nodes on its edges; that is not read", id),
                       "write the load as forces of nodes by *CLOAD");
    for (const fe::Element* piece : pieces(id)) {
      const auto& faces = solid_faces(piece->nodes.size());
      if (face >= faces.size())
        parts_.file.fail(card, line.line, fmt::format("element {} has no face {}", id, face + 1), "tetrahedra have four");
      std::vector<int> nodes;
      for (const std::size_t i : faces[face]) nodes.push_back(piece->nodes[i]);
      add_pressure(model_, nodes, size);
    }
  }

  void read_gravity(const InpCard& card, const InpLine& line) {
    const double size = parts_.file.number(card, line, 2);
    Eigen::Vector3d direction;
    for (int i = 0; i < 3; ++i) direction[i] = parts_.file.number_or(card, line, static_cast<std::size_t>(i) + 3, 0.0);
    if (!(direction.norm() > 0.0)) parts_.file.fail(card, line.line, "GRAV has no direction", "give its three components");
    const Eigen::Vector3d acceleration = size * direction.normalized();
    std::set<long> ids;
    if (!line.fields[0].empty())
      for (const long id : element_ids(card, line)) ids.insert(id);
    bool all = true, masses = false;
    for (const auto& [id, element] : parts_.elements) {
      const bool in = line.fields[0].empty() || ids.contains(id), is_mass = inp_kind(element.type) == InpKind::mass;
      all = all && (in || (position_.count(id) == 0 && !is_mass));
      masses = masses || (in && is_mass);
    }
    if (all) return add_gravity(model_, acceleration);
    if (masses)
      parts_.file.fail(card, line.line, "GRAV acts on point masses and on a part of the other elements, which is not read",
                       "let it act on all elements");
    for (const long id : ids)
      for (const fe::Element* piece : pieces(id)) {
        const fe::ElementMatrix mass = fe::element_mass(model_, *piece);
        Eigen::VectorXd fall = Eigen::VectorXd::Zero(std::ssize(mass.dofs));
        for (Eigen::Index i = 0; i < fall.size(); ++i)
          if (const int d = mass.dofs[static_cast<std::size_t>(i)] % 6; d < 3) fall[i] = acceleration[d];
        const Eigen::VectorXd force = mass.matrix * fall;
        for (Eigen::Index i = 0; i < fall.size(); ++i) {
          const int dof = mass.dofs[static_cast<std::size_t>(i)];
          add_load(model_, dof / 6, dof % 6, force[i]);
        }
      }
  }

  void read_surface_load(const InpCard& card, const InpLine& line) {
    parts_.file.allow(card, {"OP", "FOLLOWER", "CONSTANT RESULTANT"});
    const InpSurface& surface = parts_.surface(card, line.line, line.fields[0]);
    const std::string label = line.fields.size() > 1 ? upper_case(line.fields[1]) : "";
    const double size = parts_.file.number(card, line, 2);
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) direction[i] = parts_.file.number_or(card, line, static_cast<std::size_t>(i) + 3, 0.0);
    const bool traction = label == "TRVEC";
    if ((label != "P" && !traction) || surface.facets.empty() || surface.facets.front().nodes.size() < 3 ||
        (traction && !(direction.norm() > 0.0)))
      parts_.file.fail(
          card, line.line,
          fmt::format("load {} on surface '{}' stiffens or softens the structure and is not read", label, line.fields[0]),
          "read are P and TRVEC (with its direction) on faces; write others as forces of nodes by *CLOAD");
    for (const InpFacet& facet : surface.facets) {
      std::vector<int> nodes;
      for (const long id : facet.nodes) nodes.push_back(joined_node(card, line, id));
      if (traction) {
        add_traction(model_, nodes, direction.normalized(), size);
      } else {
        add_pressure(model_, nodes, size);
      }
    }
  }

  InpParts& parts_;
  fe::Model& model_;
  std::map<long, std::size_t> position_;  ///< of an element of the file in the model; its further pieces follow
  std::map<int, double> before_, now_;    ///< temperatures of nodes
};

}  // namespace

InpStage find_inp_stage(const InpFile& file, const InpPlan& plan) {
  InpStage stage;
  std::vector<InpReading> step;
  const InpCard* opened = nullptr;
  const InpCard* stressed = nullptr;
  bool perturbation = false, loaded = false, modal = false, is_static = false;
  const auto close = [&] {
    if (opened == nullptr) return;
    const bool general = is_static && !says_yes(*opened, "PERTURBATION");
    for (const InpReading& reading : step) {
      if (general) continue;
      if (load_keywords().contains(reading.card->keyword)) stage.unused.push_back(reading.card);
    }
    if (!general) return;
    stage.large = stage.large || says_yes(*opened, "NLGEOM");
    stage.cards.insert(stage.cards.end(), step.begin(), step.end());
  };
  for (const InpReading& reading : plan.readings) {
    const InpCard& card = *reading.card;
    if (card.keyword == "STEP") {
      close();
      step.clear();
      opened = &card;
      is_static = modal = false;
    }
    if (card.keyword == "STATIC") is_static = true;
    if (card.keyword == "FREQUENCY") modal = true, perturbation = opened != nullptr && says_yes(*opened, "PERTURBATION");
    if (card.keyword == "INITIAL CONDITIONS") {
      stage.initial.push_back(reading);
      const std::string type = upper_case(card.get("TYPE"));
      if (type == "STRESS") stressed = &card;
      if (type != "STRESS" && type != "TEMPERATURE")
        file.fail(card, card.line, fmt::format("TYPE={} is not read", type), "read are STRESS and TEMPERATURE");
    }
    const bool load = load_keywords().contains(card.keyword) || is_nonzero_boundary(card);
    if (opened == nullptr) {
      if (load_keywords().contains(card.keyword)) stage.unused.push_back(&card);
    } else if (load || card.keyword == "STEP" || card.keyword == "BOUNDARY") {
      step.push_back(reading);
    }
  }
  close();
  for (const InpReading& reading : stage.cards)
    loaded = loaded || load_keywords().contains(reading.card->keyword) || is_nonzero_boundary(*reading.card);
  const bool any_static = !stage.cards.empty();
  stage.asked = modal && any_static && (stage.large || perturbation) && (loaded || stressed != nullptr);
  if (stressed != nullptr && !stage.asked)
    file.fail(*stressed, stressed->line, "gives initial stresses, but no step takes them up",
              "write a static step with NLGEOM before the step with *FREQUENCY, or take the card out");
  if (!stage.asked) {
    for (const InpReading& reading : stage.cards)
      if (load_keywords().contains(reading.card->keyword)) stage.unused.push_back(reading.card);
    stage.cards.clear();
  }
  return stage;
}

void read_inp_expansion(InpParts& parts, const InpCard& card) {
  if (parts.model.materials.empty()) parts.file.fail(card, card.line, "stands before any *MATERIAL", "move it below one");
  const int material = static_cast<int>(parts.model.materials.size()) - 1;
  const std::string type = upper_case(card.get("TYPE", "ISO"));
  // What is not one number matters once a temperature acts, which is said there.
  if (card.data.size() == 1 && (type == "ISO" || type == "ISOTROPIC"))
    parts.expansion[material] = parts.file.number(card, card.data.front(), 0);
  else
    parts.uneven_expansion.emplace(material, &card);
}

void read_inp_stage(InpParts& parts, const InpStage& stage) {
  if (!stage.asked) return;
  open_stage(parts.model, stage.large);
  const std::vector<LoadLine> lines = lines_in_force(stage);
  const bool warmed =
      std::any_of(lines.begin(), lines.end(), [](const LoadLine& l) { return l.card->keyword == "TEMPERATURE"; });
  if (warmed && !parts.uneven_expansion.empty()) {
    const InpCard& card = *parts.uneven_expansion.begin()->second;
    parts.file.fail(card, card.line, "has several values or directions, which is not read where temperatures act",
                    "give one coefficient of expansion");
  }
  InpStageReader reader(parts);
  for (const InpReading& reading : stage.initial) reader.read_initial(reading);
  for (const LoadLine& line : lines) reader.read(line);
  reader.warm_elements();
  if (const std::string note = settle_displacements(parts.model); !note.empty()) parts.notes.push_back(note);
  parts.notes.push_back(
      fmt::format("the modes are those about the state under the loads of the static step{}: {} loads of nodes{}{}",
                  stage.large ? " (in the deformed geometry)" : "", parts.model.prestress.loads.size(),
                  parts.model.gravity_m_s2 > 0.0 ? ", gravity" : "",
                  warmed || !stage.initial.empty() ? ", temperatures or initial stresses" : ""));
}

}  // namespace twindeck::model_io
