#include "diagnosis/extended_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;

const Place* place_of(const Places& places, const std::string& set, const std::string& id) {
  const auto found = places.sets.find(set);
  if (found == places.sets.end()) return nullptr;
  for (const Place& place : found->second)
    if (place.id == id) return &place;
  return nullptr;
}

/// Location "element:…": a zone, or a half of a zone or group.
const Place* element_place(const Places& places, const std::string& id) {
  if (!id.starts_with("element:")) return nullptr;
  for (const auto& [set, list] : places.sets)
    for (const Place& place : list)
      if (place.id == id) return &place;
  return nullptr;
}

int node_position(const fe::Model& model, const std::string& id) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (std::to_string(model.nodes[i].id) == id) return static_cast<int>(i);
  throw InputError({model.source, 0, id}, "is no node of the model", "");
}

void scale_materials(fe::Model& model, const std::vector<int>& elements, double modulus, double density,
                     const std::string& tag) {
  std::map<int, int> copies;
  for (const int e : elements) {
    fe::Element& element = model.elements[static_cast<std::size_t>(e)];
    const auto [at, is_new] = copies.try_emplace(element.material, static_cast<int>(model.materials.size()));
    if (is_new) {
      fe::Material material = model.materials[static_cast<std::size_t>(element.material)];
      for (fe::Parameter& parameter : model.parameters)  // they still scale the new material
        if ((parameter.target == fe::Target::youngs_modulus || parameter.target == fe::Target::density) &&
            contains(parameter.of, material.name))
          parameter.of.push_back(material.name + "_" + tag);
      material.name += "_" + tag;
      material.youngs_modulus_Pa *= modulus;
      material.shear_modulus_Pa *= modulus;
      material.density_kg_m3 *= density;
      model.materials.push_back(material);
    }
    element.material = at->second;
  }
}

/// @return the parameter of that name, null where there is none
const fe::Parameter* scale_parameter(std::vector<fe::Parameter>& parameters, Eigen::VectorXd& theta, const std::string& name,
                                     double factor) {
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (parameters[p].name != name) continue;
    double& value = theta[static_cast<Index>(p)];
    value = value != 0.0 && parameters[p].initial != 0.0 ? value * factor : value + factor - 1.0;
    parameters[p].lower = std::min(parameters[p].lower, value);
    parameters[p].upper = std::max(parameters[p].upper, value);
    return &parameters[p];
  }
  return nullptr;
}

/// Whether a parameter changes both stiffness and mass of a part.
bool has_stiffness_and_mass(fe::Target target) { return target == fe::Target::area || target == fe::Target::thickness; }

/// Elements and springs of some groups, "a" or "a,b".
void scale_groups(fe::Model& model, const std::string& names, double stiffness, double density, std::string tag) {
  const auto is_one = [listed = "," + names + ","](const std::string& group) {
    return !group.empty() && listed.find("," + group + ",") != std::string::npos;
  };
  std::vector<int> elements;
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    if (is_one(model.elements[e].group)) elements.push_back(static_cast<int>(e));
  std::replace(tag.begin(), tag.end(), ',', '+');  // it becomes part of a name in a table
  scale_materials(model, elements, stiffness, density, tag);
  for (fe::Spring& spring : model.springs)
    if (is_one(spring.group) && spring.node2 >= 0) spring.stiffness *= stiffness;
}

/// Whether a spring belongs to the support of a location: "pier", or "pier fixed" for its rigid part if springs have the name
/// too.
bool of_support(const fe::Model& model, const fe::Spring& spring, std::string name) {
  const auto group = [](const fe::Spring& s) { return s.group.empty() ? s.name : s.group; };
  const auto rigid = [](const fe::Spring& s) { return s.name.find(kRigidSpring) != std::string::npos; };
  static const std::string fixed = " fixed";
  const bool asked_rigid = name.ends_with(fixed);
  if (asked_rigid) name.resize(name.size() - fixed.size());
  if (name == one_bearing(model, spring)) return !spring.is_damper() && spring.node2 < 0 && !rigid(spring);
  if (spring.is_damper() || spring.node2 >= 0 || group(spring) != name || (asked_rigid && !rigid(spring))) return false;
  if (asked_rigid || !rigid(spring)) return true;
  return std::ranges::none_of(
      model.springs, [&](const fe::Spring& other) { return group(other) == name && other.node2 < 0 && !rigid(other); });
}

/// Moves the support to the node of its line nearest to a position.
void move_support(fe::Model& model, const Place& place, const std::string& name, double position) {
  const auto stations = static_cast<int>(place.attributes.at("stations"));
  int best = 0;
  for (int i = 1; i < stations; ++i) {
    const auto off = [&](int k) { return std::abs(place.attributes.at("x_" + std::to_string(k)) - position); };
    if (off(i) < off(best)) best = i;
  }
  const int node = static_cast<int>(place.attributes.at("node_" + std::to_string(best)));
  for (fe::Spring& spring : model.springs)
    if (of_support(model, spring, name) && !spring.rotation) spring.node = node;
}

/// Whether an action is vertical: it says so and the node can move vertically. Otherwise it acts in all directions.
bool is_vertical(const Candidate& candidate, const ActionSpec& action) {
  const auto named = action.text.find("direction");
  if (named == action.text.end() || named->second != "vertical") return false;
  const ReducedDirections& directions = candidate.places.front()->directions;
  return !(directions.cols() == 3 && directions.is_zero(2));
}

/// Springs along the global axes, or a vertical one alone. @param node2  -1: to the ground
void add_springs(fe::Model& model, const std::string& group, long id, int node, int node2, bool vertical, double stiffness) {
  for (int d = vertical ? 2 : 0; d < 3; ++d) {
    fe::Spring spring;
    spring.name = fmt::format("{}_{}_{}", group, id, "xyz"[d]);
    spring.group = group;
    spring.node = node;
    spring.node2 = node2;
    spring.direction = Eigen::Vector3d::Unit(d);
    spring.stiffness = stiffness;
    model.springs.push_back(spring);
  }
}

void add_prop(fe::Model& model, int node, bool vertical, double stiffness) {
  add_springs(model, "prop", model.nodes[static_cast<std::size_t>(node)].id, node, -1, vertical, stiffness);
}

/// A body on springs at a node: a new node that only translates, or only moves vertically.
void add_oscillator(fe::Model& model, int node, bool vertical, double mass, double frequency_Hz) {
  long id = 0;
  for (const fe::Node& n : model.nodes) id = std::max(id, n.id);
  model.nodes.push_back({id + 1, model.nodes[static_cast<std::size_t>(node)].x_m});
  const auto body = static_cast<int>(model.nodes.size()) - 1;
  model.supports.push_back({"oscillator_" + std::to_string(id + 1), body, {vertical, vertical, false, true, true, true}});
  model.masses.push_back({"oscillator", body, mass, Eigen::Vector3d::Zero()});
  add_springs(model, "oscillator", id + 1, body, node, vertical, mass * std::pow(2.0 * M_PI * frequency_Hz, 2));
}

/// A cause to be put into a finite element model, with the name of its location: "17" of "element:17".
struct Extension {
  fe::Model& model;
  Eigen::VectorXd& theta;
  const Places& places;
  const Cause& cause;
  std::string name;

  [[nodiscard]] double value(const ActionSpec& action, const char* of) const {
    return cause.candidate->value(action.number.at(of), cause.a);
  }
  /// The location among the places of the model.
  [[nodiscard]] const Place& place() const {
    const Place* found = place_of(places, cause.candidate->hypothesis->set, cause.candidate->location);
    TWINDECK_ASSERT(found != nullptr);
    return *found;
  }
};

/// Puts a factor on the stiffness or mass of a group, of elements or of a support.
bool apply_scale(Extension& to, const ActionSpec& action) {
  const Candidate& c = *to.cause.candidate;
  const bool mass = action.primitive == Primitive::scale_mass;
  const double factor = to.value(action, "factor");
  const std::string id = c.hypothesis->id + "_" + to.name;
  if (const Place* part = element_place(to.places, c.location); part != nullptr) {
    scale_materials(to.model, part->elements, mass ? 1.0 : factor, mass ? factor : 1.0, id);
    return true;
  }
  if (c.hypothesis->set == "groups") {
    if (const fe::Parameter* scaled = scale_parameter(to.model.parameters, to.theta, to.name, factor); scaled != nullptr)
      return !has_stiffness_and_mass(scaled->target);
    scale_groups(to.model, to.name, mass ? 1.0 : factor, mass ? factor : 1.0, id);
    return true;
  }
  if (c.hypothesis->set == "stays") {
    scale_materials(to.model, to.place().elements, mass ? 1.0 : factor, mass ? factor : 1.0, id);
    return true;
  }
  if (c.hypothesis->set == "supports" || c.hypothesis->set == "foundations") {
    for (fe::Spring& spring : to.model.springs)
      if (of_support(to.model, spring, to.name) && spring.rotation == (c.hypothesis->set == "foundations"))
        spring.stiffness *= factor;
    return true;
  }
  return false;
}

/// A spring between two nodes, "17,23", along their line. @return false if they stand in one place
bool add_tie(fe::Model& model, const std::string& name, double stiffness) {
  const auto comma = name.find(',');
  fe::Spring tie;
  tie.name = "tie_" + name.substr(0, comma) + "_" + name.substr(comma + 1);
  tie.group = "tie";
  tie.node = node_position(model, name.substr(0, comma));
  tie.node2 = node_position(model, name.substr(comma + 1));
  const Eigen::Vector3d along =
      model.nodes[static_cast<std::size_t>(tie.node2)].x_m - model.nodes[static_cast<std::size_t>(tie.node)].x_m;
  if (!(along.norm() > 0.0)) return false;
  tie.direction = along.normalized();
  tie.stiffness = stiffness;
  model.springs.push_back(tie);
  return true;
}

/// Removes parameters of springs that no longer exist: a model folder with them would be refused.
void drop_parameters_of_nothing(fe::Model& model, Eigen::VectorXd& theta) {
  const auto gone = [&](const std::string& group) {
    return std::ranges::none_of(model.springs, [&](const fe::Spring& s) { return s.group == group; });
  };
  std::vector<Index> kept;
  for (std::size_t p = 0; p < model.parameters.size(); ++p) {
    fe::Parameter& parameter = model.parameters[p];
    if (parameter.target == fe::Target::spring_stiffness) std::erase_if(parameter.of, gone);
    if (!parameter.of.empty()) kept.push_back(static_cast<Index>(p));
  }
  theta = Eigen::VectorXd(theta(kept));
  std::erase_if(model.parameters, [](const fe::Parameter& p) { return p.of.empty(); });
}

void apply_damper(Extension& to, const ActionSpec& action) {
  const auto acts_on = [&](const fe::Spring& s) { return ("," + to.name + ",").find("," + s.name + ",") != std::string::npos; };
  if (action.primitive == Primitive::damper_move) {
    const Place& place = to.place();
    const auto& places = to.cause.candidate->places;
    for (std::size_t i = 0; i + 1 < places.size(); ++i)
      for (fe::Spring& spring : to.model.springs)
        if ("damper:" + spring.name == places[i]->id)
          spring.node = static_cast<int>(place.attributes.at("node_" + std::to_string(i)));
    return;
  }
  if (action.primitive == Primitive::damper_absent) {
    std::erase_if(to.model.springs, acts_on);
    drop_parameters_of_nothing(to.model, to.theta);
    return;
  }
  for (fe::Spring& spring : to.model.springs) {
    if (!acts_on(spring)) continue;
    if (action.primitive == Primitive::damper_damping) spring.damping *= to.value(action, "factor");
    if (action.primitive == Primitive::damper_series || action.primitive == Primitive::damper_friction) {
      spring.stiffness = to.value(action, "stiffness");
      spring.series = true;
    }
    if (action.primitive == Primitive::damper_friction) spring.friction_N = to.value(action, "threshold");
  }
}

/// Puts one action into a finite element model. @return whether a model folder can represent it
bool apply(fe::Model& model, Eigen::VectorXd& theta, const Places& places, const Cause& cause, const ActionSpec& action) {
  const Candidate& c = *cause.candidate;
  Extension to{model, theta, places, cause, c.location.substr(c.location.find(':') + 1)};
  const Primitive does = action.primitive;
  if (does == Primitive::scale_stiffness || does == Primitive::scale_mass) return apply_scale(to, action);
  if (does == Primitive::element_spring && c.places.size() != 1)
    return c.hypothesis->set == "pairs(nodes)" && add_tie(model, to.name, to.value(action, "stiffness"));
  if (does == Primitive::support_move)
    move_support(model, to.place(), to.name, to.value(action, "position"));
  else if (does == Primitive::element_spring)
    add_prop(model, node_position(model, to.name), is_vertical(c, action), to.value(action, "stiffness"));
  else if (does == Primitive::mass_add)
    model.masses.push_back({"added_mass", node_position(model, to.name), to.value(action, "mass"), Eigen::Vector3d::Zero()});
  else if (does == Primitive::element_oscillator)
    add_oscillator(model, node_position(model, to.name), is_vertical(c, action), to.value(action, "mass"),
                   to.value(action, "frequency"));
  else if (acts_on(does) == ActsOn::damper)
    apply_damper(to, action);
  else
    return false;
  return true;
}

bool apply(fe::ParametricSystem& system, Eigen::VectorXd& theta, const Cause& cause, const ActionSpec& action) {
  const Candidate& c = *cause.candidate;
  const std::string name = c.location.substr(c.location.find(':') + 1);
  if ((action.primitive == Primitive::scale_stiffness || action.primitive == Primitive::scale_mass) &&
      c.hypothesis->set == "groups") {
    scale_parameter(system.parameters, theta, name, c.value(action.number.at("factor"), cause.a));
    return true;
  }
  const bool mass = action.primitive == Primitive::mass_add;
  if (!mass && !(action.primitive == Primitive::element_spring && c.places.size() == 1)) return false;
  const auto named = action.text.find("direction");
  const auto is_of_node = [&](const fe::DofLabel& dof) { return dof.node == name && dof.direction <= 2; };
  const bool upwards = named != action.text.end() && named->second == "vertical" &&
                       std::ranges::count_if(system.dofs, is_of_node) == 3;  // else in all directions
  fe::Term term;                                                             // on the diagonal, which is in every pattern
  term.label = c.id();
  for (std::size_t i = 0; i < system.dofs.size(); ++i) {
    if (!is_of_node(system.dofs[i]) || (upwards && system.dofs[i].direction != 2)) continue;
    for (int p = system.pattern.outerIndexPtr()[i]; p < system.pattern.outerIndexPtr()[i + 1]; ++p) {
      if (system.pattern.innerIndexPtr()[p] != static_cast<int>(i)) continue;
      term.position.push_back(p);
      term.value.push_back(c.value(action.number.at(mass ? "mass" : "stiffness"), cause.a));
    }
  }
  (mass ? system.mass_terms : system.stiffness_terms).push_back(term);
  return true;
}

bool is_of_a_parameter(const Cause& cause, const std::vector<fe::Parameter>& parameters) {
  const Candidate& c = *cause.candidate;
  return c.hypothesis->set == "groups" &&
         std::ranges::any_of(parameters, [&](const fe::Parameter& p) { return "group:" + p.name == c.location; });
}

}  // namespace

ExtendedModel extended_model(const DiagnosedModel& model, const Places& places, const Diagnosis& result) {
  ExtendedModel out;
  Eigen::VectorXd theta = result.after.base.theta.size() > 0 ? result.after.base.theta : model.loaded.theta;
  if (model.loaded.model)
    out.elements = fe::with_parameters(*model.loaded.model, theta);
  else
    out.system = model.loaded.system;
  out.holds.assign(result.effects.size(), true);
  // Causes on parameters come first, so that a part with a new material starts from their values.
  for (const bool of_parameters : {true, false}) {
    for (std::size_t i = 0; i < result.effects.size(); ++i) {
      const Cause& cause = result.effects[i].cause;
      if (is_of_a_parameter(cause, out.elements ? out.elements->parameters : out.system.parameters) != of_parameters) continue;
      for (const ActionSpec& action : cause.candidate->hypothesis->actions)
        out.holds[i] =
            (out.elements ? apply(*out.elements, theta, places, cause, action) : apply(out.system, theta, cause, action)) &&
            out.holds[i];
    }
    if (out.elements) out.elements = fe::with_parameters(*out.elements, theta);
  }
  if (out.elements) return out;
  for (std::size_t p = 0; p < out.system.parameters.size(); ++p) {
    fe::Parameter& parameter = out.system.parameters[p];
    fe::set_fitted(parameter, theta[static_cast<Index>(p)]);
    parameter.lower = std::min(parameter.lower, parameter.initial);
    parameter.upper = std::max(parameter.upper, parameter.initial);
  }
  return out;
}

CorrectedChannels corrected_channels(const std::vector<matching::Channel>& channels, const Diagnosis& result) {
  const auto each = [&](Primitive primitive, auto use) {
    for (const Effect& effect : result.effects)
      for (const ActionSpec& action : effect.cause.candidate->hypothesis->actions)
        if (action.primitive == primitive && !effect.cause.candidate->channels.empty()) use(effect.cause, action);
  };
  // Exchanges come first: a sign or a gain belongs to a channel by its recorded name.
  std::vector<std::size_t> stands(channels.size());  // (n_channels) channel that a recorded name really reads
  std::iota(stands.begin(), stands.end(), std::size_t{0});
  const auto place = [&](const Cause& cause, std::size_t which) -> std::size_t& {
    return stands[static_cast<std::size_t>(cause.candidate->channels[which])];
  };
  each(Primitive::channel_swap, [&](const Cause& cause, const ActionSpec&) { std::swap(place(cause, 0), place(cause, 1)); });
  CorrectedChannels out{channels, std::vector<double>(channels.size(), 1.0)};
  for (std::size_t c = 0; c < channels.size(); ++c) out.channels[stands[c]].name = channels[c].name;
  each(Primitive::channel_gain, [&](const Cause& cause, const ActionSpec& action) {
    out.gain[place(cause, 0)] /= cause.candidate->value(action.number.at("factor"), cause.a);
  });
  each(Primitive::channel_sign,
       [&](const Cause& cause, const ActionSpec&) { out.channels[place(cause, 0)].direction *= -1.0; });
  return out;
}

}  // namespace twindeck::diagnosis
