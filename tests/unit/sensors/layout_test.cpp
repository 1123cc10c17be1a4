#include "sensors/layout.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace twindeck::sensors {
namespace {

using Eigen::Vector3d;

LayoutChannel of_setup(const std::string& setup, const std::string& channel) {
  LayoutChannel row;
  row.setup = setup;
  row.channel = channel;
  return row;
}

// Oracle: the definition. Vertical is the global z, whatever the point; radial is the point's own direction.
TEST(ChannelAt, TakesItsDirectionFromThePoint) {
  const LayoutPoint point{"F7", "foot_inner", 12.0, {1.0, 2.0, 3.0}, {0.6, -0.8, 0.0}};
  const LayoutChannel vertical = channel_at(point, "vertical", "F7z"), radial = channel_at(point, "radial", "F7r");
  EXPECT_EQ(vertical.cosines, Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(radial.cosines, Vector3d(0.6, -0.8, 0.0));
  EXPECT_EQ(radial.x_m, Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(radial.point, "F7");
  EXPECT_EQ(radial.channel, "F7r");
  EXPECT_EQ(radial.direction, "radial");
}

// Oracle: the order of the file, read by eye, although rows of setups stand mixed.
TEST(ChannelsOf, KeepTheOrderOfTheFile) {
  const std::vector<LayoutChannel> all = {of_setup("B", "1"), of_setup("A", "2"), of_setup("B", "3"), of_setup("A", "4")};
  EXPECT_EQ(setup_names(all), (std::vector<std::string>{"B", "A"}));
  const std::vector<LayoutChannel> of_a = channels_of(all, "A");
  ASSERT_EQ(of_a.size(), 2U);
  EXPECT_EQ(of_a[0].channel, "2");
  EXPECT_EQ(of_a[1].channel, "4");
}

// Oracle: the words of the refusal.
TEST(ChannelsOf, RefuseAnUnknownSetup) {
  try {
    (void)channels_of({of_setup("B", "1"), of_setup("A", "2")}, "C");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "setup: 'C' is not in the layout, which has B, A; name one of them");
  }
}

fe::Model nodes_on_a_line() {
  fe::Model model;
  model.source = "line";
  for (int i = 0; i < 4; ++i) model.nodes.push_back({10 * i, Vector3d(2.0 * i, 1.0, -1.0)});
  return model;
}

// Oracle: distances by hand. Nodes stand at x = 0, 2, 4, 6 m; places between them go to the nearer one, in the order asked for.
TEST(NodesAt, AreTheNearest) {
  const std::vector<Vector3d> places = {{5.1, 1.0, -1.0}, {0.9, 1.0, -1.0}, {2.0, 1.3, -1.4}, {9.0, 1.0, -1.0}};
  EXPECT_EQ(nodes_at(nodes_on_a_line(), places, 3.1), (std::vector<int>{3, 0, 1, 3}));
  EXPECT_TRUE(nodes_at(nodes_on_a_line(), {}, 0.1).empty());
}

// Oracle: distances by hand. (4, 1.3, -0.6) lies 0.5 m from the third node.
TEST(NodesAt, HoldAtTheTolerance) {
  EXPECT_EQ(nodes_at(nodes_on_a_line(), {{4.0, 1.3, -0.6}}, 0.51), std::vector<int>{2});
  try {
    (void)nodes_at(nodes_on_a_line(), {{4.0, 1.3, -0.6}}, 0.49);
    FAIL();
  } catch (const InputError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("line: points: (4.00, 1.30, -0.60) m lies 0.50 m from the nearest node, expected at most 0.49 m"),
              std::string::npos)
        << words;
  }
  EXPECT_THROW((void)nodes_at(fe::Model(), {Vector3d::Zero()}, 1.0), InputError);
}

}  // namespace
}  // namespace twindeck::sensors
