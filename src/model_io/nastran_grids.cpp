#include "model_io/nastran_grids.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model_io/inp_cards.hpp"
#include "model_io/nastran_properties.hpp"

/// Grids and coordinate systems, each resolved when it is first asked for: systems lean on grids and grids on systems.
namespace twindeck::model_io::nastran {
namespace {

constexpr double radians = std::numbers::pi / 180.0;
constexpr std::size_t longest_chain = 100;  ///< of systems defined in one another

/// Axes from the origin a, a point b on z and a point c in the x-z plane.
System from_points(const Parts& parts, const Card& card, const std::array<Eigen::Vector3d, 3>& p) {
  System s;
  s.type = card.name.back();
  s.origin = p[0];
  const Eigen::Vector3d z = p[1] - p[0], y = z.cross(p[2] - p[0]);
  if (!(y.norm() > 1e-9 * z.norm() * (p[2] - p[0]).norm()))
    parts.deck.fail(card, "its three points lie on one line", "give the origin, a point on z, a point in the x-z plane");
  s.axes.row(2) = z.normalized();
  s.axes.row(1) = y.normalized();
  s.axes.row(0) = s.axes.row(1).cross(s.axes.row(2));
  return s;
}

/// Field of a GRID, or of GRDSET where the grid leaves it blank.
std::string grid_field(const Parts& parts, const Card& grid, std::size_t i) {
  const std::string own = Deck::text(grid, i);
  return own.empty() && parts.grid_defaults != nullptr ? Deck::text(*parts.grid_defaults, i) : own;
}

long system_number(const Parts& parts, const Card& grid, std::size_t i) {
  const std::string field = grid_field(parts, grid, i);
  if (field.empty()) return 0;
  if (!Deck::is_integer(field)) parts.deck.fail(grid, fmt::format("system '{}' is no whole number", field), "give its number");
  const long id = std::stol(field);
  if (id < 0) parts.deck.fail(grid, "is a point of a fluid, which is not read", "leave the fluid out");
  return id;
}

void index_in(const Parts& parts, std::map<long, const Card*>& list, const Card& card) {
  const long id = parts.deck.integer(card, 0);
  if (!list.emplace(id, &card).second)
    parts.deck.fail(card, fmt::format("the number {} is defined twice", id), "keep one of the two cards");
}

}  // namespace

Eigen::Vector3d System::to_basic(const Eigen::Vector3d& x) const {
  Eigen::Vector3d local = x;
  const double second = x[1] * radians;
  if (type == 'C') local = {x[0] * std::cos(second), x[0] * std::sin(second), x[2]};
  if (type == 'S') {
    const double third = x[2] * radians, across = x[0] * std::sin(second);
    local = {across * std::cos(third), across * std::sin(third), x[0] * std::cos(second)};
  }
  return origin + axes.transpose() * local;
}

Eigen::Matrix3d System::axes_at(const Eigen::Vector3d& basic) const {
  if (type == 'R') return axes;
  const Eigen::Vector3d p = axes * (basic - origin);
  const double across = std::hypot(p[0], p[1]);
  Eigen::Matrix3d local;
  const double c = across > 0.0 ? p[0] / across : 1.0, s = across > 0.0 ? p[1] / across : 0.0;
  if (type == 'C') {
    local << c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0;
  } else {
    const double r = p.norm(), st = r > 0.0 ? across / r : 0.0, ct = r > 0.0 ? p[2] / r : 1.0;
    local << st * c, st * s, ct, ct * c, ct * s, -st, -s, c, 0.0;
  }
  return local * axes;
}

void index_card(Parts& parts, const Card& card) {
  const Deck& deck = parts.deck;
  if (card.name == "GRID") return index_in(parts, parts.grids, card);
  if (card.name.starts_with("CORD2")) return index_in(parts, parts.system_cards, card);
  if (card.name == "MAT1") return index_in(parts, parts.materials, card);
  if (card.name == "GRDSET") {
    if (parts.grid_defaults != nullptr) deck.fail(card, "stands twice in the deck", "keep one of the two cards");
    parts.grid_defaults = &card;
  } else if (card.name.starts_with("CORD1")) {
    for (const std::size_t i : {0U, 4U}) {
      if (i > 0 && Deck::blank(card, i)) break;
      const long id = deck.integer(card, i);
      if (!parts.system_cards.emplace(id, &card).second)
        deck.fail(card, fmt::format("the number {} is defined twice", id), "keep one of the two cards");
      parts.first_kind[id] = {deck.integer(card, i + 1), deck.integer(card, i + 2), deck.integer(card, i + 3)};
    }
  } else if (card.name == "PELAS" || card.name == "PMASS") {
    const bool spring = card.name == "PELAS";
    auto& list = spring ? parts.spring_constants : parts.scalar_masses;
    for (std::size_t i = 0; i < 8 && !Deck::blank(card, i); i += spring ? 4 : 2) {
      if (!list.emplace(deck.integer(card, i), deck.number(card, i + 1)).second)
        deck.fail(card, fmt::format("the number {} is defined twice", deck.integer(card, i)), "keep one of the two cards");
    }
  } else if (card.name == "SPOINT") {
    for (std::size_t i = 0; i < Deck::size(card); ++i) {
      if (Deck::is_integer(card.fields[i])) parts.scalar_points.insert(deck.integer(card, i));
    }
  } else {
    auto& list = parts.properties[deck.integer(card, 0)];
    if (std::any_of(list.begin(), list.end(), [&](const Card* other) { return other->name == card.name; }))
      deck.fail(card, "this property is defined twice", "keep one of the two cards");
    list.push_back(&card);
  }
}

const System& Parts::system(const Card& from, long id) {
  if (const auto known = systems.find(id); known != systems.end()) return known->second;
  if (id == 0) return systems.emplace(0, System{}).first->second;
  const auto found = system_cards.find(id);
  if (found == system_cards.end())
    deck.fail(from, fmt::format("coordinate system {} is not defined", id), "give it a CORD2R card, or write 0");
  const Card& card = *found->second;
  if (!resolving.insert(id).second || resolving.size() > longest_chain)
    deck.fail(card, fmt::format("coordinate system {} leans on itself", id), "define it in the basic system");
  std::array<Eigen::Vector3d, 3> points;
  if (const auto first = first_kind.find(id); first != first_kind.end()) {
    for (std::size_t i = 0; i < 3; ++i) points[i] = place(card, first->second[i]);
  } else {
    const System reference = system(card, deck.integer_or(card, 1, 0));
    for (std::size_t i = 0; i < 3; ++i) points[i] = reference.to_basic(deck.vector(card, 2 + 3 * i));
  }
  resolving.erase(id);
  return systems.emplace(id, from_points(*this, card, points)).first->second;
}

Eigen::Vector3d Parts::place(const Card& from, long grid) {
  if (const auto known = places.find(grid); known != places.end()) return known->second;
  const auto found = grids.find(grid);
  if (found == grids.end()) {
    if (scalar_points.contains(grid))
      deck.fail(from, fmt::format("names the scalar point {}, and scalar points are not read", grid),
                "put a GRID in its place, with the other components held");
    deck.fail(from, fmt::format("grid {} is not defined", grid), "give it a GRID card, or mend the number");
  }
  const Card& card = *found->second;
  const Eigen::Vector3d x = system(card, system_number(*this, card, 1)).to_basic(deck.vector(card, 2));
  return places.emplace(grid, x).first->second;
}

Eigen::Matrix3d Parts::displacement_axes(const Card& from, long grid) {
  const Eigen::Vector3d x = place(from, grid);
  const Card& card = *grids.at(grid);
  return system(card, system_number(*this, card, 5)).axes_at(x);
}

int Parts::node(const Card& from, long grid) {
  const auto [entry, is_new] = node_position.emplace(grid, static_cast<int>(model.nodes.size()));
  if (is_new) model.nodes.push_back({grid, place(from, grid)});
  return entry->second;
}

std::vector<long> Parts::grid_list(const Card& card, std::size_t start, bool exact) const {
  std::vector<long> list;
  for (std::size_t i = start; i < Deck::size(card); ++i) {
    if (Deck::blank(card, i)) continue;
    if (upper_case(card.fields[i]) != "THRU") {
      list.push_back(deck.integer(card, i));
      continue;
    }
    const long last = deck.integer(card, i + 1);
    if (list.empty() || last < list.back()) deck.fail(card, "THRU stands between no two rising numbers", "write 5 THRU 13");
    const long first = list.back();
    long expected = first;
    for (auto grid = grids.upper_bound(first); grid != grids.end() && grid->first <= last; ++grid) {
      if (exact && grid->first != ++expected) break;
      list.push_back(grid->first);
    }
    if (exact && list.back() != last)
      deck.fail(card, fmt::format("grids {} THRU {} are not all defined", first, last), "list the grids that are");
    if (!exact && !grids.contains(first)) list.erase(std::find(list.begin(), list.end(), first));
    ++i;
  }
  return list;
}

int component_at(const Parts& parts, const Card& card, std::size_t i) {
  const long component = parts.deck.integer(card, i);
  if (component < 1 || component > 6)
    parts.deck.fail(card, fmt::format("component {} is none of 1 to 6", component), "1-3 displacements, 4-6 rotations");
  return static_cast<int>(component) - 1;
}

std::array<bool, 6> components(const Parts& parts, const Card& card, std::size_t i) {
  std::array<bool, 6> flags{};
  const std::string text = Deck::text(card, i);
  if (text.empty() || text == "0")
    parts.deck.fail(card, "names no component, as for a scalar point, and scalar points are not read",
                    "give components of 1 to 6");
  for (const char c : text) {
    if (c < '1' || c > '6')
      parts.deck.fail(card, fmt::format("components are '{}', expected digits from 1 to 6", text),
                      "1-3 displacements, 4-6 rotations");
    flags[static_cast<std::size_t>(c - '1')] = true;
  }
  return flags;
}

void note_once(Parts& parts, const std::string& note) {
  if (std::find(parts.notes.begin(), parts.notes.end(), note) == parts.notes.end()) parts.notes.push_back(note);
}

}  // namespace twindeck::model_io::nastran
