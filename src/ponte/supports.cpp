#include "ponte/supports.hpp"

#include <Eigen/Geometry>

namespace twindeck::ponte {

namespace {

using Eigen::Vector3d;

/// Horizontal axes at one end of the bridge: `along` leads away from it, midway between the decks' tangents; `across` to the
/// left of that at the northern end, mirrored at the southern one.
struct EndFrame {
  Vector3d origin_m, along, across;
  bool north;

  /// @param u_m away from the deck ends  @param v_m across  @param z_m height above the mast foot
  [[nodiscard]] Vector3d at(double u_m, double v_m, double z_m) const {
    Vector3d x = origin_m + u_m * along + v_m * across;
    x.z() = z_m;
    return x;
  }
};

EndFrame frame_of(const std::vector<DeckDefinition>& decks, bool north) {
  EndFrame frame{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), north};
  for (const DeckDefinition& deck : decks) {
    const DeckAxis axis(deck);
    frame.origin_m += axis.point(deck.length_m / 2) / static_cast<double>(decks.size());
    frame.along += axis.tangent(deck.length_m / 2);
  }
  frame.along.normalize();
  frame.across = {-frame.along.y(), frame.along.x(), 0.0};
  if (!north)  // the bridge is symmetric about mid-length
    for (Vector3d* v : {&frame.origin_m, &frame.along, &frame.across}) v->x() *= -1.0;
  return frame;
}

/// Stiff members from a new node to the four corners of a face. Solids have no rotations, so these members spread the forces
/// and moments at the node over the face.
int connect_face(ModelBuilder& builder, const Vector3d& point_m, const std::vector<int>& corners) {
  const int node = builder.add_node(point_m);
  for (const int corner : corners) builder.add_element(fe::ElementType::beam, "rigid_connection", "rigid", {node, corner});
  return node;
}

struct Block {
  int front, bottom, back;  ///< nodes at the middle of these faces
};

Block build_block(ModelBuilder& builder, const EndDefinition& ends, const EndFrame& frame) {
  const int across = ends.block_elements[0], along = ends.block_elements[1], up = ends.block_elements[2];
  std::vector<int> nodes;
  const auto node = [&](int i, int j, int k) {
    return nodes[static_cast<std::size_t>((k * (along + 1) + j) * (across + 1) + i)];
  };
  const double top = frame.origin_m.z(), bottom = top - ends.block_height_m;
  for (int k = 0; k <= up; ++k)
    for (int j = 0; j <= along; ++j)
      for (int i = 0; i <= across; ++i)
        nodes.push_back(builder.add_node(frame.at(ends.block_gap_m + ends.block_length_m * j / along,
                                                  ends.block_width_m * (static_cast<double>(i) / across - 0.5),
                                                  bottom + ends.block_height_m * k / up)));
  for (int k = 0; k < up; ++k) {
    for (int j = 0; j < along; ++j) {
      for (int i = 0; i < across; ++i) {
        std::vector<int> face = {node(i, j, k), node(i, j + 1, k), node(i + 1, j + 1, k), node(i + 1, j, k)};
        std::vector<int> above = {node(i, j, k + 1), node(i, j + 1, k + 1), node(i + 1, j + 1, k + 1), node(i + 1, j, k + 1)};
        // Seen from above the face runs anticlockwise at one end and clockwise, by the mirror, at the other.
        const Vector3d normal = (builder.x(face[1]) - builder.x(face[0])).cross(builder.x(face[3]) - builder.x(face[0]));
        if (normal.z() < 0.0) std::swap(face, above);
        face.insert(face.end(), above.begin(), above.end());
        builder.add_solid("end_block", ends.material, std::move(face));
      }
    }
  }
  const double middle = 0.5 * (bottom + top), far = ends.block_gap_m + ends.block_length_m;
  return {connect_face(builder, frame.at(ends.block_gap_m, 0.0, middle),
                       {node(0, 0, 0), node(across, 0, 0), node(across, 0, up), node(0, 0, up)}),
          connect_face(builder, frame.at(0.5 * (ends.block_gap_m + far), 0.0, bottom),
                       {node(0, 0, 0), node(across, 0, 0), node(across, along, 0), node(0, along, 0)}),
          connect_face(builder, frame.at(far, 0.0, middle),
                       {node(0, along, 0), node(across, along, 0), node(across, along, up), node(0, along, up)})};
}

void fix(ModelBuilder& builder, const std::string& name, int node) {
  builder.model.supports.push_back({name, node, {true, true, true, true, true, true}});
}

/// A wall from the ground to a node, fixed at its foot.
void build_pier(ModelBuilder& builder, const std::string& section, const std::string& name, int head, const Vector3d& along,
                const EndDefinition& ends) {
  Vector3d foot = builder.x(head);
  foot.z() = 0.0;
  const int ground = builder.add_node(foot);
  builder.add_member(section, ground, head, ends.beams_per_span, along, ends.material);
  fix(builder, name, ground);
}

void build_ramp(ModelBuilder& builder, const EndDefinition& ends, const EndFrame& frame, int start) {
  const std::string side = frame.north ? "north" : "south";
  const double begin = ends.block_gap_m + ends.block_length_m, high = builder.x(start).z();
  int last = start;
  for (int span = 1; span <= ends.ramp_spans; ++span) {
    const double part = static_cast<double>(span) / ends.ramp_spans;
    const int next =
        builder.add_node(frame.at(begin + part * ends.ramp_length_m, 0.0, high + part * (ends.ramp_end_z_m - high)));
    builder.add_member("ramp", last, next, ends.beams_per_span, Vector3d::Zero(), ends.material);
    if (span < ends.ramp_spans)
      build_pier(builder, "ramp_pier", "ramp_pier_" + side + "_" + std::to_string(span), next, frame.along, ends);
    last = next;
  }
  fix(builder, "abutment_" + side, last);
}

}  // namespace

void build_deck_supports(ModelBuilder& builder, const DeckDefinition& deck, const DeckNodes& nodes, const EndNodes& ends) {
  const DeckAxis axis(deck);
  const BearingDefinition& k = deck.bearing;
  for (const bool north : {true, false}) {
    const DeckNodes::Line& end = north ? nodes.lines.back() : nodes.lines.front();
    const std::string group = deck.name + (north ? "_north" : "_south");
    const Eigen::Vector3d r = axis.radial(end.s_m), t = axis.tangent(end.s_m), z = Eigen::Vector3d::UnitZ();
    const int block = north ? ends.north : ends.south;
    const auto seat = [&](int node, const std::string& name) {
      if (block < 0) return -1;
      const int below = builder.add_node(builder.x(node));
      builder.model.links.push_back({"seat_" + name, block, below});
      return below;
    };
    // Two bottom chords share the stiffness.
    const double share = k.bottom_N_m / static_cast<double>(end.bottom.size());
    for (std::size_t i = 0; i < end.bottom.size(); ++i) {
      const std::string name = group + (end.bottom.size() == 1 ? "_bottom" : i == 0 ? "_bottom_inner" : "_bottom_outer");
      const int bottom = seat(end.bottom[i], name);
      builder.add_spring(group, name + "_radial", end.bottom[i], r, share, bottom);
      builder.add_spring(group, name + "_tangential", end.bottom[i], t, share, bottom);
      builder.add_spring(group, name + "_vertical", end.bottom[i], z, share, bottom);
    }
    for (const bool outer : {false, true}) {
      const int corner = outer ? end.across.back() : end.across.front();
      const std::string name = group + (outer ? "_outer" : "_inner");
      const int below = seat(corner, name);
      builder.add_spring(group, name + "_vertical", corner, z, k.vertical_N_m, below);
      builder.add_spring(group, name + "_radial", corner, r, k.radial_N_m / 2, below);
      builder.add_spring(group, name + "_tangential", corner, t, k.tangential_N_m, below);
    }
  }
}

void build_dampers(ModelBuilder& builder, const BridgeDefinition& definition, const std::map<std::string, DeckNodes>& decks) {
  for (const DamperDefinition& damper : definition.dampers) {
    for (const DeckPoint& unit : damper.units) {
      const DeckNodes::Line& line = decks.at(unit.deck).station_near(unit.s_m);
      fe::Spring spring{.name = unit.name,
                        .group = "damper_" + damper.type,
                        .node = unit.outer_edge ? line.across.back() : line.across.front()};
      for (const DeckDefinition& deck : definition.decks)
        if (deck.name == unit.deck && !damper.vertical) spring.direction = DeckAxis(deck).radial(line.s_m);
      spring.stiffness = damper.stiffness_N_m;
      spring.damping = damper.damping_N_s_m;
      spring.series = damper.series;
      spring.active = false;
      builder.model.springs.push_back(spring);
    }
  }
}

EndNodes build_ends(ModelBuilder& builder, const BridgeDefinition& definition) {
  EndNodes out;
  if (!definition.ends) return out;
  const EndDefinition& ends = *definition.ends;
  for (const fe::Section& section : {ends.rigid_connection, ends.pier, ends.ramp, ends.ramp_pier}) builder.add_section(section);
  for (const bool north : {true, false}) {
    const EndFrame frame = frame_of(definition.decks, north);
    const Block block = build_block(builder, ends, frame);
    build_pier(builder, "pier", north ? "pier_north" : "pier_south", block.bottom, frame.along, ends);
    build_ramp(builder, ends, frame, block.back);
    (north ? out.north : out.south) = block.front;
  }
  return out;
}

}  // namespace twindeck::ponte
