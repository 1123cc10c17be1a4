#include <gtest/gtest.h>

#include "matching/shapes_at_sensors.hpp"
#include "unit/fe/assembly_models.hpp"

namespace twindeck::matching {
namespace {

using fe::test::add_node;
using fe::test::cantilever;

constexpr std::array<double, 6> along_z = {0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
using Nodes = std::vector<std::size_t>;

// Oracle: by construction. A tie of the vertical displacements alone: the nodes move as one along z and apart along x.
TEST(ModelPoints, TellNodesThatMoveAsOneAlongASensor) {
  fe::Model built = cantilever();
  const int twin = add_node(built, 4.0, 0.0, 1e-9);
  built.constraints.push_back({"tie", twin, 2, {{2, 2, 1.0}}});
  const ModelPoints points = points_of(&built, {});
  const Nodes there = nodes_at_the_place_of(points, 2);
  EXPECT_EQ(there, (Nodes{2, 3}));
  EXPECT_EQ(nodes_at_the_place_of(points, 1), Nodes{1});
  EXPECT_TRUE(move_as_one(points, there, along_z));
  EXPECT_FALSE(move_as_one(points, there, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0}));
}

// Oracle: the header. The name in points.csv goes before the id, and a node that cannot move is taken only by name.
TEST(ModelPoints, ChooseByNameAndByMotion) {
  fe::Model built = cantilever();
  const auto grounded = static_cast<std::size_t>(add_node(built, 4.0, 0.0, 0.0));
  fe::test::fix(built, static_cast<int>(grounded));
  built.monitoring_points["4"] = 2;
  const ModelPoints points = points_of(&built, {});
  const Nodes there = {2, grounded};
  EXPECT_EQ(possible_nodes(points, there, "p", along_z), Nodes{2});
  EXPECT_EQ(possible_nodes(points, there, "4", along_z), Nodes{2});
  built.monitoring_points.clear();
  EXPECT_EQ(possible_nodes(points_of(&built, {}), there, "4", along_z), Nodes{grounded});
}

}  // namespace
}  // namespace twindeck::matching
