// The study's bridge at its full size. Oracles: counts and places that the paper prints (27,093 degrees of freedom, 30
// aerodynamic nodes a deck, the yaw limits of Table 14), places of the records' channels, symmetry, and equal masses of coarse
// and fine meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/error.hpp"
#include "fe/static_stage.hpp"
#include "fe/structure.hpp"
#include "io/csv.hpp"
#include "ponte/generator.hpp"
#include "test_places.hpp"

namespace twindeck::ponte {
namespace {

const std::filesystem::path kFullBridge = std::filesystem::path(TWINDECK_SOURCE_DIR) / "data/ponte_del_mare/bridge.toml";

const fe::Model& full() {
  static const fe::Model model = generate(kFullBridge, "refined");
  return model;
}

Eigen::Vector3d position(const fe::Model& m, int node) { return m.nodes[static_cast<std::size_t>(node)].x_m; }

TEST(FullBridge, HasAtLeastTheDegreesOfFreedomOfThePaper) {
  for (const std::string variant : {"preliminary", "refined"}) {
    const fe::Structure structure(generate(kFullBridge, variant));
    EXPECT_GE(structure.system({}).size(), 27000) << variant;
  }
}

TEST(FullBridge, HasEveryPart) {
  std::map<std::string, std::set<fe::ElementType>> types;
  for (const fe::Element& e : full().elements) types[part_of(e.group)].insert(e.type);
  using enum fe::ElementType;
  EXPECT_EQ(types.at("decks"), (std::set{beam, shell}));
  EXPECT_EQ(types.at("end_blocks"), (std::set{beam, solid}));
  EXPECT_EQ(types.at("piers"), std::set{beam});
  EXPECT_EQ(types.at("ramps"), std::set{beam});
  EXPECT_EQ(types.at("mast"), std::set{beam});
  EXPECT_EQ(types.at("stays"), std::set{stay});
  EXPECT_FALSE(types.contains("other"));
}

TEST(FullBridge, IsSymmetricAboutMidLength) {
  std::set<std::array<long, 3>> seen;
  const auto key = [](const Eigen::Vector3d& p) {
    return std::array<long, 3>{std::lround(p.x() * 1e6), std::lround(p.y() * 1e6), std::lround(p.z() * 1e6)};
  };
  for (const fe::Node& n : full().nodes) seen.insert(key(n.x_m));
  for (const fe::Node& n : full().nodes) EXPECT_TRUE(seen.contains(key({-n.x_m.x(), n.x_m.y(), n.x_m.z()}))) << n.id;
}

TEST(FullBridge, PutsThirtyAerodynamicNodesOnEachDeckBetweenTheEndStays) {
  struct Deck {
    std::string name;
    double radius_m, end_y_m, half_angle, yaw_limit_deg;
  };
  // Table 14: 54.69 and 54.09 degrees on the foot deck, 36.56 on the cycle deck; the reconstructed stays stand within 1 degree.
  for (const Deck& deck : {Deck{"foot", 80.0, 0.0, 86.5 / 80.0, 54.4}, Deck{"cycle", 100.0, -2.0, 0.74, 36.56}}) {
    std::set<int> nodes;
    double last = -1e9;
    for (int i = 1; i <= 30; ++i) {
      const std::string name = "aero_" + deck.name + (i < 10 ? "_0" : "_") + std::to_string(i);
      ASSERT_TRUE(full().monitoring_points.contains(name)) << name;
      const int node = full().monitoring_points.at(name);
      const Eigen::Vector3d at = position(full(), node);
      const Eigen::Vector2d from_centre(at.x(), at.y() - deck.end_y_m + deck.radius_m * std::cos(deck.half_angle));
      EXPECT_NEAR(from_centre.norm(), deck.radius_m, 1e-6) << name;  // on the deck's axis
      const double yaw = std::atan2(from_centre.x(), from_centre.y()) * 180.0 / M_PI;
      EXPECT_GT(yaw, last) << name;  // from south to north
      // The outermost stand half a length inside the end stays.
      if (i == 1 || i == 30) {
        EXPECT_NEAR(std::abs(yaw), deck.yaw_limit_deg * 29.0 / 30.0, 1.0) << name;
      }
      last = yaw;
      nodes.insert(node);
    }
    EXPECT_EQ(nodes.size(), 30u);
  }
  EXPECT_EQ(full().monitoring_points.size(), 68u);  // and M1 to M8
}

TEST(FullBridge, PutsAccelerometersWhereTheirRecordsComeFrom) {
  // Oracle: the places in the records' own table. Rows of slab nodes are at most 0.38 m apart, so half of that is allowed.
  const auto channels = io::CsvTable::read(
      std::filesystem::path(TWINDECK_SOURCE_DIR) / "data/ponte_del_mare/features/channels.csv",
      {"channel", "x_m", "y_m", "z_m"}, {"point", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role"});
  ASSERT_EQ(channels.rows(), 8u);
  for (std::size_t row = 0; row < channels.rows(); ++row) {
    const std::string name = channels.text(row, "channel");
    const Eigen::Vector3d at(channels.number(row, "x_m"), channels.number(row, "y_m"), channels.number(row, "z_m"));
    EXPECT_LT((position(full(), full().monitoring_points.at(name)) - at).norm(), 0.19) << name;
  }
}

/// All of its weight, what lies on supports included.
double weight_of(const fe::Model& model) {
  const Eigen::VectorXd load = fe::dead_load(model);
  double weight = 0.0;
  for (Eigen::Index i = 2; i < load.size(); i += 6) weight -= load[i];
  return weight;
}

TEST(FullBridge, CoarseMeshIsTheSameBridge) {
  const fe::Model coarse = generate(kFullBridge, "refined", "coarse");
  EXPECT_LT(coarse.nodes.size(), full().nodes.size() / 3);
  EXPECT_EQ(coarse.monitoring_points.size(), full().monitoring_points.size());
  // Chords instead of the arc make the decks a little shorter.
  EXPECT_NEAR(weight_of(coarse) / weight_of(full()), 1.0, 1e-3);
}

TEST(FullBridge, RefusesAMeshThatIsNotThere) {
  try {
    static_cast<void>(generate(kFullBridge, "refined", "coarze"));
    FAIL() << "an unknown mesh was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("coarse"), std::string::npos) << error.what();
  }
}

TEST(FullBridge, ReplacesValuesByPath) {
  const fe::Model changed = generate_with_values(kFullBridge, "refined", "coarse", {{"mast.steel_scale", 1.2}});
  const auto area = [](const fe::Model& m) {
    return std::find_if(m.sections.begin(), m.sections.end(), [](const auto& s) { return s.name == "mast_steel"; })->area_m2;
  };
  // Oracle: a tube of 1.5 m and 30 mm times 1.2.
  EXPECT_NEAR(area(changed), 1.2 * M_PI * 0.030 * (1.5 - 0.030), 1e-9);
  EXPECT_THROW(static_cast<void>(generate_with_values(kFullBridge, "refined", "coarse", {{"mast.no", 1.0}})), InputError);
}

}  // namespace
}  // namespace twindeck::ponte
