#include "ponte/supports.hpp"

#include "ponte/deck_axis.hpp"

namespace twindeck::ponte {

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

}  // namespace twindeck::ponte
