// Oracles: paper Eqs. (3) and (4) by hand on diagrams of a few poles; medians and deviations of small lists.
#include "identification/clustering.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace twindeck::identification {
namespace {

/// A stable pole with the shape (cos angle, sin angle) times a factor of modulus one.
DiagramPole stable_pole(int order, double frequency_Hz, double angle = 0.0, double phase = 0.0) {
  DiagramPole at;
  at.pole.order = order;
  at.pole.frequency_Hz = frequency_Hz;
  at.pole.damping_ratio = 0.01;
  at.pole.shape = Eigen::Vector2cd(std::cos(angle), std::sin(angle)) * std::polar(1.0, phase);
  at.stable_frequency = at.stable_damping = at.stable_shape = true;
  return at;
}

std::vector<int> orders_to(int last) {
  std::vector<int> orders;
  for (int order = 2; order <= last; order += 2) orders.push_back(order);
  return orders;
}

constexpr double kRightAngle = 0.5 * std::numbers::pi;

/// Two modes at each of `n` orders: 3 Hz first, then 1 Hz.
std::vector<DiagramPole> two_modes(int n) {
  std::vector<DiagramPole> diagram;
  for (int k = 1; k <= n; ++k) {
    diagram.push_back(stable_pole(2 * k, 3.0, kRightAngle));
    diagram.push_back(stable_pole(2 * k, 1.0));
  }
  return diagram;
}

TEST(IdentifyClusters, ModesComeAscendingInFrequencyAndMarkTheirPoles) {
  auto diagram = two_modes(8);
  const auto clusters = identify_clusters(diagram, orders_to(16), {});
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_EQ(clusters[0].frequency_Hz, 1.0);
  EXPECT_EQ(clusters[1].frequency_Hz, 3.0);
  for (std::size_t i = 0; i < diagram.size(); ++i) EXPECT_EQ(diagram[i].mode, i % 2 == 0 ? 1 : 0);
  EXPECT_EQ(clusters[0].members, (std::vector<std::size_t>{1, 3, 5, 7, 9, 11, 13, 15}));
}

// C_i > 5 is exclusive: five poles that agree have C = 5 and are spurious, six are a mode.
TEST(IdentifyClusters, TheIndexOfRecursionMustExceedItsBound) {
  CleaningRule rule;
  rule.share = 0.0;
  auto five = two_modes(5), six = two_modes(6);
  EXPECT_TRUE(identify_clusters(five, orders_to(12), rule).empty());
  EXPECT_EQ(identify_clusters(six, orders_to(12), rule).size(), 2U);
  for (const DiagramPole& pole : five) EXPECT_EQ(pole.mode, -1);
}

// Six poles from order 2 on are 40 % of 15 orders, not of 16.
TEST(IdentifyClusters, AModeIsFoundAtItsShareOfTheOrders) {
  auto enough = two_modes(6), few = two_modes(6);
  EXPECT_EQ(identify_clusters(enough, orders_to(30), {}).size(), 2U);
  EXPECT_TRUE(identify_clusters(few, orders_to(32), {}).empty());
}

// Orders below a mode's first one do not count against it.
TEST(IdentifyClusters, TheShareCountsFromTheFirstOrderOn) {
  std::vector<DiagramPole> diagram;
  for (int order = 50; order <= 60; order += 2) diagram.push_back(stable_pole(order, 1.0));
  EXPECT_EQ(identify_clusters(diagram, orders_to(60), {}).size(), 1U);  // six of six
}

// One shape at two frequencies is two modes; by the paper's rule (any frequency) it is one.
TEST(IdentifyClusters, OneShapeAtTwoFrequenciesIsTwoModesUnlessThePapersRuleIsAsked) {
  std::vector<DiagramPole> diagram;
  for (int k = 1; k <= 7; ++k) {
    diagram.push_back(stable_pole(2 * k, 1.0));
    diagram.push_back(stable_pole(2 * k, 2.0));
  }
  auto again = diagram;
  EXPECT_EQ(identify_clusters(diagram, orders_to(14), {}).size(), 2U);
  CleaningRule papers;
  papers.frequency = 1e9;
  EXPECT_EQ(identify_clusters(again, orders_to(14), papers).size(), 1U);
}

TEST(IdentifyClusters, OnlyStablePolesWithAShapeCount) {
  auto diagram = two_modes(6);
  diagram[1].stable_damping = false;  // 1 Hz: five are left
  diagram[2].pole.shape.setZero();    // 3 Hz: five are left
  EXPECT_TRUE(identify_clusters(diagram, orders_to(12), {}).empty());
  std::vector<DiagramPole> none;
  EXPECT_TRUE(identify_clusters(none, orders_to(12), {}).empty());
}

// Two like poles of one order count as one member, so that six poles at three orders are no mode.
TEST(IdentifyClusters, TwoPolesOfOneOrderAreOneMember) {
  std::vector<DiagramPole> diagram;
  for (int k = 1; k <= 3; ++k) {
    diagram.push_back(stable_pole(2 * k, 1.0));
    diagram.push_back(stable_pole(2 * k, 1.001));
  }
  EXPECT_TRUE(identify_clusters(diagram, orders_to(6), {}).empty());
}

TEST(OneAnOrder, KeepsThePoleNearestInShape) {
  const std::vector<DiagramPole> diagram = {stable_pole(4, 1.0, 0.3), stable_pole(4, 1.0, -0.1, 2.0), stable_pole(2, 1.0, 0.2),
                                            stable_pole(6, 1.0, 0.0)};
  // Ascending in order: 2 has one pole, of order 4 the second is 0.1 from the seed, 6 is the seed itself.
  EXPECT_EQ(one_an_order(diagram, {0, 1, 2, 3}, 3), (std::vector<std::size_t>{2, 1, 3}));
  EXPECT_EQ(one_an_order(diagram, {1, 0, 2, 3}, 3), (std::vector<std::size_t>{2, 1, 3}));
}

TEST(PossibleOrders, CountsFromTheLowestMemberOn) {
  const std::vector<DiagramPole> diagram = {stable_pole(8, 1.0), stable_pole(4, 1.0)};
  EXPECT_EQ(possible_orders(diagram, {0, 1}, {2, 4, 6, 8, 10}), 4U);
  EXPECT_EQ(possible_orders(diagram, {0}, {2, 4, 6, 8, 10}), 2U);
}

// Frequencies 1.0, 1.1, 1.5: median 1.1, mean 1.2, deviation sqrt((0.04 + 0.01 + 0.09) / 2) = sqrt(0.07).
TEST(Summarise, MedianAndDeviationByHand) {
  std::vector<DiagramPole> diagram = {stable_pole(2, 1.5), stable_pole(4, 1.0), stable_pole(6, 1.1)};
  diagram[0].pole.damping_ratio = 0.02;
  diagram[1].pole.damping_ratio = 0.04;
  diagram[2].pole.damping_ratio = 0.03;
  const Cluster cluster = summarise(diagram, {2, 0, 1});
  EXPECT_EQ(cluster.members, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(cluster.frequency_Hz, 1.1);
  EXPECT_EQ(cluster.damping_ratio, 0.03);
  EXPECT_NEAR(cluster.frequency_scatter_Hz, std::sqrt(0.07), 1e-15);
  EXPECT_NEAR(cluster.damping_ratio_scatter, 0.01, 1e-15);
  EXPECT_EQ(cluster.representative, 2U);  // it is both medians
}

TEST(Summarise, OneMemberIsItselfWithoutScatter) {
  const std::vector<DiagramPole> diagram = {stable_pole(2, 1.5, 0.4, 1.0)};
  const Cluster cluster = summarise(diagram, {0});
  EXPECT_EQ(cluster.frequency_Hz, 1.5);
  EXPECT_EQ(cluster.frequency_scatter_Hz, 0.0);
  EXPECT_LT((cluster.shape - Eigen::Vector2cd(std::cos(0.4), std::sin(0.4))).norm(), 1e-14);
}

// Each pole's shape has a phase of its own; the median is that of the shapes when they are turned alike. Angles 0.3, 0.4, 1.2:
// both components are monotonic in the angle, so that the median is the shape at 0.4.
TEST(Summarise, ShapesAreTurnedAlikeAndOneOutlierDoesNotCount) {
  const std::vector<DiagramPole> diagram = {stable_pole(2, 1.0, 0.3, 0.7), stable_pole(4, 1.0, 0.4, -2.0),
                                            stable_pole(6, 1.0, 1.2, 3.0)};
  const Cluster cluster = summarise(diagram, {0, 1, 2});
  EXPECT_LT((cluster.shape - Eigen::Vector2cd(std::cos(0.4), std::sin(0.4))).norm(), 1e-14);
}

// Like members of an even number: the first represents, in whatever order they are given.
TEST(Summarise, OfMembersAtOneDistanceTheFirstRepresents) {
  const std::vector<DiagramPole> diagram = {stable_pole(2, 1.02), stable_pole(4, 1.0)};
  EXPECT_EQ(summarise(diagram, {0, 1}).representative, 0U);
  EXPECT_EQ(summarise(diagram, {1, 0}).representative, 0U);
}

}  // namespace
}  // namespace twindeck::identification
