#include "aero/aero_nodes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::aero {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// A line of nodes across a deck.
struct CrossSection {
  int edge_a = -1, edge_b = -1;
  std::vector<int> nodes;
  Eigen::Vector3d centre, across;  // middle of the edges; from edge a to edge b
  double station = 0.0;
};

const Eigen::Vector3d& position(const fe::Model& model, int node) { return model.nodes[static_cast<std::size_t>(node)].x_m; }

// Elements that share nodes form one line across the deck. Its edges are the two nodes that belong to a single element.
std::vector<CrossSection> cross_sections(const fe::Model& model, const std::string& group) {
  std::map<int, std::vector<int>> neighbours;
  for (const fe::Element& e : model.elements) {
    if (e.group != group || e.nodes.size() != 2) continue;
    neighbours[e.nodes[0]].push_back(e.nodes[1]);
    neighbours[e.nodes[1]].push_back(e.nodes[0]);
  }
  std::vector<CrossSection> lines;
  std::set<int> done;
  for (const auto& [start, linked] : neighbours) {
    if (linked.size() != 1 || done.contains(start)) continue;
    CrossSection line;
    for (int node = start, before = -1; node >= 0;) {
      line.nodes.push_back(node);
      done.insert(node);
      int next = -1;
      for (const int other : neighbours[node]) next = other != before && !done.contains(other) ? other : next;
      before = node;
      node = next;
    }
    line.edge_a = line.nodes.front();
    line.edge_b = line.nodes.back();
    line.across = position(model, line.edge_b) - position(model, line.edge_a);
    line.centre = 0.5 * (position(model, line.edge_a) + position(model, line.edge_b));
    lines.push_back(line);
  }
  return lines;
}

// Sorts the sections along the chord between the two sections farthest apart. A deck that is an arc of less than half a circle
// advances monotonically along this chord.
void order(std::vector<CrossSection>& lines) {
  Eigen::Vector3d chord = Eigen::Vector3d::Zero();
  for (const CrossSection& a : lines)
    for (const CrossSection& b : lines)
      if ((b.centre - a.centre).norm() > chord.norm()) chord = b.centre - a.centre;
  // From south to north (or west to east), whatever the numbering.
  if (chord.x() < 0.0 || (chord.x() == 0.0 && chord.y() < 0.0)) chord = -chord;
  std::ranges::sort(lines,
                    [&](const CrossSection& a, const CrossSection& b) { return a.centre.dot(chord) < b.centre.dot(chord); });
  for (std::size_t i = 1; i < lines.size(); ++i) {
    lines[i].station = lines[i - 1].station + (lines[i].centre - lines[i - 1].centre).norm();
    if (lines[i].across.dot(lines[i - 1].across) < 0.0) {
      std::swap(lines[i].edge_a, lines[i].edge_b);
      lines[i].across = -lines[i].across;
    }
  }
}

// Stations of the outermost stay anchorages; the whole deck if there are none.
std::pair<double, double> between_end_stays(const fe::Model& model, const std::vector<CrossSection>& lines) {
  std::map<int, int> carrier;
  for (const fe::RigidLink& link : model.links) carrier[link.slave] = link.master;
  std::map<int, double> station;
  for (const CrossSection& line : lines)
    for (const int node : line.nodes) station[node] = line.station;
  double first = lines.back().station, last = lines.front().station;
  for (const fe::Element& e : model.elements) {
    if (e.type != fe::ElementType::stay) continue;
    for (int node : e.nodes) {
      if (const auto link = carrier.find(node); link != carrier.end()) node = link->second;
      if (const auto found = station.find(node); found != station.end()) {
        first = std::min(first, found->second);
        last = std::max(last, found->second);
      }
    }
  }
  return first < last ? std::pair{first, last} : std::pair{lines.front().station, lines.back().station};
}

// Direction of the deck at a section: horizontal, across its edges.
Eigen::Vector3d tangent_at(const CrossSection& line, const Eigen::Vector3d& along) {
  Eigen::Vector3d t = Eigen::Vector3d::UnitZ().cross(line.across);
  t.z() = 0.0;
  t.normalize();
  return t.dot(along) < 0.0 ? Eigen::Vector3d(-t) : t;
}

void add_interpolated(const fe::Model& model, const std::string& deck, std::vector<CrossSection>& lines, int count,
                      AeroNodes& out, Triplets& entries) {
  const auto [first, last] = between_end_stays(model, lines);
  const double length = (last - first) / count;
  std::size_t k = 0;
  for (int i = 0; i < count; ++i) {
    const double s = first + (i + 0.5) * length;
    while (k + 2 < lines.size() && lines[k + 1].station < s) ++k;
    const CrossSection &a = lines[k], &b = lines[k + 1];
    const double span = b.station - a.station, t = (s - a.station) / span;
    const Eigen::Vector3d along = b.centre - a.centre;
    AeroNode node{.deck = deck,
                  .station_m = s - 0.5 * (first + last),
                  .length_m = length,
                  .x_m = a.centre + t * along,
                  .tangent = ((1.0 - t) * tangent_at(a, along) + t * tangent_at(b, along)).normalized()};

    const int row = 6 * static_cast<int>(out.nodes.size());
    const auto put = [&](int r, int at, int direction, double value) {
      entries.emplace_back(row + r, 6 * at + direction, value);
    };
    // A rotation w raises the end of a line d over its start by (w × d)_z. Two lines give its horizontal components: the one
    // across the deck and the one from centre to centre. They need not be perpendicular, as they are not on a curved deck.
    const Eigen::Vector3d across = (1.0 - t) * a.across + t * b.across;
    const double area = across.cross(along).z();
    for (const auto& [line, weight, end] : {std::tuple{&a, 1.0 - t, -1.0}, std::tuple{&b, t, 1.0}}) {
      for (int d = 0; d < 3; ++d) {
        put(d, line->edge_a, d, 0.5 * weight);
        put(d, line->edge_b, d, 0.5 * weight);
      }
      for (int d = 0; d < 2; ++d) {
        put(3 + d, line->edge_b, 2, (0.5 * end * across(d) - weight * along(d)) / area);
        put(3 + d, line->edge_a, 2, (0.5 * end * across(d) + weight * along(d)) / area);
      }
    }
    out.nodes.push_back(node);
  }
}

// Points aero_<deck>_<number>, sorted by their number as a number: 2 comes before 10. Points of a deck whose name only begins
// with this deck's name are left out.
std::vector<int> named_nodes(const fe::Model& model, const std::string& deck) {
  const std::string prefix = "aero_" + deck + "_";
  std::map<long, std::pair<std::string, int>> found;
  for (const auto& [name, node] : model.monitoring_points) {
    if (!name.starts_with(prefix)) continue;
    long number = 0;
    const char *first = name.data() + prefix.size(), *last = name.data() + name.size();
    if (first == last || !std::all_of(first, last, [](unsigned char c) { return std::isdigit(c) != 0; })) continue;
    if (std::from_chars(first, last, number).ec != std::errc()) continue;
    if (const auto [other, is_new] = found.emplace(number, std::pair{name, node}); !is_new)
      throw InputError({model.source, 0, name}, "has the number of the point " + other->second.first,
                       "number the points of a deck from one end to the other");
  }
  return each_of(found, [](const auto& point) { return point.second.second; });
}

void add_named(const fe::Model& model, const std::string& deck, std::vector<int> named, AeroNodes& out, Triplets& entries) {
  if (position(model, named.front()).x() > position(model, named.back()).x()) std::ranges::reverse(named);
  std::vector<double> station(named.size(), 0.0);
  for (std::size_t i = 1; i < named.size(); ++i)
    station[i] = station[i - 1] + (position(model, named[i]) - position(model, named[i - 1])).norm();
  for (std::size_t i = 0; i < named.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, named.size() - 1);
    AeroNode node{.deck = deck, .station_m = station[i] - 0.5 * station.back()};
    // The length reaches half way to each neighbour. An outermost node has twice its one half: it stands in the middle too.
    node.length_m = (before == i || after == i ? 1.0 : 0.5) * (station[after] - station[before]);
    node.x_m = position(model, named[i]);
    // The tangent of the circle through three neighbours, at the middle one. At an end: the tangent of the neighbour,
    // mirrored in the chord.
    Eigen::Vector3d along = position(model, named[after]) - position(model, named[before]);
    if (i > 0 && i + 1 < named.size()) {
      const Eigen::Vector3d u = node.x_m - position(model, named[before]), v = position(model, named[after]) - node.x_m;
      along = u / u.squaredNorm() + v / v.squaredNorm();
    } else if (named.size() > 2) {
      const std::size_t middle = i == 0 ? 1 : i - 1, far = i == 0 ? 2 : i - 2;
      const Eigen::Vector3d u = position(model, named[middle]) - node.x_m,
                            v = position(model, named[far]) - position(model, named[middle]);
      const Eigen::Vector3d at_middle = (u / u.squaredNorm() + v / v.squaredNorm()).normalized(), chord = u.normalized();
      along = (i == 0 ? 1.0 : -1.0) * (2.0 * at_middle.dot(chord) * chord - at_middle);
    }
    along.z() = 0.0;
    node.tangent = along.normalized();
    for (int d = 0; d < 6; ++d) entries.emplace_back(6 * static_cast<int>(out.nodes.size()) + d, 6 * named[i] + d, 1.0);
    out.nodes.push_back(node);
  }
}

}  // namespace

AeroNodes find_aero_nodes(const fe::Model& model, const std::vector<std::string>& decks,
                          const std::vector<std::string>& cross_groups, int per_deck) {
  TWINDECK_ASSERT(decks.size() == cross_groups.size() && per_deck > 0);
  AeroNodes out;
  Triplets entries;
  for (std::size_t i = 0; i < decks.size(); ++i) {
    const std::vector<int> named = named_nodes(model, decks[i]);
    if (named.size() > 1 && static_cast<int>(named.size()) == per_deck) {
      add_named(model, decks[i], named, out, entries);
      continue;
    }
    std::vector<CrossSection> lines = cross_sections(model, cross_groups[i]);
    if (lines.size() < 2) {
      const bool other_number = !named.empty();
      throw InputError(
          {model.source, 0, "deck " + decks[i]},
          fmt::format("has {} lines of elements '{}' across it, expected at least 2{}", lines.size(), cross_groups[i],
                      other_number ? fmt::format(", and {} points aero_{}_<number> where nodes_per_deck asks for {}",
                                                 named.size(), decks[i], per_deck)
                                   : ""),
          other_number
              ? fmt::format("set nodes_per_deck to the number of points ({}), or name the group of its floor beams in "
                            "cross_group",
                            named.size())
              : "name the group of its floor beams in cross_group, or give points aero_" + decks[i] + "_01 ... in points.csv");
    }
    order(lines);
    add_interpolated(model, decks[i], lines, per_deck, out, entries);
  }
  out.motion.resize(6 * static_cast<int>(out.nodes.size()), 6 * static_cast<int>(model.nodes.size()));
  out.motion.setFromTriplets(entries.begin(), entries.end());
  return out;
}

std::vector<Strip> strips_of(const AeroNodes& nodes, const std::vector<std::string>& decks, const Wind& wind) {
  std::vector<Strip> strips;
  for (const AeroNode& node : nodes.nodes) {
    const auto section = static_cast<int>(std::ranges::find(decks, node.deck) - decks.begin());
    strips.push_back(aero::make_strip(node.deck, section, node.station_m, node.length_m, node.x_m, node.tangent, wind));
  }
  return strips;
}

std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>> motions_of(const AeroNodes& nodes,
                                                                 const Eigen::Ref<const Eigen::MatrixXd>& displacement) {
  const Eigen::MatrixXd all = nodes.motion * displacement;
  std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>> motions;
  for (std::size_t i = 0; i < nodes.nodes.size(); ++i)
    motions.emplace_back(all.middleRows<6>(6 * static_cast<Eigen::Index>(i)));
  return motions;
}

}  // namespace twindeck::aero
