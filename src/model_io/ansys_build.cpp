#include "model_io/ansys_build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/lists.hpp"
#include "model_io/ansys_members.hpp"
#include "model_io/ansys_stage.hpp"
#include "model_io/ansys_supports.hpp"

namespace twindeck::model_io::ansys {
namespace {

constexpr double same_number = 1e-6;  ///< [-] moduli that are one number, printed by two programs
constexpr double follows = 1e-3;      ///< [-] of G against E and nu that are printed with three digits

bool alike(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)); }

void check_options(const Parts& parts, const TypeDefinition& definition) {
  for (const auto& [number, option] : definition.options) {
    const auto allowed = definition.type->options.find(number);
    const bool listed = allowed != definition.type->options.end();
    const bool read = listed && (allowed->second.empty() || contains(allowed->second, option.value));
    if (read || (!listed && option.value == 0)) continue;
    parts.at(option.line, "KEYOPT")
        .fail(fmt::format("KEYOPT({}) = {} of {} is not supported", number, option.value, definition.type->name),
              definition.type->kind == Kind::rigid ? "of MPC184, the rigid beam is read (KEYOPT(1) = 1)"
                                                   : "docs/import_ansys.md lists what is read");
  }
}

}  // namespace

Member checked_member(const Parts& parts, long id, const Element& element) {
  const DeckPlace at = parts.at(element.line, fmt::format("element {}", id));
  const auto found = parts.types.find(element.type);
  if (found == parts.types.end())
    at.fail(fmt::format("its type {} is not defined", element.type), "give the ET command of that type");
  const TypeDefinition& definition = found->second;
  if (definition.type == nullptr)
    at.fail(fmt::format("is of type {} (line {}), which is not supported", definition.name, definition.line),
            "supported are " + element_type_list());
  const ElementType& type = *definition.type;
  if (type.kind == Kind::layered)
    at.fail(fmt::format("is a {}, which is not supported", type.name), "mesh with homogeneous shells (SHELL181, SHELL281)");
  if (type.kind == Kind::load) return {id, element, definition};
  check_options(parts, definition);
  // Beams may have a node that only gives their direction.
  const std::size_t extra = type.name == "BEAM189" || type.name == "PIPE289" ? 2 : type.kind == Kind::beam ? 1 : 0;
  // Nodes on edges may be left out.
  const std::size_t count = element.nodes.size();
  const bool corners_only =
      (type.kind == Kind::shell && (count == 3 || count == 4)) || (type.kind == Kind::solid && count == 8 && type.nodes > 8);
  const bool too_few = count < type.nodes && !corners_only;
  if (too_few || count > type.nodes + extra)
    at.fail(fmt::format("has {} nodes, a {} has {}", count, type.name, type.nodes),
            too_few ? "complete the element" : "correct the list of nodes, or take an element type that has so many");
  return {id, element, definition};
}

void Builder::fail(const Member& member, const std::string& problem, const std::string& mend) const {
  parts.at(member.element.line, fmt::format("element {}", member.id)).fail(problem, mend);
}

void Builder::add_nodes() {
  std::map<long, long> used;  // node, the line that speaks of it
  for_each_member(parts, [&](const Member& m) {
    const Kind kind = m.type().kind;
    for (std::size_t i = 0; i < std::min(m.type().nodes, m.element.nodes.size()); ++i) {
      const long id = m.element.nodes[i];
      if (id == 0) continue;  // a node on an edge that is left out
      used.emplace(id, m.element.line);
      if (kind == Kind::plane_beam) in_plane.insert(id);
      if (kind == Kind::beam || kind == Kind::bar || kind == Kind::shell || kind == Kind::solid) in_space.insert(id);
    }
    if (const long middle = m.middle(); middle != 0) used.emplace(middle, m.element.line), in_space.insert(middle);
  });
  for (const Link& link : parts.links) used.emplace(link.master, link.line), used.emplace(link.slave, link.line);
  for (const Equation& equation : parts.equations)
    for (const Equation::Term& term : equation.terms) used.emplace(term.node, equation.at.line);
  for (const auto& [id, line] : used) {
    const auto found = parts.nodes.find(id);
    if (found == parts.nodes.end())
      parts.at(line, fmt::format("node {}", id)).fail("is used here and defined nowhere", "define it, or correct the number");
    parts.add_node(id, found->second.x_m);
  }
  if (const std::size_t left = parts.nodes.size() - used.size(); left > 0)
    parts.notes.push_back(fmt::format("{} nodes that no element holds are left out", left));
}

int Builder::material(const Member& member, long id, bool isotropic) {
  const auto known = parts.materials.find(id);
  const auto property = [&](const std::string& label, double fallback) {
    const auto found = known->second.find(label);
    return found == known->second.end() ? fallback : found->second.value;
  };
  if (known == parts.materials.end() || property("EX", 0.0) <= 0.0)
    fail(member, fmt::format("its material {} has no modulus above 0", id), "give MP,EX,number,value");
  fe::Material m{.name = fmt::format("mat_{}", id),
                 .youngs_modulus_Pa = property("EX", 0.0),
                 .poisson_ratio = property("PRXY", property("NUXY", 0.3))};
  const long line = known->second.at("EX").line;
  const double reference_K = parts.stage ? parts.stage->reference_K : 0.0;
  DeckModel::check_poisson_ratio(parts.at(line, m.name), m.poisson_ratio);
  const double follows_from_E = m.youngs_modulus_Pa / (2.0 * (1.0 + m.poisson_ratio));
  m.shear_modulus_Pa = property("GXY", follows_from_E);
  m.density_kg_m3 = property("DENS", 0.0);
  const std::vector<std::pair<std::string, double>> twins = {
      {"EY", m.youngs_modulus_Pa}, {"EZ", m.youngs_modulus_Pa}, {"PRYZ", m.poisson_ratio},   {"PRXZ", m.poisson_ratio},
      {"NUYZ", m.poisson_ratio},   {"NUXZ", m.poisson_ratio},   {"GYZ", m.shear_modulus_Pa}, {"GXZ", m.shear_modulus_Pa}};
  for (const auto& [label, twin] : twins)
    if (!alike(property(label, twin), twin, same_number))
      parts.at(known->second.at(label).line, m.name)
          .fail(fmt::format("{} makes it orthotropic, which is not supported", label),
                "give EX, PRXY and DENS of an isotropic material");
  if (isotropic && !alike(m.shear_modulus_Pa, follows_from_E, follows))
    parts.at(known->second.at("GXY").line, m.name)
        .fail(fmt::format("GXY = {:g} does not follow from EX and PRXY ({:g}), which only beams and bars may have",
                          m.shear_modulus_Pa, follows_from_E),
              "leave GXY out for an isotropic material");
  if (const auto made = materials_.find(id); made != materials_.end()) return made->second;
  if (!known->second.contains("PRXY") && !known->second.contains("NUXY"))
    parts.notes.push_back(fmt::format("material {} gives no Poisson's ratio: 0.3, as ANSYS takes it", id));
  const int position = materials_[id] = static_cast<int>(parts.model.materials.size());
  parts.model.materials.push_back(m);
  if (known->second.contains("ALPX")) parts.expansion[position] = {property("ALPX", 0.0), property("REFT", reference_K)};
  return position;
}

std::string Builder::group(const Member& member, const std::string& property) const {
  for (const Component& component : parts.components)
    if (!component.of_nodes && component.members.contains(member.id)) return component.name;
  return lower_case(member.type().name) + "_" + property;
}

const RealSet& Builder::reals(const Member& member) const {
  const auto found = parts.reals.find(member.element.real);
  if (found == parts.reals.end())
    fail(member, fmt::format("its set of real constants {} is not defined", member.element.real),
         "give R,number,constants (or the section of a newer element)");
  return found->second;
}

void build_model(Parts& parts) {
  Builder builder(parts);
  builder.add_nodes();
  if (!parts.elements.empty()) parts.last_element = parts.elements.rbegin()->first;
  for_each_member(parts, [&](const Member& m) {
    const Kind kind = m.type().kind;
    if (kind == Kind::mass) return;  // after the supports, which say which directions it moves in
    if (kind == Kind::spring) return add_spring(builder, m);
    if (kind == Kind::rigid) return parts.add_link(builder.node(m.element.nodes[0]), builder.node(m.element.nodes[1]));
    add_member(builder, m);
  });
  add_ties(builder);
  add_supports(builder);
  for_each_member(parts, [&](const Member& m) {
    if (m.type().kind == Kind::mass || m.type().name == "COMBIN40") add_masses(builder, m);
  });
  for (const Component& component : parts.components)
    if (component.of_nodes && component.members.size() == 1 && builder.has_node(*component.members.begin()))
      parts.model.monitoring_points.emplace(component.name, builder.node(*component.members.begin()));
  apply_stage(builder);
}

}  // namespace twindeck::model_io::ansys
