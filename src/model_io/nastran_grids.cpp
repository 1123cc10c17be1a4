#include "model_io/nastran_grids.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "model_io/nastran_properties.hpp"

/// Grids and coordinate systems, each resolved when it is first asked for: systems lean on grids and grids on systems.
namespace twindeck::model_io::nastran {
namespace {

constexpr std::size_t longest_chain = 100;  ///< of systems defined in one another

/// Axes from the origin a, a point b on z and a point c in the x-z plane.
System from_points(const Card& card, const std::array<Eigen::Vector3d, 3>& p) {
  System s{.type = card.name.back(), .origin = p[0]};
  const Eigen::Vector3d z = p[1] - p[0], y = z.cross(p[2] - p[0]);
  if (!(y.norm() > 1e-9 * z.norm() * (p[2] - p[0]).norm()))
    card.fail("its three points lie on one line", "give the origin, a point on z, a point in the x-z plane");
  s.axes.row(2) = z.normalized();
  s.axes.row(1) = y.normalized();
  s.axes.row(0) = s.axes.row(1).cross(s.axes.row(2));
  return s;
}

/// Field of a GRID, or of GRDSET where the grid leaves it blank.
std::string grid_field(const Parts& parts, const Card& grid, std::size_t i) {
  const std::string own = grid.text(i);
  return own.empty() && parts.grid_defaults != nullptr ? parts.grid_defaults->text(i) : own;
}

long system_number(const Parts& parts, const Card& grid, std::size_t i) {
  const std::string field = grid_field(parts, grid, i);
  if (field.empty()) return 0;
  if (!is_whole_number(field)) grid.fail(fmt::format("system '{}' is no whole number", field), "give its number");
  const long id = std::stol(field);
  if (id < 0) grid.fail("is a point of a fluid, which is not read", "leave the fluid out");
  return id;
}

void index_in(std::map<long, const Card*>& list, const Card& card) {
  if (const long id = card.integer(0); !list.emplace(id, &card).second)
    card.fail(fmt::format("the number {} is defined twice", id), "keep one of the two cards");
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
  if (card.name == "GRID") return index_in(parts.grids, card);
  if (card.name.starts_with("CORD2")) return index_in(parts.system_cards, card);
  if (card.name == "MAT1") return index_in(parts.materials, card);
  if (card.name == "BAROR" || card.name == "BEAMOR") {
    if (!parts.member_defaults.emplace(card.name == "BAROR" ? "CBAR" : "CBEAM", &card).second)
      card.fail("stands twice in the deck", "keep one of the two cards");
  } else if (card.name == "GRDSET") {
    if (parts.grid_defaults != nullptr) card.fail("stands twice in the deck", "keep one of the two cards");
    parts.grid_defaults = &card;
  } else if (card.name.starts_with("CORD1")) {
    for (const std::size_t i : {0U, 4U}) {
      if (i > 0 && card.blank(i)) break;
      const long id = card.integer(i);
      if (!parts.system_cards.emplace(id, &card).second)
        card.fail(fmt::format("the number {} is defined twice", id), "keep one of the two cards");
      parts.first_kind[id] = {card.integer(i + 1), card.integer(i + 2), card.integer(i + 3)};
    }
  } else if (card.name == "PELAS" || card.name == "PMASS") {
    const bool spring = card.name == "PELAS";
    auto& list = spring ? parts.spring_constants : parts.scalar_masses;
    for (std::size_t i = 0; i < 8 && !card.blank(i); i += spring ? 4 : 2)
      if (!list.emplace(card.integer(i), card.number(i + 1)).second)
        card.fail(fmt::format("the number {} is defined twice", card.integer(i)), "keep one of the two cards");
  } else if (card.name == "SPOINT") {
    for (std::size_t i = 0; i < card.size(); ++i)
      if (is_whole_number(card.fields[i])) parts.scalar_points.insert(card.integer(i));
  } else {
    auto& list = parts.properties[card.integer(0)];
    if (std::ranges::any_of(list, [&](const Card* other) { return other->name == card.name; }))
      card.fail("this property is defined twice", "keep one of the two cards");
    list.push_back(&card);
  }
}

const System& Parts::system(const DeckPlace& from, long id) {
  if (const auto known = systems.find(id); known != systems.end()) return known->second;
  if (id == 0) return systems.emplace(0, System{}).first->second;
  const auto found = system_cards.find(id);
  if (found == system_cards.end())
    from.fail(fmt::format("coordinate system {} is not defined", id), "give it a CORD2R card, or write 0");
  const Card& card = *found->second;
  if (!resolving.insert(id).second || resolving.size() > longest_chain)
    card.fail(fmt::format("coordinate system {} leans on itself", id), "define it in the basic system");
  std::array<Eigen::Vector3d, 3> points;
  if (const auto first = first_kind.find(id); first != first_kind.end()) {
    for (std::size_t i = 0; i < 3; ++i) points[i] = grid_place(card, first->second[i]);
  } else {
    const System reference = system(card, card.integer_or(1, 0));
    for (std::size_t i = 0; i < 3; ++i) points[i] = reference.to_basic(card.vector(2 + 3 * i));
  }
  resolving.erase(id);
  return systems.emplace(id, from_points(card, points)).first->second;
}

Eigen::Vector3d Parts::grid_place(const DeckPlace& from, long grid) {
  if (const auto known = places.find(grid); known != places.end()) return known->second;
  const auto found = grids.find(grid);
  if (found == grids.end()) {
    if (scalar_points.contains(grid))
      from.fail(fmt::format("names the scalar point {}, and scalar points are not read", grid),
                "put a GRID in its place, with the other components held");
    from.fail(fmt::format("grid {} is not defined", grid), "give it a GRID card, or mend the number");
  }
  const Card& card = *found->second;
  const Eigen::Vector3d x = system(card, system_number(*this, card, 1)).to_basic(card.vector(2));
  return places.emplace(grid, x).first->second;
}

Eigen::Matrix3d Parts::displacement_axes(const DeckPlace& from, long grid) {
  const Eigen::Vector3d x = grid_place(from, grid);
  const Card& card = *grids.at(grid);
  return system(card, system_number(*this, card, 5)).axes_at(x);
}

std::vector<long> Parts::grid_list(const Card& card, std::size_t start, bool exact) const {
  std::vector<long> list;
  for (std::size_t i = start; i < card.size(); ++i) {
    if (card.blank(i)) continue;
    if (upper_case(card.fields[i]) != "THRU") {
      list.push_back(card.integer(i));
      continue;
    }
    const long last = card.integer(i + 1);
    if (list.empty() || last < list.back()) card.fail("THRU stands between no two rising numbers", "write 5 THRU 13");
    const long first = list.back();
    long expected = first;
    for (auto grid = grids.upper_bound(first); grid != grids.end() && grid->first <= last; ++grid) {
      if (exact && grid->first != ++expected) break;
      list.push_back(grid->first);
    }
    if (exact && list.back() != last)
      card.fail(fmt::format("grids {} THRU {} are not all defined", first, last), "list the grids that are");
    if (!exact && !grids.contains(first)) list.erase(std::ranges::find(list, first));
    ++i;
  }
  return list;
}

Directions components(const DeckFields& card, std::size_t i) {
  Directions flags{};
  const std::string text = card.text(i);
  if (text.empty() || text == "0")
    card.fail("names no component, as for a scalar point, and scalar points are not read", "give components of 1 to 6");
  for (const char c : text) {
    if (c < '1' || c > '6')
      card.fail(fmt::format("components are '{}', expected digits from 1 to 6", text), "1-3 displacements, 4-6 rotations");
    flags[static_cast<std::size_t>(c - '1')] = true;
  }
  return flags;
}

}  // namespace twindeck::model_io::nastran
