#include "model_io/inp_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/lists.hpp"
#include "model_io/deck_stage.hpp"

namespace twindeck::model_io {
namespace {

bool is_load(const InpCard& card) { return contains(std::array{"CLOAD", "DLOAD", "DSLOAD", "TEMPERATURE"}, card.keyword); }

bool is_nonzero_boundary(const InpCard& card) {
  return card.keyword == "BOUNDARY" && std::ranges::any_of(card.data, [](const InpLine& line) {
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
  double step_time = 0.0;  ///< period of its step
};

/// Lines in force at the end of the stage, and the whole time of its steps.
struct LoadsInForce {
  std::vector<LoadLine> lines;
  double time = 0.0;
};

LoadsInForce lines_in_force(const InpStage& stage) {
  LoadsInForce in_force;
  std::vector<LoadLine>& lines = in_force.lines;
  std::set<std::string> renewed;
  std::map<int, double> periods;
  int step = 0;
  for (const InpReading& reading : stage.cards) {
    const InpCard& card = *reading.card;
    if (card.keyword == "STEP") {
      ++step;
      renewed.clear();
      continue;
    }
    if (card.keyword == "STATIC") {
      periods[step] = card.data.empty() ? 1.0 : card.data.front().number_or(1, 1.0);
      in_force.time += periods[step];
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
  for (LoadLine& line : lines) line.step_time = periods[line.step];
  return in_force;
}

/// Factor of the *AMPLITUDE that a load names, where its static step ends (TIME=TOTAL TIME: the last one).
/// @throws InputError  for one that is not defined, or no table of factors
double amplitude_at_end(const InpFile& file, const LoadLine& load, double total_time) {
  if (!load.card->has("AMPLITUDE")) return 1.0;
  const std::string name = load.card->get("AMPLITUDE");
  const auto found = std::ranges::find_if(file.cards(), [&](const InpCard& card) {
    return card.keyword == "AMPLITUDE" && upper_case(card.get("NAME")) == upper_case(name);
  });
  if (found == file.cards().end())
    load.card->fail(fmt::format("amplitude '{}' is not defined", name), "define it by *AMPLITUDE");
  const std::string definition = upper_case(found->get("DEFINITION", "TABULAR")),
                    value = upper_case(found->get("VALUE", "RELATIVE"));
  if ((definition != "TABULAR" && definition != "SMOOTH STEP") || value != "RELATIVE")
    found->fail(fmt::format("gives '{}' as DEFINITION={}, VALUE={}, which scales the loads of modes and is not read", name,
                            definition, value),
                "give DEFINITION=TABULAR with VALUE=RELATIVE, or the load its size at the end of the step");
  std::vector<double> numbers;
  for (const InpLine& line : found->data)
    for (std::size_t i = 0; i < line.size(); ++i) numbers.push_back(line.number(i));
  if (numbers.empty() || numbers.size() % 2 == 1)
    found->fail("has no pairs of time and factor", "write time, factor, time, factor");
  const double time = upper_case(found->get("TIME", "STEP TIME")).starts_with("TOTAL") ? total_time : load.step_time;
  std::size_t after = 0;
  while (after < numbers.size() && numbers[after] < time) after += 2;
  if (after == 0 || after == numbers.size()) return after == 0 ? numbers[1] : numbers.back();
  const double share = (time - numbers[after - 2]) / (numbers[after] - numbers[after - 2]),
               grown = definition == "TABULAR" ? share : share * share * share * (10.0 + share * (6.0 * share - 15.0));
  return numbers[after - 1] + grown * (numbers[after + 1] - numbers[after - 1]);
}

constexpr const char* write_nodal_forces =
    "read are GRAV; PX, PY, PZ on beams and trusses; P on shells; P1 to P6 on solids; write others as forces of nodes by "
    "*CLOAD";

class InpStageReader {
 public:
  InpStageReader(InpParts& parts, bool large) : parts_(parts), stage_(parts, large, write_nodal_forces) {}

  /// @param factor  of its amplitude
  void read(const LoadLine& load, double factor) {
    parts_.scope = load.scope;
    factor_ = factor;
    const InpLine& line = *load.line;
    const std::string& keyword = load.card->keyword;
    load.card->allow(keyword == "DSLOAD" ? std::vector<std::string>{"OP", "AMPLITUDE", "FOLLOWER", "CONSTANT RESULTANT"}
                                         : std::vector<std::string>{"OP", "AMPLITUDE", keyword == "BOUNDARY" ? "TYPE" : "OP"});
    if (keyword == "CLOAD") return read_forces(line);
    if (keyword == "DLOAD") return read_distributed(line);
    if (keyword == "DSLOAD") return read_surface_load(line);
    if (keyword == "TEMPERATURE") return read_temperature(line, now_, factor_);
    if (keyword == "BOUNDARY") read_movement(line);
  }

  void read_initial(const InpReading& reading) {
    parts_.scope = reading.scope;
    reading.card->allow({"TYPE"});
    for (const InpLine& line : reading.card->data) {
      if (upper_case(reading.card->get("TYPE")) == "TEMPERATURE")
        read_temperature(line, before_, 1.0);
      else
        read_stress(line);
    }
  }

  void close(bool strained) {
    stage_.warm([&](const fe::Element&, long node, const Expansion&) {
      const auto before = before_.find(node), now = now_.find(node);
      const double from = before == before_.end() ? 0.0 : before->second;
      return now == now_.end() ? 0.0 : now->second - from;
    });
    stage_.close("the static step", strained);
  }

 private:
  void read_forces(const InpLine& line) {
    const int dof = line.component(1);
    const double size = factor_ * line.number_or(2, 0.0);
    for (const long id : parts_.nodes_of(line, 0)) {
      const auto [node, first] = parts_.moved_by(id);
      refuse_beyond_rotations(line, first, dof);
      const Eigen::Vector3d along = size * parts_.axes_of(line, id).row(dof % 3).transpose();
      const bool turns = first + dof > 2;
      stage_.load(stage_.node(line, node), turns ? Eigen::Vector3d::Zero() : along, turns ? along : Eigen::Vector3d::Zero());
    }
  }

  /// A ROT NODE, whose displacements are rotations of a body, has three degrees of freedom. @param first of moved_by
  static void refuse_beyond_rotations(const InpLine& line, int first, int dof) {
    if (first != 0 && dof > 2)
      line.fail(fmt::format("uses degree of freedom {} of a ROT NODE, which has 1 to 3", dof + 1),
                "write 1 to 3: they are the rotations of the body");
  }

  void read_movement(const InpLine& line) {
    if (line.fields.size() < 4) return;
    const double size = factor_ * line.number_or(3, 0.0);
    const int first = line.component(1), last = line.blank(2) ? first : line.component(2);
    for (const long id : parts_.nodes_of(line, 0)) {
      const auto [node, from] = parts_.moved_by(id);
      if (size != 0.0) refuse_beyond_rotations(line, from, last);
      const Eigen::Matrix3d axes = parts_.axes_of(line, id, size == 0.0);
      for (int dof = first; dof <= last && from + dof < 6; ++dof)
        stage_.move(line, stage_.node(line, node), from + dof, size, axes);
    }
  }

  void read_temperature(const InpLine& line, std::map<long, double>& of, double factor) {
    const double kelvin = factor * line.number(1);
    for (const long id : parts_.nodes_of(line, 0)) of[id] = kelvin;
  }

  void read_stress(const InpLine& line) {
    for (std::size_t i = 2; i < line.fields.size(); ++i)
      if (line.number_or(i, 0.0) != 0.0)
        line.fail("gives stresses across the axis, which are not read", "give the axial stress alone");
    for (const long id : parts_.elements_at(line)) stage_.strain(line, id, line.number(1), true);
  }

  void read_distributed(const InpLine& line) {
    const std::string label = line.word(1);
    if (label == "GRAV") return read_gravity(line);
    const double size = factor_ * line.number(2);
    for (const long id : parts_.elements_at(line)) {
      if (!parts_.elements.contains(id)) line.fail(fmt::format("element {} is not defined by any *ELEMENT", id), "define it");
      if (label == "PX" || label == "PY" || label == "PZ") {
        const Eigen::Vector3d q = size * Eigen::Vector3d::Unit(label[1] - 'X');
        stage_.load_line(line, id, [&](const fe::Element&) { return LineLoad{q, q}; });
      } else if (label == "P") {
        stage_.press_shell(line, id, size);
      } else if (label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '6') {
        stage_.press_solid(line, id, static_cast<std::size_t>(label[1] - '1'), size);
      } else {
        stage_.refuse(line, id, "load " + label);
      }
    }
  }

  void read_gravity(const InpLine& line) {
    const double size = factor_ * line.number(2);
    const Eigen::Vector3d direction = line.vector(3);
    if (!(direction.norm() > 0.0)) line.fail("GRAV has no direction", "give its three components");
    const Eigen::Vector3d acceleration = size * direction.normalized();
    std::set<long> ids;
    if (!line.blank(0))
      for (const long id : parts_.elements_at(line)) ids.insert(id);
    const bool all = line.blank(0) || std::ranges::all_of(parts_.elements, [&](const auto& element) {
                       const auto& [id, of] = element;
                       return ids.contains(id) || (stage_.pieces(id).empty() && inp_kind(of.type) != InpKind::mass);
                     });
    if (all) return stage_.accelerate(acceleration);
    for (const long id : ids) {
      stage_.accelerate(id, acceleration);
      if (const auto mass = parts_.point_mass_kg.find(id); mass != parts_.point_mass_kg.end())
        stage_.load(stage_.node(line, parts_.elements.at(id).nodes[0]), mass->second * acceleration);
    }
  }

  void read_surface_load(const InpLine& line) {
    const InpSurface& surface = parts_.surface(line, line.fields[0]);
    const std::string label = line.word(1);
    const double size = factor_ * line.number(2);
    const Eigen::Vector3d direction = line.vector(3);
    const bool traction = label == "TRVEC";
    if ((label != "P" && !traction) || surface.facets.empty() || surface.facets.front().nodes.size() < 3 ||
        (traction && !(direction.norm() > 0.0)))
      line.fail(fmt::format("load {} on surface '{}' stiffens or softens the structure and is not read", label, line.fields[0]),
                "read are P and TRVEC (with its direction) on faces; write others as forces of nodes by *CLOAD");
    for (const InpFacet& facet : surface.facets) {
      const auto nodes = each_of(facet.nodes, [&](long id) { return stage_.node(line, id); });
      if (traction)
        stage_.draw(nodes, direction.normalized(), size);
      else
        stage_.press(nodes, size);
    }
  }

  InpParts& parts_;
  DeckStage stage_;
  double factor_ = 1.0;
  std::map<long, double> before_, now_;  ///< temperatures of nodes
};

std::string note_of_rule(const std::string& sign_of_abaqus) {
  return sign_of_abaqus.empty()
             ? "the static loads act on the modes of *STEP, PERTURBATION as in CalculiX; in Abaqus they would act only after a "
               "static step with NLGEOM"
             : fmt::format(
                   "the static loads do not act on the modes of *STEP, PERTURBATION, as in Abaqus without NLGEOM in a static "
                   "step ({}); in CalculiX they would act",
                   sign_of_abaqus);
}

}  // namespace

InpStage find_inp_stage(const InpFile& file, const InpPlan& plan) {
  InpStage stage;
  std::vector<InpReading> step;
  const InpCard* opened = nullptr;
  const InpCard* stressed = nullptr;
  bool perturbation = false, loaded = false, modal = false, is_static = false;
  const auto leave = [&](const std::vector<InpReading>& readings) {
    for (const InpReading& reading : readings)
      if (is_load(*reading.card)) stage.unused.push_back(reading.card);
  };
  const auto close = [&] {
    if (opened == nullptr) return;
    if (!is_static || says_yes(*opened, "PERTURBATION")) return leave(step);
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
    if (card.keyword == "RESTART" && card.has("READ"))
      card.fail("starts from the state of another run, READ, whose loads are not in the deck",
                "write the steps of that run into the deck, or take the card out for modes of the unloaded structure");
    if (card.keyword == "INITIAL CONDITIONS") {
      stage.initial.push_back(reading);
      const std::string type = upper_case(card.get("TYPE"));
      if (type == "STRESS") stressed = &card;
      if (type != "STRESS" && type != "TEMPERATURE")
        card.fail(fmt::format("TYPE={} is not read", type), "read are STRESS and TEMPERATURE");
    }
    const bool load = is_load(card) || is_nonzero_boundary(card);
    if (opened == nullptr) {
      leave({reading});
    } else if (load || card.keyword == "STEP" || card.keyword == "BOUNDARY" || card.keyword == "STATIC") {
      step.push_back(reading);
    }
  }
  close();
  for (const InpReading& reading : stage.cards) loaded = loaded || is_load(*reading.card) || is_nonzero_boundary(*reading.card);
  const bool any_static = !stage.cards.empty();
  const std::string abaqus = file.sign_of_abaqus();
  const bool acts = modal && any_static && (loaded || stressed != nullptr);
  stage.asked = acts && (stage.large || (perturbation && abaqus.empty()));
  if (acts && perturbation && !stage.large) stage.note = note_of_rule(abaqus);
  if (stressed != nullptr && !stage.asked)
    stressed->fail("gives initial stresses, but no step takes them up",
                   "write a static step with NLGEOM before the step with *FREQUENCY, or take the card out");
  if (!stage.asked) {
    leave(stage.cards);
    stage.cards.clear();
  }
  return stage;
}

void read_inp_stage(InpParts& parts, const InpStage& stage) {
  if (!stage.asked) return;
  const auto [lines, time] = lines_in_force(stage);
  const bool warmed = std::ranges::any_of(lines, [](const LoadLine& l) { return l.card->keyword == "TEMPERATURE"; });
  if (warmed && !parts.uneven_expansion.empty())
    parts.uneven_expansion.begin()->second->fail("has several values or directions, which is not read where temperatures act",
                                                 "give one coefficient of expansion");
  InpStageReader reader(parts, stage.large);
  for (const InpReading& reading : stage.initial) reader.read_initial(reading);
  for (const LoadLine& line : lines) reader.read(line, amplitude_at_end(parts.file, line, time));
  reader.close(warmed || !stage.initial.empty());
}

}  // namespace twindeck::model_io
