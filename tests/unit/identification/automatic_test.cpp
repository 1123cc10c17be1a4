// Oracle: diagrams made by hand. Two modes whose mixture stands alone at small orders give two modes; a third shape gives
// three.
#include "identification/automatic.hpp"

#include <gtest/gtest.h>

#include "../signal/noise.hpp"

namespace twindeck::identification {
namespace {

constexpr Eigen::Index kChannelsOfDiagram = 8;

Eigen::VectorXcd scattered(const Eigen::VectorXd& shape, double noise, signal::test::Noise& random) {
  Eigen::VectorXcd result = shape.normalized().cast<std::complex<double>>();
  for (std::complex<double>& x : result) {
    const double imaginary = random(), real = random();  // compilers choose the order of a call's arguments
    x += noise * std::complex<double>(real, imaginary);
  }
  return normalised_shape(result);
}

// Poles of a mode 0.057 from those of the order before, others 0.3: the boundary lies between, at 0.13, well above the smallest
// cut of 0.05.
TEST(AutomaticClusters, AModeWhosePolesScatterBeyondTheSmallestCutIsFound) {
  std::vector<DiagramPole> diagram;
  std::vector<int> orders;
  for (int order = 2; order <= 60; order += 2) {
    orders.push_back(order);
    for (const double squared : {0.03, 0.195}) {  // 1 - MAC = 1 - (1 + squared)^-2
      Pole pole{};
      pole.order = order;
      pole.frequency_Hz = squared < 0.1 ? 2.0 : 4.0;
      pole.damping_ratio = 0.01;
      const Eigen::VectorXd aside = Eigen::VectorXd::Unit(kChannelsOfDiagram, (order / 2) % 7 + 1);
      pole.shape = normalised_shape(Eigen::VectorXd(Eigen::VectorXd::Unit(kChannelsOfDiagram, 0) + std::sqrt(squared) * aside)
                                        .cast<std::complex<double>>());
      diagram.push_back({pole});
    }
  }
  const std::vector<Cluster> clusters = automatic_clusters(diagram, orders, {});
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_EQ(clusters[0].frequency_Hz, 2.0);
  EXPECT_GE(clusters[0].members.size(), 28U);
}

/// Modes at 2.00 and 2.10 Hz at orders 26 to 60, a pole between them at orders 8 to 36, a mode at 3 Hz at all orders.
std::size_t modes_with(const Eigen::VectorXd& between) {
  signal::test::Noise random(5);
  const Eigen::VectorXd first = Eigen::VectorXd::Unit(kChannelsOfDiagram, 0),
                        second = Eigen::VectorXd::Unit(kChannelsOfDiagram, 1);
  std::vector<DiagramPole> diagram;
  std::vector<int> orders;
  const auto add = [&](int order, double f, double zeta, const Eigen::VectorXd& shape) {
    Pole pole;
    pole.order = order;
    pole.frequency_Hz = f * (1.0 + 0.0005 * random());
    pole.damping_ratio = zeta;
    pole.shape = scattered(shape, 0.01, random);
    diagram.push_back({pole});
  };
  for (int order = 2; order <= 60; order += 2) {
    orders.push_back(order);
    add(order, 3.0, 0.01, Eigen::VectorXd::Unit(kChannelsOfDiagram, 4));
    if (order >= 8 && order <= 36) add(order, 2.05, 0.025, between);
    if (order >= 26) add(order, 2.0, 0.008, first);
    if (order >= 26) add(order, 2.1, 0.008, second);
    Eigen::VectorXd any(kChannelsOfDiagram);  // a pole of the noise
    for (double& x : any) x = random();
    add(order, 5.0 + random(), 0.05, any);
  }
  return automatic_clusters(diagram, orders, {}).size();
}

TEST(AutomaticClusters, AMixtureOfTwoNeighboursIsTheirs) {
  const Eigen::VectorXd mixture = Eigen::VectorXd::Unit(kChannelsOfDiagram, 0) + Eigen::VectorXd::Unit(kChannelsOfDiagram, 1);
  EXPECT_EQ(modes_with(mixture), 3U);
}

TEST(AutomaticClusters, AModeBetweenTwoOthersWithAShapeOfItsOwnStays) {
  EXPECT_EQ(modes_with(Eigen::VectorXd::Unit(kChannelsOfDiagram, 2)), 4U);
  // Half of its shape is theirs: a mode still.
  const Eigen::VectorXd half = Eigen::VectorXd::Unit(kChannelsOfDiagram, 0) + Eigen::VectorXd::Unit(kChannelsOfDiagram, 2);
  EXPECT_EQ(modes_with(half), 4U);
}

/// Two poles of like shape (MAC 0.88), a quarter of a bandwidth apart, from an order on.
std::size_t modes_of_a_close_pair(int first_order) {
  signal::test::Noise random(9);
  const Eigen::VectorXd first = Eigen::VectorXd::Unit(kChannelsOfDiagram, 0),
                        second = first + 0.37 * Eigen::VectorXd::Unit(kChannelsOfDiagram, 1);
  std::vector<DiagramPole> diagram;
  std::vector<int> orders;
  for (int order = 2; order <= 60; order += 2) {
    orders.push_back(order);
    for (int k = 0; k < 2; ++k) {
      if (k == 1 && order < first_order) continue;
      Pole pole;
      pole.order = order;
      pole.frequency_Hz = (k == 0 ? 2.0 : 2.01) * (1.0 + 0.0001 * random());
      pole.damping_ratio = 0.01;
      pole.shape = scattered(k == 0 ? first : second, 0.003, random);
      diagram.push_back({pole});
    }
  }
  return automatic_clusters(diagram, orders, {}).size();
}

TEST(AutomaticClusters, TwoPolesOfLikeShapeAtMostOrdersAreTwoModes) {
  EXPECT_EQ(modes_of_a_close_pair(20), 2U);
  EXPECT_EQ(modes_of_a_close_pair(40), 1U);
}

}  // namespace
}  // namespace twindeck::identification
