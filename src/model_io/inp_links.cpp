#include "model_io/inp_links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace twindeck::model_io {
namespace {

/// Supports of slaves are handed to their masters where both lie at one place, or where all six directions are held.
void hold_masters(InpParts& parts) {
  std::map<int, int> master;
  for (const fe::RigidLink& link : parts.model.links) master.emplace(link.slave, link.master);
  auto& supports = parts.model.supports;
  bool moved = true;
  for (std::size_t round = 0; moved && round <= master.size(); ++round) {  // along chains of links
    moved = false;
    for (fe::Support& support : supports) {
      const auto found = master.find(support.node);
      if (found == master.end()) continue;
      const bool whole = std::all_of(support.fixed.begin(), support.fixed.end(), [](bool fixed) { return fixed; });
      const double apart = (parts.place(support.node) - parts.place(found->second)).norm();
      if (!whole && apart > 1e-9 * (1.0 + parts.place(support.node).norm())) continue;  // refused where links are joined
      support.node = found->second;
      moved = true;
    }
  }
  std::vector<fe::Support> merged;
  for (const fe::Support& support : supports) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const fe::Support& s) { return s.node == support.node; });
    if (same == merged.end())
      merged.push_back(support);
    else
      for (std::size_t d = 0; d < 6; ++d) same->fixed[d] = same->fixed[d] || support.fixed[d];
  }
  supports = std::move(merged);
}

/// TIE and PIN: two nodes at one place move alike, with or without their rotations.
void join_alike(InpParts& parts, const DeckPlace& at, const std::string& type, int slave, int master) {
  if (!parts.together(slave, master))
    at.fail(fmt::format("MPC {} joins two nodes that do not lie at one place, which is not supported", type),
            "use BEAM, a rigid link");
  if (type == "TIE") return parts.add_link(master, slave);
  for (int d = 0; d < 3; ++d) parts.add_constraint({parts.numbered("pin"), slave, d, {{master, d, 1.0}}}, at);
}

/// The range of degrees of freedom that two fields name, added to `chosen`; one alone is itself.
/// @param first_field all six where it is empty
void choose_range(const InpLine& line, std::size_t first_field, Directions& chosen) {
  const long first = line.integer_or(first_field, 1),
             last = line.integer_or(first_field + 1, line.blank(first_field) ? 6 : first);
  if (first < 1 || last > 6 || last < first)
    line.fail(fmt::format("'{}, {}' are no degrees of freedom", first, last),
              "1-3 displacements, 4-6 rotations; nothing for all");
  for (long dof = first; dof <= last; ++dof) chosen[static_cast<std::size_t>(dof) - 1] = true;
}

/// A slave that follows the reference node in some directions: a link where they are all that it has.
void follow(InpParts& parts, const DeckPlace& at, int master, long slave_id, const Directions& tied) {
  const int slave = parts.node(at, slave_id);
  if (slave == master) return;
  if (parts.is_whole(tied, slave)) return parts.add_link(master, slave);
  parts.refuse_turned(at);
  parts.tie_at_arm(
      at, [&](int) { return parts.numbered("coupling"); }, master, slave, tied);
}

}  // namespace

void read_inp_equation(InpParts& parts, const InpCard& card) {
  card.allow({});
  parts.refuse_turned(card);
  for (std::size_t row = 0; row < card.data.size();) {
    DeckEquation equation{card.data[row], {}};
    const long terms = card.data[row].integer(0);
    if (terms < 2 || terms > 1000)
      equation.at.fail(fmt::format("{} terms are no equation", terms),
                       "give their number, then node, degree of freedom, coefficient of each");
    ++row;
    std::size_t field = 0;
    while (static_cast<long>(equation.terms.size()) < terms) {
      if (row >= card.data.size())
        equation.at.fail(fmt::format("the equation ends after {} of {} terms", equation.terms.size(), terms), "complete it");
      const InpLine& line = card.data[row];
      const int node = parts.node(line, parts.node_id(line, field));
      equation.terms.push_back({node, line.component(field + 1), line.number(field + 2)});
      field += 3;
      if (field + 2 >= line.fields.size()) {
        ++row;
        field = 0;
      }
    }
    if (field != 0) ++row;
    parts.equations.push_back(equation);
  }
}

void attach_inp_equations(InpParts& parts) {
  std::map<long, std::vector<const DeckEquation*>> by_slave;
  for (const DeckEquation& equation : parts.equations)
    by_slave[parts.model.nodes[fe::slot(equation.terms[0].node)].id].push_back(&equation);
  for (const auto& [id, equations] : by_slave) {
    const int slave = equations.front()->terms[0].node, master = equations.front()->terms[1].node;
    if (parts.is_rigid_link(equations, master, slave)) {
      parts.add_link(master, slave);
      continue;
    }
    for (const DeckEquation* equation : equations) parts.follow_first(parts.numbered("equation"), *equation);
  }
}

void attach_inp_rigid_body(InpParts& parts, const InpCard& card) {
  card.allow({"REF NODE", "ROT NODE", "NSET", "TIE NSET", "ELSET"});
  if (!card.has("TIE NSET") && !card.has("ELSET")) (void)card.required("NSET");
  const int master = parts.reference_node(card);
  std::set<long> body;
  if (card.has("ELSET"))
    for (const long id : parts.set(parts.element_sets, card, card.get("ELSET")).members)
      if (const auto element = parts.elements.find(id); element != parts.elements.end())
        body.insert(element->second.nodes.begin(), element->second.nodes.end());
  for (const char* nodes : {"NSET", "TIE NSET"}) {
    if (!card.has(nodes)) continue;
    const auto& members = parts.set(parts.node_sets, card, card.get(nodes)).members;
    body.insert(members.begin(), members.end());
  }
  for (const long id : body) {
    if (const int slave = parts.node(card, id); slave != master) parts.add_link(master, slave);
  }
  if (!card.has("ROT NODE")) return;
  parts.refuse_turned(card);
  parts.turned_by[parts.named_node(card, "ROT NODE")] = {parts.model.nodes[fe::slot(master)].id, &card};
}

void attach_inp_mpc(InpParts& parts, const InpCard& card) {
  card.allow({});
  for (const InpLine& line : card.data) {
    const std::string type = line.fields.empty() ? "" : upper_case(line.fields[0]);
    if (type != "BEAM" && type != "TIE" && type != "PIN")
      line.fail(fmt::format("unsupported MPC type '{}'", type),
                "BEAM (a rigid link), TIE and PIN (two nodes at one place) are supported");
    const std::vector<long> slaves = parts.nodes_of(line, 1), masters = parts.nodes_of(line, 2);
    if (masters.size() != 1) line.fail("names more than one master", "BEAM, slave, master");
    const int master = parts.node(line, masters.front());
    for (const long id : slaves) {
      const int slave = parts.node(line, id);
      if (type == "BEAM")
        parts.add_link(master, slave);
      else
        join_alike(parts, line, type, slave, master);
    }
    if (type == "BEAM") parts.notes.push_back("*MPC of type BEAM is read as Abaqus means it: a rigid link");
  }
}

void attach_inp_coupling(InpParts& parts, const InpCard& card) {
  card.allow({"CONSTRAINT NAME", "REF NODE", "SURFACE"});
  const InpSurface& surface = parts.surface(card, card.required("SURFACE"));
  const int reference = parts.reference_node(card);
  const InpCard* kind = parts.card_after(card);
  if (kind == nullptr || (kind->keyword != "KINEMATIC" && kind->keyword != "DISTRIBUTING"))
    card.fail("is followed by neither *KINEMATIC nor *DISTRIBUTING", "say how the surface is coupled");
  Directions chosen{};
  for (const InpLine& line : kind->data) choose_range(line, 0, chosen);
  if (kind->data.empty()) chosen.fill(true);
  if (kind->keyword == "KINEMATIC") {
    kind->allow({});
    for (const long id : surface.nodes) follow(parts, card, reference, id, chosen);
    return;
  }
  kind->allow({"WEIGHTING METHOD", "COUPLING", "ROTATIONAL COUPLING"});
  const auto only = [&](const char* parameter, const char* word) {
    if (upper_case(kind->get(parameter, word)) != word)
      kind->fail(fmt::format("unsupported {}={}", parameter, kind->get(parameter)), fmt::format("{} is read", word));
  };
  only("WEIGHTING METHOD", "UNIFORM");
  only("COUPLING", "CONTINUUM");
  only("ROTATIONAL COUPLING", "CONTINUUM");
  // Displacements of the reference node are coupled whatever the data lines say, as in Abaqus.
  for (std::size_t d = 0; d < 3; ++d) chosen[d] = true;
  std::vector<DeckModel::Sample> samples;
  for (const long id : surface.nodes) {
    const int node = parts.node(card, id);
    if (node == reference) card.fail("the reference node lies on its own surface", "take a node beside the surface");
    for (int d = 0; d < 3; ++d) samples.push_back({node, Eigen::RowVector3d::Unit(d)});
  }
  parts.tie_to_mean(
      card, [&](int) { return parts.numbered("coupling"); }, reference, samples, chosen,
      "couple nodes that do not lie on one line, or name the degrees of freedom that are coupled");
  parts.notes.push_back(
      fmt::format("*DISTRIBUTING (line {}): every node of '{}' has the same weight", kind->line, surface.name));
}

void attach_inp_kinematic_coupling(InpParts& parts, const InpCard& card) {
  card.allow({"REF NODE"});
  const int reference = parts.reference_node(card);
  for (const InpLine& line : card.data) {
    Directions chosen{};
    choose_range(line, 1, chosen);
    for (const long id : parts.nodes_of(line, 0)) follow(parts, line, reference, id, chosen);
  }
}

void settle_inp_constraints(InpParts& parts) {
  hold_masters(parts);
  std::map<int, std::array<bool, 6>> held;
  for (const fe::Support& support : parts.model.supports) held[support.node] = support.fixed;
  const auto is_held = [&](int node, int direction) {
    const auto found = held.find(node);
    return found != held.end() && found->second[static_cast<std::size_t>(direction)];
  };
  std::vector<fe::Constraint> kept;
  std::vector<DeckPlace> origins;
  for (std::size_t i = 0; i < parts.model.constraints.size(); ++i) {
    const fe::Constraint& c = parts.model.constraints[i];
    const DeckPlace& at = parts.constraint_origin[i];
    if (!is_held(c.node, c.direction)) {
      kept.push_back(c);
      origins.push_back(at);
      continue;
    }
    const bool all_held = std::all_of(c.terms.begin(), c.terms.end(),
                                      [&](const fe::Constraint::Term& term) { return is_held(term.node, term.direction); });
    if (!all_held)
      at.fail(fmt::format("makes node {} follow others in degree of freedom {}, which *BOUNDARY holds",
                          parts.node_name(parts.model.nodes[static_cast<std::size_t>(c.node)].id), c.direction + 1),
              "take the node out of the support; what it follows may be held");
  }
  parts.model.constraints = std::move(kept);
  parts.constraint_origin = std::move(origins);
}

}  // namespace twindeck::model_io
