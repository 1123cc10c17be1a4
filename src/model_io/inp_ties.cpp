#include "model_io/inp_ties.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/lists.hpp"
#include "model_io/inp_surfaces.hpp"

namespace twindeck::model_io {
namespace {

constexpr double default_gap = 0.05;  ///< [-] of the size of a master facet, as in Abaqus

/// One data line of the card with what it needs.
struct Tie {
  const InpCard& card;
  const InpLine& line;
  std::string name;
  bool rotations;
  const InpSurface &slave, &master;
  double tolerance = 0.0;  ///< [m]
};

struct TieCount {
  std::size_t tied = 0, far = 0, earlier = 0, hinged = 0;
  double widest_m = 0.0;  ///< gap that is bridged
};

/// Half the greatest thickness of the shells of a surface.
double half_thickness(const InpParts& parts, const InpSurface& surface) {
  std::set<long> shells;
  for (const InpFacet& facet : surface.facets)
    if (facet.turning) shells.insert(facet.element);
  double most = 0.0;
  for (const fe::Element& e : parts.model.elements)
    if (e.type == fe::ElementType::shell && shells.contains(e.id))
      most = std::max(most, 0.5 * parts.model.sections[fe::slot(e.section)].thickness_m);
  return most;
}

double tolerance_of(const InpParts& parts, const Tie& tie, const std::vector<Facet>& facets) {
  if (tie.card.has("POSITION TOLERANCE")) {
    const double tolerance = tie.card.value("POSITION TOLERANCE").number(0);
    if (tolerance < 0.0) tie.card.fail("POSITION TOLERANCE is negative", "give a distance");
    return tolerance;
  }
  double size = 0.0;
  for (const Facet& facet : facets) size += facet.size_m() / static_cast<double>(facets.size());
  return default_gap * size + half_thickness(parts, tie.slave) + half_thickness(parts, tie.master);
}

/// Constraints of one slave node by the facet's nodes.
void tie_to_facet(InpParts& parts, const Tie& tie, int slave, const Facet& facet, const Foot& foot, bool with_rotations) {
  const Eigen::Vector3d gap = parts.place(slave) - facet.point(foot);
  const auto add = [&](int direction, std::vector<fe::Constraint::Term> terms) {
    constexpr double nothing = 1e-12;  ///< [-] shape functions at their nodes, rounded
    std::erase_if(terms, [](const fe::Constraint::Term& term) { return std::abs(term.factor) < nothing; });
    parts.add_constraint({tie.name, slave, direction, std::move(terms)}, tie.line);
  };
  const std::vector<Eigen::Matrix3d> of_nodes = facet.motion(foot, facet.turning ? Eigen::Vector3d::Zero() : gap);
  for (int d = 0; d < 3; ++d) {
    std::vector<fe::Constraint::Term> terms;
    for (std::size_t i = 0; i < of_nodes.size(); ++i) {
      for (int from = 0; from < 3; ++from) terms.push_back({facet.nodes[i], from, of_nodes[i](d, from)});
      // The arm of a shell turns with its nodes: theta × gap.
      for (int about = 0; about < 3 && facet.turning; ++about)
        terms.push_back({facet.nodes[i], 3 + about, foot.share[i] * Eigen::Vector3d::Unit(about).cross(gap)[d]});
    }
    add(d, terms);
  }
  for (int d = 3; d < 6 && with_rotations; ++d) {
    std::vector<fe::Constraint::Term> terms;
    for (std::size_t i = 0; i < facet.nodes.size(); ++i) terms.push_back({facet.nodes[i], d, foot.share[i]});
    add(d, terms);
  }
}

/// Nodes that follow others already: by links and equations, which a tie must not contradict, and by earlier ties.
struct Followers {
  std::set<int> linked, tied;
  explicit Followers(const InpParts& parts) {
    for (const fe::RigidLink& link : parts.model.links) linked.insert(link.slave);
    for (std::size_t i = 0; i < parts.model.constraints.size(); ++i)
      (parts.constraint_origin[i].label == "*TIE" ? tied : linked).insert(parts.model.constraints[i].node);
  }
};

TieCount tie_nodes(InpParts& parts, const Tie& tie, const std::vector<Facet>& facets) {
  const Followers followers(parts);
  TieCount count;
  for (const long id : tie.slave.nodes) {
    const int slave = parts.node(tie.line, id);
    const auto nearest = nearest_facet(facets, parts.place(slave), tie.tolerance);
    if (!nearest) {
      ++count.far;
      continue;
    }
    const auto& [facet, foot] = *nearest;
    if (contains(facet->nodes, slave)) continue;  // one mesh already
    if (followers.linked.contains(slave))
      tie.line.fail(fmt::format("slave node {} follows a link or an equation already", parts.node_name(id)),
                    "take the node out of the slave surface, or exchange slave and master");
    if (followers.tied.contains(slave)) {
      ++count.earlier;
      continue;
    }
    const bool turns = parts.turning.contains(slave);
    if (turns && !facet->turning) ++count.hinged;
    tie_to_facet(parts, tie, slave, *facet, foot, turns && facet->turning && tie.rotations);
    ++count.tied;
    count.widest_m = std::max(count.widest_m, foot.distance_m);
  }
  return count;
}

void say_tied(InpParts& parts, const Tie& tie, const TieCount& count) {
  if (count.tied == 0 && count.far > 0)
    tie.line.fail(fmt::format("no node of '{}' lies within {:.3g} of '{}'", tie.slave.name, tie.tolerance, tie.master.name),
                  "check the surfaces and the place of the instances, or give POSITION TOLERANCE");
  std::string said =
      fmt::format("tie '{}': {} nodes of '{}' follow the facets of '{}' by interpolation, over gaps of up to {:.3g}", tie.name,
                  count.tied, tie.slave.name, tie.master.name, count.widest_m);
  if (count.far > 0) said += fmt::format("; {} lie further than {:.3g} from it and stay free", count.far, tie.tolerance);
  if (count.earlier > 0) said += fmt::format("; {} are tied by an earlier card already", count.earlier);
  if (count.hinged > 0) said += fmt::format("; the rotations of {} stay free, since solids have none", count.hinged);
  parts.notes.push_back(said);
}

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
      const bool whole = std::ranges::all_of(support.fixed, [](bool fixed) { return fixed; });
      const double apart = (parts.place(support.node) - parts.place(found->second)).norm();
      if (!whole && apart > 1e-9 * (1.0 + parts.place(support.node).norm())) continue;  // refused where links are joined
      support.node = found->second;
      moved = true;
    }
  }
  std::vector<fe::Support> merged;
  for (const fe::Support& support : supports) {
    if (const auto same = std::ranges::find(merged, support.node, &fe::Support::node); same == merged.end())
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
  if (!parts.axes_of(at, slave_id).isIdentity(1e-9))
    at.fail(fmt::format("ties node {} along some of the axes of its *TRANSFORM, which is not read", parts.node_name(slave_id)),
            "tie all its degrees of freedom, or take it out of *TRANSFORM");
  parts.tie_at_arm(
      at, [&](int) { return parts.numbered("coupling"); }, master, slave, tied);
}

/// A term of an equation, along the axes of its node: one for each global direction, the largest first.
void add_terms(const InpParts& parts, const InpLine& line, std::size_t field, std::vector<fe::Constraint::Term>& terms) {
  constexpr double nothing = 1e-12;  // [-] of a direction: rounding
  const long id = parts.node_id(line, field);
  const int node = parts.node(line, id), direction = line.component(field + 1);
  const Eigen::RowVector3d along = line.number(field + 2) * parts.axes_of(line, id).row(direction % 3);
  std::array<int, 3> order = {0, 1, 2};
  std::ranges::stable_sort(order, [&](int a, int b) { return std::abs(along[a]) > std::abs(along[b]); });
  for (const int d : order)
    if (d == order[0] || std::abs(along[d]) > nothing * along.norm())
      terms.push_back({node, direction - direction % 3 + d, along[d]});
}

}  // namespace

void attach_inp_tie(InpParts& parts, const InpCard& card) {
  card.allow({"NAME", "ADJUST", "POSITION TOLERANCE", "TYPE", "NO ROTATION", "NO THICKNESS"});
  const std::string type = upper_case(card.get("TYPE", "SURFACE TO SURFACE"));
  if (type != "SURFACE TO SURFACE" && type != "NODE TO SURFACE")
    card.fail(fmt::format("unsupported TYPE={}", type), "SURFACE TO SURFACE or NODE TO SURFACE");
  if (card.data.empty()) card.fail("has no data line", "write slave, master");
  for (const InpLine& line : card.data) {
    Tie tie{card,
            line,
            card.get("NAME", fmt::format("tie_{}", card.line)),
            !card.has("NO ROTATION"),
            parts.surface(line, line.text(0)),
            parts.surface(line, line.text(1))};
    if (tie.master.facets.empty())
      line.fail(fmt::format("the master '{}' is a surface of nodes, which is not read", tie.master.name),
                "exchange slave and master, or name the faces of elements");
    const auto facets = each_of(tie.master.facets, [&](const InpFacet& facet) { return make_facet(parts, line, facet); });
    tie.tolerance = tolerance_of(parts, tie, facets);
    say_tied(parts, tie, tie_nodes(parts, tie, facets));
  }
}

void read_inp_equation(InpParts& parts, const InpCard& card) {
  card.allow({});
  for (std::size_t row = 0; row < card.data.size();) {
    DeckEquation equation{card.data[row], {}};
    const long terms = card.data[row].integer(0);
    if (terms < 2 || terms > 1000)
      equation.at.fail(fmt::format("{} terms are no equation", terms),
                       "give their number, then node, degree of freedom, coefficient of each");
    ++row;
    std::size_t field = 0;
    for (long count = 0; count < terms; ++count) {
      if (row >= card.data.size())
        equation.at.fail(fmt::format("the equation ends after {} of {} terms", count, terms), "complete it");
      const InpLine& line = card.data[row];
      add_terms(parts, line, field, equation.terms);
      field += 3;
      if (field + 2 < line.fields.size()) continue;
      ++row;
      field = 0;
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
  for (const long id : body)
    if (const int slave = parts.node(card, id); slave != master) parts.add_link(master, slave);
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
  std::map<int, Directions> held;
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
    const bool all_held =
        std::ranges::all_of(c.terms, [&](const fe::Constraint::Term& term) { return is_held(term.node, term.direction); });
    if (!all_held)
      at.fail(fmt::format("makes node {} follow others in degree of freedom {}, which *BOUNDARY holds",
                          parts.node_name(parts.model.nodes[fe::slot(c.node)].id), c.direction + 1),
              "take the node out of the support; what it follows may be held");
  }
  parts.model.constraints = std::move(kept);
  parts.constraint_origin = std::move(origins);
}

}  // namespace twindeck::model_io
