#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "diagnosis/reduction/composite_groups.hpp"
#include "diagnosis/reduction/place_parts.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::diagnosis {

namespace {

using Eigen::Index;

constexpr double kMostlyVertical = 0.7;  // [-] least vertical part of the direction of a vertical bearing

fe::ElementMatrix element_stiffness(const fe::Model& model, std::size_t e, const std::vector<std::uint8_t>& straight_sides) {
  const fe::Element& element = model.elements[e];
  switch (element.type) {
    case fe::ElementType::beam:
      return {fe::six_per_node(element),
              fe::beam_stiffness(fe::beam_geometry(model, element), fe::beam_properties(model, element))};
    case fe::ElementType::shell:
      return {fe::six_per_node(element),
              fe::shell_membrane_of(model, element, straight_sides[e]) + fe::shell_bending_of(model, element)};
    case fe::ElementType::solid:
      return {fe::three_per_node(element), fe::solid_stiffness_of(model, element)};
    default:
      return {fe::three_per_node(element),
              fe::bar_stiffness(fe::end_nodes(model, element), fe::material_of(model, element).youngs_modulus_Pa,
                                fe::section_of(model, element).area_m2)};
  }
}

/// Whether two symmetric matrices differ by a factor only, or are both zero.
bool alike(const Symmetric& a, const Symmetric& b) {
  if (a.size() == 0 || b.size() == 0) return a.nonZeros() == 0 && b.nonZeros() == 0;
  constexpr double kSame = 1e-9;
  return std::abs(a.cwiseProduct(b).sum()) > (1.0 - kSame) * a.norm() * b.norm();
}

}  // namespace

ElementPlaces::ElementPlaces(const Structure& structure)
    : structure_(structure),
      model_(*structure.model),
      straight_sides_(fe::sides_beside_four_nodes(model_)),
      expansion_(structure.system->expansion),
      laws_(structure) {
  for (std::size_t e = 0; e < model_.elements.size(); ++e) {
    const fe::Element& element = model_.elements[e];
    if (element.type == fe::ElementType::stay) continue;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int node : element.nodes) middle += model_.nodes[static_cast<std::size_t>(node)].x_m;
    candidates_.push_back(static_cast<int>(e));
    centroids_.push_back(middle / static_cast<double>(element.nodes.size()));
  }
  std::set<int> reached;
  for (const fe::Element& element : model_.elements) reached.insert(element.nodes.begin(), element.nodes.end());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> rows = expansion_;
  for (const int node : reached) {
    bool moves = false;
    for (int d = 0; d < 3; ++d) moves = moves || rows.row(6 * node + d).nonZeros() > 0;
    if (moves) nodes_.push_back(node);
  }
}

std::vector<Eigen::Vector3d> ElementPlaces::node_positions() const {
  return each_of(nodes_, [&](int node) { return model_.nodes[static_cast<std::size_t>(node)].x_m; });
}

std::vector<int> ElementPlaces::measured_nodes() const {
  const std::set<std::string> names(structure_.sensor_nodes.begin(), structure_.sensor_nodes.end());
  std::vector<int> measured;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (names.contains(std::to_string(model_.nodes[static_cast<std::size_t>(nodes_[i])].id)))
      measured.push_back(static_cast<int>(i));
  return measured;
}

void ElementPlaces::add_zones(const std::vector<int>& centres, Places& places, std::vector<Eigen::Vector3d> points) const {
  // If each element has a zone, an element is its own zone even if two have the same middle.
  const bool is_each = points.empty() && centres.size() == candidates_.size();
  if (is_each)
    points = centroids_;
  else if (points.empty())
    for (const int c : centres) points.push_back(centroids_[static_cast<std::size_t>(c)]);
  std::map<std::pair<std::size_t, std::string>, std::vector<std::size_t>> zones;  // positions of elements by centre and group
  std::vector<std::vector<int>> whole(points.size());                             // elements of each zone, of all groups
  std::vector<double> least(points.size(), std::numeric_limits<double>::infinity());
  const auto off = [&](std::size_t centre, std::size_t i) { return (centroids_[i] - points[centre]).squaredNorm(); };
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const std::size_t centre = is_each ? i : static_cast<std::size_t>(nearest(points, centroids_[i]));
    zones[{centre, model_.elements[static_cast<std::size_t>(candidates_[i])].group}].push_back(i);
    whole[centre].push_back(candidates_[i]);
    least[centre] = std::min(least[centre], off(centre, i));
  }
  for (std::size_t z = 0; z < whole.size(); ++z) {
    if (whole[z].empty()) continue;
    Place zone = part(whole[z]);
    zone.x_m = points[z];
    zone.id = "zone:" + std::to_string(model_.elements[static_cast<std::size_t>(whole[z].front())].id);
    places.sets["zones"].push_back(std::move(zone));
  }
  for (const auto& [key, members] : zones) {
    const std::size_t centre = key.first;
    const std::size_t middle = *std::min_element(members.begin(), members.end(),
                                                 [&](std::size_t i, std::size_t j) { return off(centre, i) < off(centre, j); });
    Place zone = part(each_of(members, [&](std::size_t i) { return candidates_[i]; }));
    if (off(centre, middle) <= least[centre]) zone.x_m = points[centre];
    zone.id = "element:" + std::to_string(model_.elements[static_cast<std::size_t>(candidates_[middle])].id);
    places.sets["elements"].push_back(std::move(zone));
  }
}

double ElementPlaces::pull_of(std::size_t e) const {
  return structure_.state != nullptr && structure_.state->stay_pull_N.size() > 0
             ? structure_.state->stay_pull_N[static_cast<Index>(e)]
             : model_.elements[e].pull_N;
}

fe::ElementMatrix ElementPlaces::stay_stiffness(std::size_t e, double pull) const {
  const fe::Element& element = model_.elements[e];
  const auto ends = fe::end_nodes(model_, element);
  const double area = fe::section_of(model_, element).area_m2;
  double modulus = fe::material_of(model_, element).youngs_modulus_Pa;
  if (pull > 0.0) {
    const double weight = fe::material_of(model_, element).density_kg_m3 * model_.gravity_m_s2;
    const Eigen::Vector3d chord = ends[1] - ends[0];
    modulus = fe::Dischinger{weight, chord.head<2>().norm(), pull / area}.modulus(modulus);
  }
  return {fe::three_per_node(element), fe::bar_stiffness(ends, modulus, area)};
}

void ElementPlaces::add_stays(Places& places) const {
  for (std::size_t e = 0; e < model_.elements.size(); ++e) {
    const fe::Element& element = model_.elements[e];
    if (element.type != fe::ElementType::stay) continue;
    const auto ends = fe::end_nodes(model_, element);
    const double length = (ends[1] - ends[0]).norm();
    const double area = fe::section_of(model_, element).area_m2;
    const double density = fe::material_of(model_, element).density_kg_m3;
    const double pull = pull_of(e);
    Sum stiffness{expansion_.rows(), {}}, mass{expansion_.rows(), {}};
    stiffness.add(stay_stiffness(e, pull));
    mass.add(fe::element_mass(model_, element));
    Place place{.id = "stay:" + (element.name.empty() ? std::to_string(element.id) : element.name),
                .x_m = 0.5 * (ends[0] + ends[1]),
                .stiffness = free(stiffness),
                .mass = free(mass),
                .elements = {static_cast<int>(e)},
                .stiffness_law = laws_.stiffness({static_cast<int>(e)}),
                .mass_law = laws_.mass({static_cast<int>(e)})};
    // The own mode of a cable moves its anchorages across the chord. Directions: the two transverse ones of the lower end.
    const int low = ends[0].z() <= ends[1].z() ? element.nodes[0] : element.nodes[1];
    const Eigen::Vector3d along = (ends[1] - ends[0]).normalized();
    const Eigen::Vector3d side =
        along.cross(std::abs(along.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX()).normalized();
    const Eigen::Vector3d up = side.cross(along);
    std::vector<Eigen::Triplet<double>> entries;
    for (int d = 0; d < 3; ++d) {
      entries.emplace_back(6 * low + d, 0, up[d]);
      entries.emplace_back(6 * low + d, 1, side[d]);
    }
    place.directions = free_directions(entries, 2);
    place.attributes["cable_mass"] = density * area * length;
    place.attributes["length"] = length;
    place.attributes["pull"] = pull;
    if (pull > 0.0) place.attributes["f_cable"] = std::sqrt(pull / (density * area)) / (2.0 * length);
    places.sets["stays"].push_back(std::move(place));
  }
}

Place ElementPlaces::damper_place(const fe::Spring& damper) const {
  fe::Spring unit = damper;
  unit.stiffness = 1.0;
  const fe::ElementMatrix k = fe::spring_stiffness(unit);
  // k = b b'. b is the column of k with the largest diagonal entry, divided by the root of that entry.
  Index largest = 0;
  k.matrix.diagonal().maxCoeff(&largest);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < k.dofs.size(); ++i)
    entries.emplace_back(k.dofs[i], 0, k.matrix(static_cast<Index>(i), largest) / std::sqrt(k.matrix(largest, largest)));
  Place place{"damper:" + damper.name, model_.nodes[static_cast<std::size_t>(damper.node)].x_m};
  place.directions = free_directions(entries, 1);
  place.attributes["damping"] = damper.damping;
  place.attributes["stiffness"] = damper.stiffness;
  place.attributes["series"] = damper.series ? 1.0 : 0.0;
  place.attributes["always_on"] = damper.active ? 1.0 : 0.0;
  if (damper.friction_N > 0.0) place.attributes["friction"] = damper.friction_N;
  place.stiffness_law.ratio = laws_.of_spring(damper);
  return place;
}

void ElementPlaces::add_dampers(Places& places) const {
  std::vector<std::string> types;  // dampers of one make have the same error
  for (const fe::Spring& spring : model_.springs) {
    if (!spring.is_damper()) continue;
    Place place = damper_place(spring);
    if (!spring.group.empty()) {
      const auto at = std::ranges::find(types, spring.group);
      place.attributes["type"] = static_cast<double>(at - types.begin());
      if (at == types.end()) types.push_back(spring.group);
    }
    places.sets["dampers"].push_back(std::move(place));
  }
  for (std::size_t type = 0; type < types.size(); ++type) {  // "dampers:C1,C2": all dampers of one make
    Place all{"dampers:", Eigen::Vector3d::Zero()};
    double members = 0.0;
    for (const Place& damper : places.sets["dampers"]) {
      const auto at = damper.attributes.find("type");
      if (at == damper.attributes.end() || at->second != static_cast<double>(type)) continue;
      all.id += (members > 0.0 ? "," : "") + damper.id.substr(damper.id.find(':') + 1);
      all.x_m += damper.x_m;
      members += 1.0;
    }
    if (members < 2.0) continue;
    all.x_m /= members;
    all.attributes["type"] = static_cast<double>(type);
    places.sets["damper_types"].push_back(std::move(all));
  }
}

void ElementPlaces::add_supports(Places& places) const {
  // A spring may have the name of a support that is fixed in other directions. The rigid directions then form a location of
  // their own.
  std::set<std::string> of_springs;
  for (const fe::Spring& spring : model_.springs)
    if (!spring.is_damper() && !stands_for_rigid(spring)) of_springs.insert(spring.support_name());
  struct Support {
    std::string name;
    Eigen::Vector3d x_m;
    bool rigid;
    std::array<Sum, 2> stiffness;  // of translations, of rotations
    fe::Coefficient ratio;         // of all its springs, which form one group or are one spring
  };
  std::vector<Support> supports;
  std::map<std::string, std::size_t> position;
  const auto add = [&](const std::string& name, const fe::Spring& spring, bool rigid) {
    const auto [at, is_new] = position.try_emplace(name, supports.size());
    if (is_new) {
      const Eigen::Vector3d& x_m = model_.nodes[static_cast<std::size_t>(spring.node)].x_m;
      supports.push_back({name, x_m, false, {Sum{expansion_.rows(), {}}, Sum{expansion_.rows(), {}}}, laws_.of_spring(spring)});
    }
    Support& support = supports[at->second];
    support.rigid = support.rigid || rigid;
    support.stiffness[spring.rotation ? 1 : 0].add(fe::spring_stiffness(spring));
  };
  const auto is_bearing = [](const fe::Spring& s) { return !s.is_damper() && fe::carries_stiffness(s) && s.node2 < 0; };
  std::map<std::string, std::set<int>> nodes;  // of a group: springs of one property may be bearings far from each other
  std::set<std::string> single;
  for (const fe::Spring& spring : model_.springs)
    if (is_bearing(spring)) nodes[spring.support_name()].insert(spring.node);
  for (const fe::Spring& spring : model_.springs) {
    if (!is_bearing(spring)) continue;
    const bool rigid = stands_for_rigid(spring);
    const std::string& name = spring.support_name();
    add(rigid && of_springs.contains(name) ? name + " fixed" : name, spring, rigid);
    if (rigid || nodes[name].size() < 2) continue;
    add(one_bearing(model_, spring), spring, false);
    single.insert(one_bearing(model_, spring));
  }
  for (const Support& support : supports) {
    for (const bool rotation : {false, true}) {
      const Sum& sum = support.stiffness[rotation ? 1 : 0];
      if (sum.entries.empty()) continue;
      Place place{"support:" + support.name, support.x_m, free(sum)};
      place.stiffness_law.ratio = support.ratio;
      // The factor on a spring that replaces a rigid support must fall by orders before anything moves. A bearing may be softer
      // or stiffer.
      place.attributes["f_low"] = support.rigid ? 1e-6 : 0.02;
      place.attributes["f_soft"] = support.rigid ? 2e-5 : 0.25;
      place.attributes["f_stiff"] = support.rigid ? 5e-4 : 4.0;
      place.attributes["f_high"] = support.rigid ? 1e-2 : 30.0;
      if (nodes.contains(support.name) && nodes[support.name].size() > 1) place.attributes[kSeveralBearings] = 1.0;
      if (single.contains(support.name)) place.attributes[kOneBearing] = 1.0;
      places.sets[rotation ? "foundations" : "supports"].push_back(std::move(place));
    }
  }
}

void ElementPlaces::add_moves(const std::vector<DamperMove>& moves, Places& places) const {
  const auto nodes = each_of(model_.nodes, &fe::Node::x_m);
  for (const DamperMove& move : moves) {
    Place place{"dampers:", Eigen::Vector3d::Zero()};
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < move.dampers.size(); ++i) {
      const auto spring = std::ranges::find_if(model_.springs, [&](const fe::Spring& s) { return s.name == move.dampers[i]; });
      TWINDECK_ASSERT(spring != model_.springs.end() && can_be_moved(*spring));
      const int node = nearest(nodes, move.x_m[i]);
      for (int d = 0; d < 3; ++d)
        if (spring->direction[d] != 0.0) entries.emplace_back(6 * node + d, static_cast<int>(i), spring->direction[d]);
      place.id += (i > 0 ? "," : "") + move.dampers[i];
      place.x_m += nodes[static_cast<std::size_t>(node)] / static_cast<double>(move.dampers.size());
      place.attributes["node_" + std::to_string(i)] = node;
    }
    place.id += "@" + move.name;
    place.directions = free_directions(entries, std::ssize(move.dampers));
    places.sets["damper_moves"].push_back(std::move(place));
  }
}

void ElementPlaces::add_nodes(const std::vector<int>& chosen, Places& places) const {
  for (const int c : chosen) {
    const int node = nodes_[static_cast<std::size_t>(c)];
    std::vector<Eigen::Triplet<double>> entries;
    for (int d = 0; d < 3; ++d) entries.emplace_back(6 * node + d, d, 1.0);
    const fe::Node& at = model_.nodes[static_cast<std::size_t>(node)];
    Place place{"node:" + std::to_string(at.id), at.x_m};
    place.directions = free_directions(entries, 3);
    const bool supported = std::ranges::any_of(model_.springs, [&](const fe::Spring& spring) {
      return spring.node == node && spring.node2 < 0 && !spring.rotation && !spring.is_damper() &&
             std::abs(spring.direction.normalized().z()) > kMostlyVertical && fe::carries_stiffness(spring);
    });
    if (supported) place.attributes["supported"] = 1.0;
    places.sets["nodes"].push_back(std::move(place));
  }
}

/// Elements, and springs between nodes, of one or several groups.
struct ElementPlaces::Group {
  ElementSum stiffness, mass;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  std::vector<int> elements;
  std::vector<const fe::Spring*> springs;
  void join(const Group& other) {
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(stiffness.entries, other.stiffness.entries);
    append(mass.entries, other.mass.entries);
    append(elements, other.elements);
    append(springs, other.springs);
    sum += other.sum;
    count += other.count;
  }
};

std::vector<std::pair<std::string, ElementPlaces::Group>> ElementPlaces::groups() const {
  std::vector<std::string> order;
  std::map<std::string, Group> groups;
  const auto group_of = [&](const std::string& name) -> Group& {
    const auto [at, is_new] = groups.try_emplace(name);
    if (is_new) {
      order.push_back(name);
      at->second.stiffness.size = at->second.mass.size = expansion_.rows();
    }
    return at->second;
  };
  for (std::size_t e = 0; e < model_.elements.size(); ++e) {
    const fe::Element& element = model_.elements[e];
    if (element.group.empty()) continue;
    Group& group = group_of(element.group);
    group.stiffness.add(element.type == fe::ElementType::stay ? stay_stiffness(e, pull_of(e))
                                                              : element_stiffness(model_, e, straight_sides_));
    group.mass.add(fe::element_mass(model_, element));
    group.elements.push_back(static_cast<int>(e));
    for (const int node : element.nodes) group.sum += model_.nodes[static_cast<std::size_t>(node)].x_m;
    group.count += static_cast<int>(element.nodes.size());
  }
  for (const fe::Spring& spring : model_.springs) {
    if (spring.node2 < 0 || spring.group.empty() || !fe::carries_stiffness(spring)) continue;
    Group& group = group_of(spring.group);
    group.stiffness.add(fe::spring_stiffness(spring));
    group.springs.push_back(&spring);
    group.sum += model_.nodes[static_cast<std::size_t>(spring.node)].x_m;
    ++group.count;
  }
  std::vector<std::pair<std::string, Group>> out;
  for (const std::string& name : order) out.emplace_back(name, std::move(groups.at(name)));
  return out;
}

void ElementPlaces::add_groups(Places& places) const {
  std::vector<Place>& set = places.sets["groups"];
  std::vector<std::pair<std::string, Symmetric>> of_parameters;
  for (const Place& place : set) of_parameters.emplace_back(place.id, place.stiffness.whole());
  const auto add = [&](const std::string& id, const Group& group) {
    Place place{id, group.sum / group.count, free(group.stiffness), {}, {}, {}, group.elements};
    if (!group.mass.entries.empty()) place.mass = free(group.mass);
    const Symmetric stiffness = place.stiffness.whole();
    const bool known = std::ranges::any_of(of_parameters, [&](const auto& other) {
      return other.first == id || (other.second.nonZeros() > 0 && alike(other.second, stiffness));
    });
    if (known || place.stiffness.nonZeros() == 0) return;
    place.stiffness_law = laws_.stiffness(group.elements, group.springs);
    place.mass_law = laws_.mass(group.elements);
    set.push_back(std::move(place));
  };
  std::vector<std::string> order;
  std::map<std::string, Group> found;
  for (auto& [name, group] : groups()) {
    add("group:" + name, group);
    order.push_back(name);
    found.emplace(name, std::move(group));
  }
  for (const std::vector<std::string>& names : composite_groups(order)) {
    Group together{{expansion_.rows(), {}}, {expansion_.rows(), {}}, Eigen::Vector3d::Zero(), 0, {}, {}};
    std::string id;
    for (const std::string& name : names) {
      together.join(found.at(name));
      id += (id.empty() ? "groups:" : ",") + name;
    }
    add(id, together);
  }
}

Place ElementPlaces::part(const std::vector<int>& elements) const {
  Sum stiffness{expansion_.rows(), {}}, mass{expansion_.rows(), {}};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const int e : elements) {
    const auto position = static_cast<std::size_t>(e);
    const fe::Element& element = model_.elements[position];
    stiffness.add(element.type == fe::ElementType::stay ? stay_stiffness(position, pull_of(position))
                                                        : element_stiffness(model_, position, straight_sides_));
    mass.add(fe::element_mass(model_, element));
    for (const int node : element.nodes) {
      sum += model_.nodes[static_cast<std::size_t>(node)].x_m;
      count += 1.0;
    }
  }
  return {"", sum / count, free(stiffness), free(mass), {}, {}, elements, laws_.stiffness(elements), laws_.mass(elements)};
}

bool ElementPlaces::stands_for_rigid(const fe::Spring& spring) const {
  const auto& rigid = structure_.rigid_supports;
  return spring.name.find(kRigidSpring) != std::string::npos && contains(rigid, spring.support_name());
}

void ElementPlaces::fill_global(Place& global) const {
  Sum stiffness{expansion_.rows(), {}}, mass{expansion_.rows(), {}};
  const bool shells =
      std::ranges::any_of(model_.elements, [](const fe::Element& e) { return e.type == fe::ElementType::shell; });
  double deck = 0.0;
  std::vector<int> of_deck;
  for (const int e : candidates_) {
    const fe::Element& element = model_.elements[static_cast<std::size_t>(e)];
    stiffness.add(element_stiffness(model_, static_cast<std::size_t>(e), straight_sides_));
    if (shells && element.type != fe::ElementType::shell) continue;
    const fe::ElementMatrix m = fe::element_mass(model_, element);
    mass.add(m);
    of_deck.push_back(e);
    const int per_node = static_cast<int>(m.dofs.size() / element.nodes.size());
    for (std::size_t i = 0; i < m.dofs.size(); i += static_cast<std::size_t>(per_node))
      for (std::size_t j = 0; j < m.dofs.size(); j += static_cast<std::size_t>(per_node))
        deck += m.matrix(static_cast<Index>(i), static_cast<Index>(j));
  }
  global.stiffness = free(stiffness);
  global.mass = free(mass);
  global.stiffness_law = laws_.stiffness(candidates_);
  global.mass_law = laws_.mass(of_deck);
  if (deck > 0.0) global.attributes["deck_mass"] = deck;
}

}  // namespace twindeck::diagnosis
