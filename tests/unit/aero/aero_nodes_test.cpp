// Oracles: stations and lengths by hand; a rigid motion of the whole model, which every node must follow; points on a circle,
// whose tangent is known; the same decks numbered otherwise.
#include "aero/aero_nodes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace {

using namespace twindeck;

// A deck with floor beams across it: at each place three nodes (edge, middle, edge) in two elements of the group.
struct FloorBeams {
  fe::Model model;
  explicit FloorBeams(const std::string& source = "deck_model") { model.source = source; }
  int node(const Eigen::Vector3d& x) {
    model.nodes.push_back({static_cast<long>(model.nodes.size()) + 1, x});
    return static_cast<int>(model.nodes.size()) - 1;
  }
  void element(const std::string& group, int a, int b, fe::ElementType type = fe::ElementType::beam) {
    fe::Element e;
    e.group = group;
    e.type = type;
    e.nodes = {a, b};
    model.elements.push_back(e);
  }
  // @return the middle node
  int beam(const Eigen::Vector3d& centre, const Eigen::Vector3d& half_across, const std::string& group = "floor") {
    const int a = node(centre - half_across), m = node(centre), b = node(centre + half_across);
    element(group, a, m);
    element(group, m, b);
    return m;
  }
};

// Stations 0, 4, 10 and 20 m along a straight deck at 30 degrees in plan, 3 % of fall across and 2 % along.
const Eigen::Vector3d straight_along = Eigen::Vector3d(std::cos(30 * radians), std::sin(30 * radians), 0.02).normalized();
const Eigen::Vector3d straight_across = 2.0 * Eigen::Vector3d(-std::sin(30 * radians), std::cos(30 * radians), 0.03);

FloorBeams straight_deck() {
  FloorBeams deck;
  for (const double s : {0.0, 4.0, 10.0, 20.0}) deck.beam(Eigen::Vector3d(5, 6, 7) + s * straight_along, straight_across);
  return deck;
}

Eigen::VectorXd rigid_motion(const fe::Model& model, const Eigen::Vector3d& shift, const Eigen::Vector3d& turn) {
  Eigen::VectorXd u(6 * static_cast<Eigen::Index>(model.nodes.size()));
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    u.segment<6>(6 * static_cast<Eigen::Index>(i)) << shift + turn.cross(model.nodes[i].x_m), turn;
  return u;
}

// By hand: five nodes on 20 m have 4 m each, and stand at 2, 6, 10, 14, 18 m.
TEST(AeroNodes, AreEvenlyLaidBetweenTheCrossSections) {
  const FloorBeams deck = straight_deck();
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck"}, {"floor"}, 5);
  ASSERT_EQ(found.nodes.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const double s = 2.0 + 4.0 * static_cast<double>(i);
    EXPECT_NEAR(found.nodes[i].length_m, 4.0, 1e-13);
    EXPECT_NEAR(found.nodes[i].station_m, s - 10.0, 1e-13);
    EXPECT_LT((found.nodes[i].x_m - (Eigen::Vector3d(5, 6, 7) + s * straight_along)).norm(), 1e-13);
    EXPECT_LT((found.nodes[i].tangent - Eigen::Vector3d(std::cos(30 * radians), std::sin(30 * radians), 0)).norm(), 1e-13);
    EXPECT_EQ(found.nodes[i].deck, "deck");
  }
  EXPECT_EQ(found.motion.rows(), 30);
  EXPECT_EQ(found.motion.cols(), 6 * 12);
}

// u = t + w × x moves each node by t + w × x and turns it by w, on a deck with falls too. The rotation about the vertical is
// left zero.
TEST(AeroNodes, FollowARigidMotionOfTheModel) {
  const FloorBeams deck = straight_deck();
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck"}, {"floor"}, 7);
  const Eigen::Vector3d shift(0.3, -0.2, 0.5), turn(0.7, -0.4, 0.9);
  const Eigen::VectorXd motion = found.motion * rigid_motion(deck.model, shift, turn);
  for (std::size_t i = 0; i < found.nodes.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    EXPECT_LT((motion.segment<3>(row) - shift - turn.cross(found.nodes[i].x_m)).norm(), 1e-13);
    EXPECT_LT((motion.segment<3>(row + 3) - Eigen::Vector3d(0.7, -0.4, 0.0)).norm(), 1e-13);
  }
}

// A deck on an arc of 60 m radius: tangents between the sections lie across the radius, to the order of the chord's square.
TEST(AeroNodes, OnACurvedDeckTheTangentTurnsWithIt) {
  FloorBeams deck;
  const double radius = 60.0;
  const auto on_arc = [&](double angle) { return Eigen::Vector3d(radius * std::sin(angle), radius * std::cos(angle), 0.0); };
  const int sections = 21;
  for (int i = 0; i < sections; ++i) {
    const double angle = -0.5 + i / 20.0;
    deck.beam(on_arc(angle), on_arc(angle) * 2.0 / radius);
  }
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck"}, {"floor"}, 8);
  const double chord = 2.0 * radius * std::sin(0.025);
  const Eigen::Vector3d turn(0.3, 0.8, 0.0);
  const Eigen::VectorXd motion = found.motion * rigid_motion(deck.model, Eigen::Vector3d::Zero(), turn);
  for (std::size_t i = 0; i < 8; ++i) {
    const aero::AeroNode& node = found.nodes[i];
    EXPECT_NEAR(node.length_m, 20 * chord / 8, 1e-12);
    // A chord of 0.05 rad departs from its arc by 0.05²/8 of the radius, and a linear blend of tangents by less.
    EXPECT_NEAR(node.x_m.norm() / radius, 1.0, 3.2e-4);
    EXPECT_NEAR(node.tangent.dot(node.x_m.normalized()), 0.0, 3.2e-4);
    EXPECT_GT(node.tangent.x(), 0.0);
    // Neither the chord nor the line across is along or across the tangent here; the rotation is exact all the same.
    EXPECT_LT((motion.segment<3>(6 * static_cast<Eigen::Index>(i) + 3) - turn).norm(), 1e-13);
  }
}

// Neither the order of elements and nodes nor the sense of a beam matters: sections are put in order along the deck.
TEST(AeroNodes, DoNotDependOnTheNumbering) {
  const aero::AeroNodes expected = aero::find_aero_nodes(straight_deck().model, {"deck"}, {"floor"}, 5);
  FloorBeams shuffled;
  for (const double s : {10.0, 0.0, 20.0, 4.0})
    shuffled.beam(Eigen::Vector3d(5, 6, 7) + s * straight_along, s > 5 ? straight_across : Eigen::Vector3d(-straight_across));
  std::reverse(shuffled.model.elements.begin(), shuffled.model.elements.end());
  const aero::AeroNodes found = aero::find_aero_nodes(shuffled.model, {"deck"}, {"floor"}, 5);
  const Eigen::Vector3d shift(0.1, 0.2, 0.3), turn(0.4, 0.5, 0.0);
  const Eigen::VectorXd a = expected.motion * rigid_motion(straight_deck().model, shift, turn),
                        b = found.motion * rigid_motion(shuffled.model, shift, turn);
  EXPECT_LT((a - b).norm(), 1e-12);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT((found.nodes[i].x_m - expected.nodes[i].x_m).norm(), 1e-13);
    EXPECT_LT((found.nodes[i].tangent - expected.nodes[i].tangent).norm(), 1e-13);
  }
}

// A twist: the edges of one section move by ±2 cm on arms of 2 m, so it turns by 1 % about the axis; half way it is half of it.
// Edge b is to the left of the axis, so its rise turns the deck about the axis in the positive sense.
TEST(AeroNodes, TwistIsTheDifferenceOfTheEdges) {
  FloorBeams deck;
  for (const double s : {0.0, 10.0}) deck.beam({s, 0, 0}, {0, 2, 0});
  Eigen::VectorXd u = Eigen::VectorXd::Zero(36);
  u(6 * 3 + 2) = -0.02;  // right edge of the second section
  u(6 * 5 + 2) = 0.02;   // left edge
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck"}, {"floor"}, 1);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
  expected(3) = 0.005;
  EXPECT_LT((found.motion * u - expected).norm(), 1e-15);
  // A rise of the whole second section: half of it here, and a slope, which is a rotation about -Y.
  u.setZero();
  u(6 * 3 + 2) = u(6 * 5 + 2) = 0.04;
  expected.setZero();
  expected(2) = 0.02;
  expected(4) = -0.004;
  EXPECT_LT((found.motion * u - expected).norm(), 1e-15);
}

// Stays at 4 and 16 m, the second by a rigid link: four nodes of 3 m between them.
TEST(AeroNodes, StandBetweenTheEndStays) {
  FloorBeams deck;
  std::vector<int> middle;
  for (const double s : {0.0, 4.0, 10.0, 16.0, 20.0}) middle.push_back(deck.beam({s, 0, 0}, {0, 2, 0}));
  const int top = deck.node({10, 0, 30}), anchor = deck.node({16, 0, -0.5});
  deck.element("stays", top, middle[1], fe::ElementType::stay);
  deck.element("stays", anchor, top, fe::ElementType::stay);
  deck.model.links.push_back({"link", middle[3], anchor});
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck"}, {"floor"}, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(found.nodes[i].length_m, 3.0, 1e-14);
    EXPECT_NEAR(found.nodes[i].x_m.x(), 5.5 + 3.0 * static_cast<double>(i), 1e-13);
    EXPECT_NEAR(found.nodes[i].station_m, -4.5 + 3.0 * static_cast<double>(i), 1e-13);
  }
}

// Named points on a circle at uneven angles: the tangent lies across the radius at each of them, the ends too, and each has
// half the way to its neighbours.
TEST(AeroNodes, NamedPointsAreTakenWithTheTangentOfTheirCircle) {
  FloorBeams deck;
  const std::vector<double> angles = {-0.5, -0.3, 0.0, 0.25, 0.6};
  const double radius = 40.0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const int at = deck.node({radius * std::sin(angles[i]), radius * std::cos(angles[i]), 0.2 * static_cast<double>(i)});
    deck.model.monitoring_points["aero_deck_0" + std::to_string(i + 1)] = at;
  }
  deck.model.monitoring_points["M1"] = 0;
  for (fe::Node& node : deck.model.nodes) node.x_m.z() = 0.0;
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck"}, {"none"}, 5);
  ASSERT_EQ(found.nodes.size(), 5U);
  std::vector<double> chord;
  for (std::size_t i = 0; i + 1 < 5; ++i) chord.push_back(2 * radius * std::sin(0.5 * (angles[i + 1] - angles[i])));
  const std::vector<double> length = {chord[0], 0.5 * (chord[0] + chord[1]), 0.5 * (chord[1] + chord[2]),
                                      0.5 * (chord[2] + chord[3]), chord[3]};
  for (std::size_t i = 0; i < 5; ++i) {
    const Eigen::Vector3d expected(std::cos(angles[i]), -std::sin(angles[i]), 0.0);
    EXPECT_LT((found.nodes[i].tangent - expected).norm(), 1e-13) << i;
    EXPECT_NEAR(found.nodes[i].length_m, length[i], 1e-13) << i;
  }
  EXPECT_NEAR(found.nodes[4].station_m + found.nodes[0].station_m, 0.0, 1e-13);
  // All six motions are those of the node.
  EXPECT_LT((Eigen::MatrixXd(found.motion) - Eigen::MatrixXd::Identity(30, 30)).norm(), 1e-15);
}

// Two points have no circle: both have the direction of the line between them, and half of its length to either side.
TEST(AeroNodes, TwoNamedPointsHaveTheDirectionOfTheirLine) {
  FloorBeams deck;
  deck.model.monitoring_points["aero_deck_01"] = deck.node({10.0, 4.0, 0.0});
  deck.model.monitoring_points["aero_deck_02"] = deck.node({18.0, 10.0, 0.0});
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck"}, {"none"}, 2);
  ASSERT_EQ(found.nodes.size(), 2U);
  for (const aero::AeroNode& node : found.nodes) {
    EXPECT_LT((node.tangent - Eigen::Vector3d(0.8, 0.6, 0.0)).norm(), 1e-14);
    EXPECT_NEAR(node.length_m, 10.0, 1e-13);
  }
}

// Names that run from east to west are turned, so that nodes follow the deck from west to east.
TEST(AeroNodes, NamedPointsAreTurnedToRunFromWestToEast) {
  FloorBeams deck;
  for (int i = 0; i < 3; ++i) deck.model.monitoring_points["aero_deck_0" + std::to_string(i + 1)] = deck.node({-5.0 * i, 0, 0});
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck"}, {"none"}, 3);
  EXPECT_EQ(found.nodes[0].x_m.x(), -10.0);
  EXPECT_EQ(found.nodes[0].station_m, -5.0);
  EXPECT_LT((found.nodes[0].tangent - Eigen::Vector3d::UnitX()).norm(), 1e-15);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(18);
  u(6 * 2 + 2) = 1.0;  // the westernmost node rises
  const auto motions = aero::motions_of(found, u);
  ASSERT_EQ(motions.size(), 3U);
  EXPECT_EQ(motions[0](2, 0), 1.0);
  EXPECT_EQ(motions[2](2, 0), 0.0);
}

// Numbers without a leading zero: by text aero_deck_10 would come before aero_deck_2. Points 5 m apart have 5 m each. Points of
// a deck whose name begins with this one's, and a name that is no number, do not count.
TEST(AeroNodes, NamedPointsStandInTheOrderOfTheirNumbers) {
  FloorBeams deck;
  for (int i = 0; i < 12; ++i) {
    deck.model.monitoring_points["aero_deck_" + std::to_string(i + 1)] = deck.node({5.0 * i, 0, 0});
    deck.model.monitoring_points["aero_deck_b_" + std::to_string(i + 1)] = deck.node({5.0 * i, 30, 0});
  }
  deck.model.monitoring_points["aero_deck_end"] = deck.node({90, 0, 0});
  const aero::AeroNodes found = aero::find_aero_nodes(deck.model, {"deck", "deck_b"}, {"none", "none"}, 12);
  ASSERT_EQ(found.nodes.size(), 24U);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(found.nodes[i].x_m, Eigen::Vector3d(5.0 * static_cast<double>(i % 12), i < 12 ? 0 : 30, 0)) << i;
    EXPECT_NEAR(found.nodes[i].length_m, 5.0, 1e-13) << i;
  }
  deck.model.monitoring_points["aero_deck_02"] = 0;
  EXPECT_THROW(static_cast<void>(aero::find_aero_nodes(deck.model, {"deck"}, {"none"}, 12)), InputError);
}

// Three points where eight are asked for: both numbers are told, and not that there are no points.
TEST(AeroNodes, ANumberOfPointsThatIsNotTheOneAskedForIsTold) {
  FloorBeams deck;
  for (int i = 0; i < 3; ++i) deck.model.monitoring_points["aero_deck_" + std::to_string(i + 1)] = deck.node({5.0 * i, 0, 0});
  try {
    static_cast<void>(aero::find_aero_nodes(deck.model, {"deck"}, {"none"}, 8));
    ADD_FAILURE();
  } catch (const InputError& error) {
    const std::string told = error.what();
    EXPECT_NE(told.find("3 points aero_deck_<number> where nodes_per_deck asks for 8"), std::string::npos) << told;
    EXPECT_NE(told.find("set nodes_per_deck to the number of points (3)"), std::string::npos) << told;
    EXPECT_EQ(told.find("aero_deck_01"), std::string::npos) << told;
  }
}

TEST(AeroNodes, ADeckWithoutCrossSectionsIsRefused) {
  FloorBeams deck("bridges/one");
  deck.beam({0, 0, 0}, {0, 2, 0});
  // One line across, one name, or a number of names that is not the number asked for.
  deck.model.monitoring_points["aero_deck_01"] = 0;
  try {
    static_cast<void>(aero::find_aero_nodes(deck.model, {"deck"}, {"floor"}, 3));
    ADD_FAILURE();
  } catch (const InputError& error) {
    const std::string told = error.what();
    EXPECT_NE(told.find("bridges/one"), std::string::npos) << told;
    EXPECT_NE(told.find("deck deck"), std::string::npos) << told;
    EXPECT_NE(told.find("has 1 lines of elements 'floor' across it, expected at least 2"), std::string::npos) << told;
    EXPECT_NE(told.find("nodes_per_deck asks for 3"), std::string::npos) << told;
  }
  try {
    static_cast<void>(aero::find_aero_nodes(deck.model, {"other"}, {"floor"}, 3));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("give points aero_other_01"), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(aero::find_aero_nodes(straight_deck().model, {"deck"}, {"other"}, 3)), InputError);
}

// Two decks, each with its own group; strips know their section by the place of the deck in the list, and their yaw by hand.
TEST(AeroNodes, StripsTakeTheirDeckAndYaw) {
  FloorBeams decks;
  for (const double s : {0.0, 10.0}) {
    decks.beam({s, 0, 0}, {0, 2, 0}, "floor_a");
    decks.beam({s * std::cos(0.3), 20 + s * std::sin(0.3), 0}, {-std::sin(0.3), std::cos(0.3), 0}, "floor_b");
  }
  const aero::AeroNodes nodes = aero::find_aero_nodes(decks.model, {"b", "a"}, {"floor_b", "floor_a"}, 2);
  const std::vector<aero::Strip> strips = aero::strips_of(nodes, {"a", "b"}, {1.25, Eigen::Vector3d::UnitY()});
  ASSERT_EQ(strips.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(strips[i].deck, i < 2 ? "b" : "a");
    EXPECT_EQ(strips[i].section, i < 2 ? 1 : 0);
    EXPECT_NEAR(strips[i].yaw_rad, i < 2 ? -0.3 : 0.0, 1e-14);
    EXPECT_EQ(strips[i].station_m, nodes.nodes[i].station_m);
    EXPECT_EQ(strips[i].length_m, nodes.nodes[i].length_m);
    EXPECT_EQ(strips[i].x_m, nodes.nodes[i].x_m);
  }
}

}  // namespace
