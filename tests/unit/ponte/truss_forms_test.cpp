// The forms of the truss that a definition may leave out. Oracles: numbers of members counted by hand for the prototype's 69
// stations, places by the section's geometry, and that no form is a mechanism.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "fe/assembly.hpp"
#include "ponte/generator.hpp"
#include "prototype_bridge.hpp"

namespace twindeck::ponte {
namespace {

const std::filesystem::path kFormsFile = twindeck::tests::prototype_toml();

fe::Model formed(const Values& values) { return generate_with_values(kFormsFile, "refined", "", values); }

std::map<std::string, int> elements_by_group(const fe::Model& model) {
  std::map<std::string, int> out;
  for (const fe::Element& element : model.elements) ++out[element.group];
  return out;
}

Eigen::Vector3d place(const fe::Model& model, int node) { return model.nodes[static_cast<std::size_t>(node)].x_m; }

TEST(TrussForms, LeftOutMeansATriangleWithTheSlabInThePlaneOfItsChords) {
  const fe::Model without = generate(kFormsFile, "refined");
  const fe::Model with = formed({{"deck.foot.bottom_chord_spacing", 0.0}, {"deck.foot.slab_height", 0.0}});
  ASSERT_EQ(without.nodes.size(), with.nodes.size());
  for (std::size_t i = 0; i < with.nodes.size(); ++i) EXPECT_EQ(without.nodes[i].x_m, with.nodes[i].x_m);
  EXPECT_EQ(elements_by_group(without), elements_by_group(with));
}

TEST(TrussForms, TwoBottomChordsAreBraced) {
  const fe::Model model = formed({{"deck.foot.bottom_chord_spacing", 3.0}, {"deck.foot.bottom_chord_offset", 0.0}});
  std::map<std::string, int> count = elements_by_group(model);
  // 69 stations, 68 panels. Chords 2 a panel; posts 2 and a brace a station; long diagonals 2 and one in the bottom plane a
  // panel; floor beams in 4 pieces and a strut a station.
  EXPECT_EQ(count["foot_bottom_chord"], 2 * 68);
  EXPECT_EQ(count["foot_short_diagonal"], 3 * 69);
  EXPECT_EQ(count["foot_long_diagonal"], 3 * 68);
  EXPECT_EQ(count["foot_floor_beam"], 5 * 69);
  EXPECT_EQ(count["cycle_bottom_chord"], 58) << "the other deck stays as it is";
  // With chords 3 m apart below chords 3 m apart posts stand upright; a brace crosses the rectangle of 3 m by the depth.
  const double depth = 1.8113321;
  int upright = 0, across = 0;
  for (const fe::Element& element : model.elements) {
    if (element.group != "foot_short_diagonal") continue;
    const Eigen::Vector3d d = place(model, element.nodes[1]) - place(model, element.nodes[0]);
    EXPECT_NEAR(d.z(), depth, 1e-9);
    upright += d.head<2>().norm() < 1e-9;
    across += std::abs(d.head<2>().norm() - 3.0) < 1e-9;
  }
  EXPECT_EQ(upright, 2 * 69);
  EXPECT_EQ(across, 69);
  // Both chords together stand on what one stood on: 488 MN/m in each direction.
  double radial = 0.0;
  for (const fe::Spring& spring : model.springs)
    radial += spring.name.starts_with("foot_north_bottom") && spring.name.ends_with("radial") ? spring.stiffness : 0.0;
  EXPECT_NEAR(radial, 488.42144e6, 1.0);
  EXPECT_NO_THROW(fe::check_no_mechanism(fe::assemble(model, {}), fe::initial_parameters(model), model.source));
}

TEST(TrussForms, ASlabAboveItsChordsMovesWithThemAsARigidBody) {
  const fe::Model flat = formed({});
  const fe::Model model = formed({{"deck.foot.slab_height", 0.2}});
  std::map<int, int> slab_node_of;  // chord node -> slab node
  for (const fe::RigidLink& link : model.links) {
    if (link.name.starts_with("slab_joint_foot")) slab_node_of[link.slave] = link.master;
  }
  EXPECT_EQ(slab_node_of.size(), 2u * 69u);
  EXPECT_EQ(model.nodes.size(), flat.nodes.size() + slab_node_of.size());
  for (const auto& [chord, slab] : slab_node_of) {
    EXPECT_LT((place(model, slab) - place(model, chord) - Eigen::Vector3d(0.0, 0.0, 0.2)).norm(), 1e-12);
  }
  for (const fe::Element& element : model.elements) {
    if (element.group != "foot_top_chord") continue;
    for (const int node : element.nodes) EXPECT_TRUE(slab_node_of.contains(node));
  }
  EXPECT_NO_THROW(fe::check_no_mechanism(fe::assemble(model, {}), fe::initial_parameters(model), model.source));
}

TEST(TrussForms, ANegativeHeightIsRefused) {
  try {
    (void)formed({{"deck.foot.slab_height", -0.1}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("deck.foot.slab_height"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace twindeck::ponte
