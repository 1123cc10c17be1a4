#include "blind/form/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twindeck::blind::form {

namespace {

constexpr double kConcrete_Pa = 34e9, kConcrete_kg_m3 = 2550.0;

double beam_length(const Layout& layout, const CoarseBeam& beam) {
  return (layout.nodes[static_cast<std::size_t>(beam.to)] - layout.nodes[static_cast<std::size_t>(beam.from)]).norm();
}

double total_mass(const Layout& layout) {
  double kg = 0.0;
  for (const CoarseBeam& beam : layout.beams)
    kg += layout.materials[static_cast<std::size_t>(beam.material)].density_kg_m3 *
          layout.sections[static_cast<std::size_t>(beam.section)].area_m2 * beam_length(layout, beam);
  for (const Floor& floor : layout.floors) kg += floor.kg;
  return kg;
}

/// Every node between supports, thinned out evenly to at most 16.
void place_girder_channels(Layout& layout) {
  std::vector<int> between;
  for (int node = 0; node < static_cast<int>(layout.nodes.size()); ++node)
    if (std::none_of(layout.bearings.begin(), layout.bearings.end(), [&](const Bearing& b) { return b.node == node; }))
      between.push_back(node);
  constexpr std::size_t kMost = 16;
  const std::size_t count = std::min(between.size(), kMost);
  for (std::size_t i = 0; i < count; ++i) layout.channel_nodes.push_back(between[i * between.size() / count]);
}

void add_girder_quantities(Layout& layout, int spans) {
  using Of = Quantity::Of;
  for (int m = 0; m < static_cast<int>(layout.materials.size()); ++m)
    layout.quantities.push_back({"E_" + layout.materials[static_cast<std::size_t>(m)].name, Of::modulus, {m}, {}, 0.7, 1.4});
  std::vector<int> all;
  for (int m = 0; m < static_cast<int>(layout.materials.size()); ++m) all.push_back(m);
  layout.quantities.push_back({"rho", Of::density, all, {}, 0.9, 1.1});
  layout.quantities.push_back({"k_abutments", Of::springs, {}, {"abutment_W", "abutment_E"}, 0.4, 2.5});
  if (spans == 2) layout.quantities.push_back({"k_pier", Of::springs, {}, {"pier_1"}, 0.4, 2.5});
  if (spans == 3) layout.quantities.push_back({"k_piers", Of::springs, {}, {"pier_1", "pier_2"}, 0.4, 2.5});
  layout.quantities.push_back({"k_ends", Of::springs, {}, {"abutment_W_turn", "abutment_E_turn"}, 0.3, 3.0});
}

Layout draw_girder(Kind kind, Stream& random) {
  Layout layout;
  layout.kind = kind;
  const int spans = kind == Kind::girder_1 ? 1 : kind == Kind::girder_2 ? 2 : 3;
  const int per_span = spans == 1 ? 12 : spans == 2 ? 8 : 6;
  layout.modes = 6 + spans + random.below(2);
  std::vector<double> lengths;
  double longest = 0.0;
  for (int s = 0; s < spans; ++s) {
    lengths.push_back(random.between(18.0, 30.0));
    longest = std::max(longest, lengths.back());
  }
  layout.span_m = longest;
  const double depth = longest / random.between(16.0, 22.0), area = 0.55 * depth * depth;
  layout.sections.push_back({"girder", area, area * depth * depth / 7.0, depth});
  layout.nodes.emplace_back(0.0, 0.0);
  for (int s = 0; s < spans; ++s) {
    const double start = layout.nodes.back().x();
    for (int i = 0; i < per_span; ++i) {
      // A single span has a parameter for each half.
      const int material = spans == 1 ? 2 * i / per_span : s;
      if (material == static_cast<int>(layout.materials.size()))
        layout.materials.push_back({fmt::format("part_{}", material + 1), kConcrete_Pa, kConcrete_kg_m3});
      const int from = static_cast<int>(layout.nodes.size()) - 1;
      layout.beams.push_back({from, from + 1, material, 0, false});
      layout.nodes.emplace_back(start + lengths[static_cast<std::size_t>(s)] * (i + 1) / per_span, 0.0);
    }
  }
  layout.zone_m = layout.length_m() / static_cast<double>(layout.beams.size());
  const double bending = kConcrete_Pa * layout.sections[0].inertia_m4, span3 = longest * longest * longest;
  for (int s = 0; s <= spans; ++s) {
    const bool end = s == 0 || s == spans;
    const std::string name = s == 0 ? "abutment_W" : s == spans ? "abutment_E" : fmt::format("pier_{}", s);
    const double k = random.between(6.0, 20.0) * 48.0 * bending / span3;
    layout.bearings.push_back({name, s * per_span, 0.0, k, end ? random.between(0.3, 1.0) * bending / longest : 0.0});
  }
  layout.first_fixed = 0;
  add_girder_quantities(layout, spans);
  place_girder_channels(layout);
  return layout;
}

void add_frame_quantities(Layout& layout) {
  using Of = Quantity::Of;
  for (int m = 0; m < 3; ++m)
    layout.quantities.push_back({"E_" + layout.materials[static_cast<std::size_t>(m)].name, Of::modulus, {m}, {}, 0.7, 1.4});
  layout.quantities.push_back({"m_floors", Of::floors, {}, {}, 0.9, 1.1});
  layout.quantities.push_back({"k_base", Of::springs, {}, {"footing_L_turn", "footing_R_turn"}, 0.3, 3.0});
}

/// One bay; columns and beams one element each, floors as masses at the joints.
Layout draw_frame(Stream& random) {
  Layout layout;
  layout.kind = Kind::frame;
  layout.direction = 0;
  const int storeys = 7 + random.below(2);
  layout.modes = storeys - 1;
  const double height = random.between(3.0, 3.8), bay = random.between(5.0, 7.0), side = random.between(0.33, 0.42);
  layout.span_m = layout.zone_m = height;
  const double beam_depth = random.between(0.45, 0.65);
  layout.sections.push_back({"column", 2.5 * side * side, 2.5 * std::pow(side, 4) / 12.0, side});
  layout.sections.push_back({"beam", 0.35 * beam_depth, 0.35 * std::pow(beam_depth, 3) / 12.0, beam_depth});
  for (const char* name : {"low_columns", "high_columns", "beams"})
    layout.materials.push_back({name, kConcrete_Pa, kConcrete_kg_m3});
  layout.nodes.emplace_back(0.0, 0.0);
  layout.nodes.emplace_back(bay, 0.0);
  for (int s = 0; s < storeys; ++s) {
    const int below = 2 * s, material = 2 * s / storeys;
    for (int c = 0; c < 2; ++c) {
      layout.nodes.emplace_back(c * bay, height * (s + 1));
      layout.beams.push_back({below + c, below + 2 + c, material, 0, true});
      layout.floors.push_back({below + 2 + c, random.between(16e3, 18e3)});
    }
    layout.beams.push_back({below + 2, below + 3, 2, 1, false});
  }
  const double bending = kConcrete_Pa * layout.sections[0].inertia_m4;
  const double turn = random.between(4.0, 10.0) * bending / height,
               along = random.between(5.0, 10.0) * 12.0 * bending / std::pow(height, 3);
  for (int c = 0; c < 2; ++c) layout.bearings.push_back({c == 0 ? "footing_L" : "footing_R", c, along, 15.0 * along, turn});
  for (int s = 1; s <= storeys; ++s) layout.channel_nodes.push_back(2 * s);
  for (int s = storeys; s >= 1 && layout.channel_nodes.size() < 10; s -= 2) layout.channel_nodes.push_back(2 * s + 1);
  add_frame_quantities(layout);
  return layout;
}

void add_springs(const Layout& layout, fe::Model& model) {
  for (const Bearing& bearing : layout.bearings) {
    const auto add = [&](const std::string& group, const char* suffix, const Eigen::Vector3d& direction, bool rotation,
                         double k) {
      if (!(k > 0.0)) return;
      fe::Spring spring;
      spring.name = group + suffix;
      spring.group = group;
      spring.node = bearing.node;
      spring.direction = direction;
      spring.rotation = rotation;
      spring.stiffness = k;
      model.springs.push_back(spring);
    };
    add(bearing.name, "_x", Eigen::Vector3d::UnitX(), false, bearing.x_N_m);
    add(bearing.name, "_z", Eigen::Vector3d::UnitZ(), false, bearing.z_N_m);
    add(bearing.name + "_turn", "_ry", Eigen::Vector3d::UnitY(), true, bearing.turn_N_m);
  }
}

fe::Parameter parameter_of(const Layout& layout, const Quantity& quantity) {
  using Of = Quantity::Of;
  fe::Parameter p;
  p.name = quantity.name;
  p.unit = "-";
  double standing = 1.0;
  if (quantity.of == Of::modulus || quantity.of == Of::density) {
    const bool modulus = quantity.of == Of::modulus;
    p.target = modulus ? fe::Target::youngs_modulus : fe::Target::density;
    p.unit = modulus ? "Pa" : "kg/m3";
    for (const int m : quantity.materials) p.of.push_back(layout.materials[static_cast<std::size_t>(m)].name);
    const Material& first = layout.materials[static_cast<std::size_t>(quantity.materials.front())];
    standing = modulus ? first.youngs_modulus_Pa : first.density_kg_m3;
  } else if (quantity.of == Of::springs) {
    p.target = fe::Target::spring_stiffness;
    p.of = quantity.groups;
  } else {
    p.target = fe::Target::point_mass;
    p.of = {"floors"};
  }
  p.initial = standing;
  p.lower = quantity.lower * standing;
  p.upper = quantity.upper * standing;
  return p;
}

}  // namespace

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::girder_1:
      return "girder of 1 span";
    case Kind::girder_2:
      return "girder of 2 spans";
    case Kind::girder_3:
      return "girder of 3 spans";
    case Kind::frame:
      break;
  }
  return "frame";
}

Layout draw_layout(Kind kind, Stream& random) {
  Layout layout = kind == Kind::frame ? draw_frame(random) : draw_girder(kind, random);
  layout.total_kg = total_mass(layout);
  return layout;
}

fe::Model coarse_model(const Layout& layout) {
  fe::Model model;
  model.title = name_of(layout.kind);
  model.source = "blind trial";
  model.formulation.shear_flexible = false;
  model.formulation.beam_rotary_inertia = false;
  model.prestress.rule = fe::PullRule::none;
  for (std::size_t i = 0; i < layout.nodes.size(); ++i) {
    model.nodes.push_back({static_cast<long>(i) + 1, {layout.nodes[i].x(), 0.0, layout.nodes[i].y()}});
    fe::Support plane{"plane", static_cast<int>(i), {false, true, false, true, false, true}};
    plane.fixed[0] = static_cast<int>(i) == layout.first_fixed;
    model.supports.push_back(plane);
  }
  for (const Material& m : layout.materials)
    model.materials.push_back({m.name, m.youngs_modulus_Pa, m.youngs_modulus_Pa / 2.4, 0.2, m.density_kg_m3});
  for (const Section& s : layout.sections) {
    fe::Section section;
    section.name = s.name;
    section.area_m2 = s.area_m2;
    section.inertia_y_m4 = section.inertia_z_m4 = section.torsion_m4 = s.inertia_m4;
    model.sections.push_back(section);
  }
  for (std::size_t i = 0; i < layout.beams.size(); ++i) {
    const CoarseBeam& beam = layout.beams[i];
    fe::Element element;
    element.id = static_cast<long>(i) + 1;
    element.group = layout.materials[static_cast<std::size_t>(beam.material)].name;
    element.material = beam.material;
    element.section = beam.section;
    element.nodes = {beam.from, beam.to};
    model.elements.push_back(element);
  }
  add_springs(layout, model);
  for (const Floor& floor : layout.floors) model.masses.push_back({"floors", floor.node, floor.kg, Eigen::Vector3d::Zero()});
  for (const Quantity& quantity : layout.quantities) model.parameters.push_back(parameter_of(layout, quantity));
  return model;
}

std::string channel_name(const Layout& layout, int channel) {
  return fmt::format("c{}{}", layout.channel_nodes[static_cast<std::size_t>(channel)] + 1, layout.direction == 0 ? 'x' : 'z');
}

}  // namespace twindeck::blind::form
