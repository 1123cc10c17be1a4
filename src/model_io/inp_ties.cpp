#include "model_io/inp_ties.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
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
  for (const InpFacet& facet : surface.facets) {
    if (facet.turning) shells.insert(facet.element);
  }
  double most = 0.0;
  for (const fe::Element& e : parts.model.elements) {
    if (e.type == fe::ElementType::shell && shells.contains(e.id))
      most = std::max(most, 0.5 * parts.model.sections[static_cast<std::size_t>(e.section)].thickness_m);
  }
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
    if (std::find(facet->nodes.begin(), facet->nodes.end(), slave) != facet->nodes.end()) continue;  // one mesh already
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
    std::vector<Facet> facets;
    for (const InpFacet& facet : tie.master.facets) facets.push_back(make_facet(parts, line, facet));
    tie.tolerance = tolerance_of(parts, tie, facets);
    say_tied(parts, tie, tie_nodes(parts, tie, facets));
  }
}

}  // namespace twindeck::model_io
