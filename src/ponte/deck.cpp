#include "ponte/deck.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.hpp"

namespace twindeck::ponte {

namespace {

/// Top-chord nodes of a line: the slab's edge nodes, or nodes below them that move with them as rigid bodies.
std::vector<int> build_chord_nodes(ModelBuilder& builder, const DeckDefinition& deck, const std::vector<int>& across,
                                   double s_m, std::size_t line) {
  if (deck.slab_height_m == 0.0) return {across.front(), across.back()};
  const DeckAxis axis(deck);
  std::vector<int> out;
  for (const bool outer : {false, true}) {
    const double v = (outer ? 0.5 : -0.5) * deck.chord_spacing_m;
    out.push_back(builder.add_node(axis.point(s_m, v, -deck.slab_height_m)));
    builder.model.links.push_back({"slab_joint_" + deck.name + "_" + std::to_string(line) + (outer ? "_outer" : "_inner"),
                                   outer ? across.back() : across.front(), out.back()});
  }
  return out;
}

// Rows of slab nodes and, at the stations, the bottom-chord nodes.
DeckNodes build_nodes(ModelBuilder& builder, const DeckDefinition& deck, const MeshDefinition& mesh) {
  const DeckAxis axis(deck);
  const std::vector<double> station = stations(deck, mesh.panels_per_stay_spacing);
  DeckNodes out;
  const auto add_line = [&](double s, bool is_station) {
    DeckNodes::Line line{s, {}, {}, {}};
    for (int j = 0; j <= mesh.shells_across; ++j) {
      const double v = deck.chord_spacing_m * (static_cast<double>(j) / mesh.shells_across - 0.5);
      line.across.push_back(builder.add_node(axis.point(s, v)));
    }
    line.chord = build_chord_nodes(builder, deck, line.across, s, out.lines.size());
    const double half = deck.bottom_chord_spacing_m / 2;
    for (const double v : half > 0.0 ? std::vector<double>{-half, half} : std::vector<double>{0.0}) {
      if (!is_station) break;
      const double depth = deck.slab_height_m + deck.truss_depth_m;
      line.bottom.push_back(builder.add_node(axis.point(s, deck.bottom_chord_offset_m + v, -depth)));
    }
    out.lines.push_back(line);
  };
  for (std::size_t k = 0; k < station.size(); ++k) {
    add_line(station[k], true);
    for (int i = 1; k + 1 < station.size() && i < mesh.shells_per_panel_along; ++i)
      add_line(station[k] + (station[k + 1] - station[k]) * i / mesh.shells_per_panel_along, false);
  }
  return out;
}

const SlabZone& zone_at(const DeckDefinition& deck, double s_m) {
  const double reach = std::abs(s_m) / (deck.length_m / 2);
  for (const SlabZone& zone : deck.slab)
    if (reach < zone.until) return zone;
  return deck.slab.back();
}

void build_slab(ModelBuilder& builder, const DeckDefinition& deck, const MeshDefinition& mesh, const DeckNodes& nodes) {
  for (std::size_t k = 0; k + 1 < nodes.lines.size(); ++k) {
    // The zone goes by the whole panel, so that it does not move when the panel is divided.
    const std::size_t along = static_cast<std::size_t>(mesh.shells_per_panel_along), first = k / along * along;
    const SlabZone& zone = zone_at(deck, (nodes.lines[first].s_m + nodes.lines[first + along].s_m) / 2);
    const DeckNodes::Line &here = nodes.lines[k], &next = nodes.lines[k + 1];
    for (std::size_t j = 0; j + 1 < here.across.size(); ++j)
      builder.add_element(fe::ElementType::shell, zone.group, zone.material,
                          {here.across[j], next.across[j], next.across[j + 1], here.across[j + 1]});
  }
}

void build_truss(ModelBuilder& builder, const DeckDefinition& deck, const MeshDefinition& mesh, const DeckNodes& nodes) {
  const DeckAxis axis(deck);
  const std::string d = deck.name;
  const auto& lines = nodes.lines;
  for (std::size_t k = 0; k + 1 < lines.size(); ++k)
    for (const std::size_t edge : {0u, 1u})
      builder.add_element(fe::ElementType::beam, d + "_top_chord", "steel", {lines[k].chord[edge], lines[k + 1].chord[edge]});
  const std::size_t step = static_cast<std::size_t>(mesh.shells_per_panel_along);
  for (std::size_t k = 0; k < lines.size(); k += step) {
    const DeckNodes::Line& line = lines[k];
    for (std::size_t j = 0; j + 1 < line.across.size(); ++j)
      builder.add_element(fe::ElementType::beam, d + "_floor_beam", "steel", {line.across[j], line.across[j + 1]});
    const auto diagonals = [&](const std::string& section, const DeckNodes::Line& top, const Eigen::Vector3d& orientation) {
      builder.add_member(section, line.bottom.front(), top.chord.front(), mesh.members_per_panel, orientation);
      builder.add_member(section, line.bottom.back(), top.chord.back(), mesh.members_per_panel, orientation);
    };
    // A post may stand upright, so its local z is laid along the deck.
    diagonals(d + "_short_diagonal", line, axis.tangent(line.s_m));
    // Long diagonals rise away from mid-length, at mid-length both ways.
    const double tolerance = 1e-6 * deck.length_m;
    if (k + step < lines.size()) {
      for (std::size_t i = 0; i < line.bottom.size(); ++i)
        builder.add_member(d + "_bottom_chord", line.bottom[i], lines[k + step].bottom[i], mesh.members_per_panel);
      if (line.s_m > -tolerance) diagonals(d + "_long_diagonal", lines[k + step], Eigen::Vector3d::Zero());
    }
    if (k >= step && line.s_m < tolerance) diagonals(d + "_long_diagonal", lines[k - step], Eigen::Vector3d::Zero());
  }
}

// Between two bottom chords: a strut and, from the inner bottom to the outer top chord, a brace across at each station, which
// keep the section's shape; in each panel a diagonal in the bottom plane, inner to outer away from mid-length.
void build_bottom_plane(ModelBuilder& builder, const DeckDefinition& deck, const MeshDefinition& mesh, const DeckNodes& nodes) {
  if (deck.bottom_chord_spacing_m == 0.0) return;
  const DeckAxis axis(deck);
  const auto& lines = nodes.lines;
  const std::size_t step = static_cast<std::size_t>(mesh.shells_per_panel_along);
  for (std::size_t k = 0; k < lines.size(); k += step) {
    const DeckNodes::Line& line = lines[k];
    const Eigen::Vector3d along = axis.tangent(line.s_m);
    builder.add_member(deck.name + "_floor_beam", line.bottom[0], line.bottom[1], mesh.members_per_panel);
    builder.add_member(deck.name + "_short_diagonal", line.bottom[0], line.chord[1], mesh.members_per_panel, along);
    if (k + step >= lines.size()) continue;
    const DeckNodes::Line& next = lines[k + step];
    const bool north = line.s_m + next.s_m > 0.0;
    const DeckNodes::Line &inwards = north ? line : next, &outwards = north ? next : line;
    builder.add_member(deck.name + "_long_diagonal", inwards.bottom[0], outwards.bottom[1], mesh.members_per_panel);
  }
}

// Half of the mass on each edge line, lumped without rotary inertia.
void build_nonstructural_mass(ModelBuilder& builder, const DeckDefinition& deck, const DeckNodes& nodes) {
  if (deck.nonstructural_mass_kg_m == 0.0) return;
  const auto& lines = nodes.lines;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double before = k > 0 ? lines[k].s_m - lines[k - 1].s_m : 0.0;
    const double after = k + 1 < lines.size() ? lines[k + 1].s_m - lines[k].s_m : 0.0;
    for (const int node : {lines[k].across.front(), lines[k].across.back()})
      builder.model.masses.push_back({.group = deck.name + "_nonstructural_mass",
                                      .node = node,
                                      .mass_kg = deck.nonstructural_mass_kg_m * (before + after) / 4});
  }
}

// Stay anchorages outside the edge, rigid with the top-chord node of their station.
void build_brackets(ModelBuilder& builder, const DeckDefinition& deck, DeckNodes& nodes) {
  const DeckAxis axis(deck);
  const std::vector<double> positions = stay_positions(deck.stay);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (const bool north : {true, false}) {
      const double s = north ? positions[i] : -positions[i];
      const DeckNodes::Line& line = nodes.station_near(s);
      TWINDECK_ASSERT(std::abs(line.s_m - s) < 1e-6 * deck.length_m);
      const double reach = deck.chord_spacing_m / 2 + deck.bracket_arm_m;
      const int bracket = builder.add_node(axis.point(s, deck.stays_on_outer_edge ? reach : -reach));
      const std::string name = (north ? deck.stay.prefix_north : deck.stay.prefix_south) + std::to_string(i + 1);
      builder.model.links.push_back(
          {"bracket_" + name, deck.stays_on_outer_edge ? line.across.back() : line.across.front(), bracket});
      nodes.anchors[name] = bracket;
    }
  }
}

}  // namespace

DeckNodes build_deck(ModelBuilder& builder, const DeckDefinition& deck, const MeshDefinition& mesh) {
  for (const fe::Section& section :
       {deck.top_chord, deck.bottom_chord, deck.short_diagonal, deck.long_diagonal, deck.floor_beam})
    builder.add_section(section);
  for (const SlabZone& zone : deck.slab) {
    fe::Section section{
        .name = zone.group, .thickness_m = zone.thickness_m, .bending_inertia_ratio = zone.bending_inertia_ratio};
    builder.add_section(section);
  }
  DeckNodes nodes = build_nodes(builder, deck, mesh);
  build_truss(builder, deck, mesh, nodes);
  build_bottom_plane(builder, deck, mesh, nodes);
  build_slab(builder, deck, mesh, nodes);
  build_nonstructural_mass(builder, deck, nodes);
  build_brackets(builder, deck, nodes);
  return nodes;
}

const DeckNodes::Line& DeckNodes::station_near(double s_m) const {
  const Line* best = nullptr;
  for (const Line& line : lines)
    if (!line.bottom.empty() && (best == nullptr || std::abs(line.s_m - s_m) < std::abs(best->s_m - s_m))) best = &line;
  TWINDECK_ASSERT(best != nullptr);
  return *best;
}

const DeckNodes::Line& DeckNodes::line_near(double s_m) const {
  return *std::ranges::min_element(lines,
                                   [&](const Line& a, const Line& b) { return std::abs(a.s_m - s_m) < std::abs(b.s_m - s_m); });
}

DeckAxis::DeckAxis(const DeckDefinition& deck)
    : radius_m(deck.radius_m), length_m(deck.length_m), end_y_m(deck.end_y_m), crown_z_m(deck.crown_z_m), rise_m(deck.rise_m) {}

Eigen::Vector3d DeckAxis::point(double s_m, double v_m, double w_m) const {
  const double phi_0 = length_m / (2 * radius_m);
  const Eigen::Vector3d centre(0.0, end_y_m - radius_m * std::cos(phi_0),
                               crown_z_m - rise_m * std::pow(2 * s_m / length_m, 2) + w_m);
  return centre + (radius_m + v_m) * radial(s_m);
}

Eigen::Vector3d DeckAxis::radial(double s_m) const { return {std::sin(s_m / radius_m), std::cos(s_m / radius_m), 0.0}; }

Eigen::Vector3d DeckAxis::tangent(double s_m) const { return {std::cos(s_m / radius_m), -std::sin(s_m / radius_m), 0.0}; }

std::vector<double> stay_positions(const StayRow& stay) {
  std::vector<double> out;
  for (int i = 1; i < stay.count; ++i) out.push_back((i - 0.5) * stay.spacing_m);
  out.push_back(out.back() + stay.last_spacing_m);
  return out;
}

std::vector<double> stations(const DeckDefinition& deck, int panels_per_stay_spacing) {
  std::vector<double> fixed = stay_positions(deck.stay);
  fixed.push_back(deck.length_m / 2);
  const double longest = deck.stay.spacing_m / panels_per_stay_spacing;
  std::vector<double> half = {0.0};
  for (const double end : fixed) {
    const double start = half.back();
    // The small number keeps a spacing that is a whole multiple of the panel from being divided once more by rounding.
    const int panels = static_cast<int>(std::ceil((end - start) / longest - 1e-9));
    for (int i = 1; i <= panels; ++i) half.push_back(start + (end - start) * i / panels);
  }
  std::vector<double> out;
  std::transform(half.rbegin(), std::prev(half.rend()), std::back_inserter(out), [](double s) { return -s; });
  out.insert(out.end(), half.begin(), half.end());
  return out;
}

}  // namespace twindeck::ponte
