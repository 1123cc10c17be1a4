// Oracles: springs in a row under point loads, solved by hand; equilibrium; central differences.
#include <gtest/gtest.h>

#include "hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::GroundState;
using diagnosis::LoadTests;
using diagnosis::RowType;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kA = 3e6, kPier = 2e6, kLoad = 5e4, kHand = 1e-12;

/// Wall, spring a, dof 0, spring a, dof 1 on a pier. The pier's spring is the parameter "pier". Case "push" loads dof 0, case
/// "lift" raises the ground by 3 mm.
class WallAndPier {
 public:
  explicit WallAndPier(bool gauged = true)
      : model(nodes_in_a_row(2), frame(), 1000.0 * MatrixXd::Identity(2, 2),
              {{{"pier", fe::Target::matrix_stiffness, {}, "-", 1.0, 0.5, 1.5}, pier()}}, with_pier, tests()) {
    for (const char* load : {"push", "lift"}) {
      if (std::string(load) == "push")
        model.features.conditions[0].name = load;
      else
        model.add_condition(load);
      model.features.conditions.back().load = load;
      model.add_row(RowType::static_displacement, "", 0, 0.01);
      model.add_row(RowType::static_displacement, "", 1, 0.01);
      model.add_row(RowType::static_rotation, "", 0, 0.01);
      model.add_row(RowType::static_strain, "", 1, 0.01);
      if (gauged) model.add_row(RowType::static_force, "", 1, 1e4, 100.0);
    }
  }
  static MatrixXd frame() { return (MatrixXd(2, 2) << 2.0 * kA, -kA, -kA, kA).finished(); }
  static MatrixXd pier() { return (MatrixXd(2, 2) << 0, 0, 0, kPier).finished(); }
  static void with_pier(diagnosis::Places& places) {
    diagnosis::Place support;
    support.id = "support:pier";
    support.stiffness = diagnosis::Symmetric(pier().sparseView());
    places.sets["supports"] = {support};
  }
  static LoadTests tests() {
    LoadTests out;
    out.cases = {"push", "lift"};
    out.force = (MatrixXd(2, 2) << kLoad, 0, 0, 0).finished();
    diagnosis::Ground ground;
    ground.support = "support:pier";
    ground.parameter = 0;
    ground.settle = Eigen::Vector2d(0.0, kPier);
    ground.moved = (MatrixXd(2, 2) << 0, 0, 0, kPier * 0.003).finished();
    out.grounds = {ground};
    out.rotation = (MatrixXd(2, 2) << -0.5, 0.5, 0, 0).finished();  // of a bar of 2 m between the dofs
    out.strain = (MatrixXd(2, 2) << 0, 0, -0.25, 0.25).finished();  // of one of 4 m
    out.forces.resize(2);
    out.forces[1].ground = 0;
    out.forces[1].pull = Eigen::Vector2d(0.0, kPier);
    out.forces[1].settle = kPier;
    out.forces[1].moved = Eigen::Vector2d(0.0, kPier * 0.003);
    return out;
  }
  /// Displacements by hand: push u at dof 0, ground raised by z, pier of stiffness p.
  static Eigen::Vector2d by_hand(double push, double z, double p) {
    MatrixXd k = frame();
    k(1, 1) += p;
    const double determinant = k(0, 0) * k(1, 1) - kA * kA;
    const Eigen::Vector2d f(push, p * z);
    return Eigen::Vector2d(k(1, 1) * f[0] + kA * f[1], kA * f[0] + k(0, 0) * f[1]) / determinant;
  }
  /// Rows of one case: displacements, rotation, strain, force of the pier on the structure.
  static VectorXd rows(double push, double z, double p) {
    const Eigen::Vector2d u = by_hand(push, z, p);
    return (VectorXd(5) << u[0], u[1], 0.5 * (u[1] - u[0]), 0.25 * (u[1] - u[0]), p * (z - u[1])).finished();
  }
  void expect(const VectorXd& found, const VectorXd& push, const VectorXd& lift) const {
    for (Index i = 0; i < 5; ++i) {
      EXPECT_NEAR(found[i] / push[i], 1.0, 1e-10) << "push, row " << i;
      EXPECT_NEAR(found[5 + i] / lift[i], 1.0, 1e-10) << "lift, row " << i;
    }
  }
  Predicted model;
};

TEST(LoadTestRows, AreTheHandCalculation) {
  // Pushed by 50 kN, without a lift: a 3 MN/m, pier 2 MN/m: u0 = F (a + p) / (a² + 2 a p) = 5e4 · 5e6 / 21e12, u1 = F a /
  // 21e12.
  const WallAndPier wall;
  const auto p = wall.model.predict();
  ASSERT_TRUE(p.valid);
  EXPECT_NEAR(p.g[0], 5e4 * 5e6 / 21e12, kHand);
  EXPECT_NEAR(p.g[1], 5e4 * 3e6 / 21e12, kHand);
  wall.expect(p.g, WallAndPier::rows(kLoad, 0.0, kPier), WallAndPier::rows(0.0, 0.003, kPier));
  // The wall and the pier carry the push.
  EXPECT_NEAR(kA * p.g[0] - p.g[4], kLoad, 1e-6);
}

TEST(LoadTestRows, ASettlementIsAddedToTheGround) {
  const WallAndPier wall;
  HandMade settled("support.settle", {{"rise", -0.002}}, {wall.model.place("supports", "support:pier")});
  settled.candidate.location = "support:pier";
  settled.hypothesis.set = "supports";
  const auto p = wall.model.predict({settled.cause()});
  wall.expect(p.g, WallAndPier::rows(kLoad, -0.002, kPier), WallAndPier::rows(0.0, 0.001, kPier));
}

TEST(LoadTestRows, AFactorOnTheSupportIsOnItsGroundToo) {
  const WallAndPier wall;
  HandMade soft("scale.stiffness", {{"factor", 0.3}}, {wall.model.place("supports", "support:pier")});
  soft.candidate.location = "support:pier";
  soft.hypothesis.set = "supports";
  const auto p = wall.model.predict({soft.cause()});
  wall.expect(p.g, WallAndPier::rows(kLoad, 0.0, 0.3 * kPier), WallAndPier::rows(0.0, 0.003, 0.3 * kPier));
}

TEST(LoadTestRows, ACauseOfAnotherStateDoesNothing) {
  const WallAndPier wall;
  HandMade settled("support.settle", {{"rise", -0.002}}, {wall.model.place("supports", "support:pier")});
  settled.candidate.location = "support:pier";
  settled.candidate.state = "after";
  EXPECT_EQ((wall.model.predict({settled.cause()}).g - wall.model.predict().g).norm(), 0.0);
}

TEST(LoadTestRows, FollowTheParameterAndTheGains) {
  const WallAndPier wall;
  const diagnosis::FeatureMap map = wall.model.map();
  VectorXd x = VectorXd::Zero(std::ssize(map.nuisances()));
  for (Index j = 0; j < x.size(); ++j) {
    const auto& v = map.nuisances()[static_cast<std::size_t>(j)];
    if (v.kind == diagnosis::Nuisance::Kind::parameter) x[j] = 0.4 / v.deviation;
    if (v.kind == diagnosis::Nuisance::Kind::gain && v.index == 1) x[j] = 0.02 / v.deviation;
  }
  VectorXd push = WallAndPier::rows(kLoad, 0.0, 1.4 * kPier), lift = WallAndPier::rows(0.0, 0.003, 1.4 * kPier);
  for (const Index of_second : {1, 3, 4}) {
    push[of_second] *= 1.02;
    lift[of_second] *= 1.02;
  }
  wall.expect(map.predict(map.base(x), {}, false).g, push, lift);
}

TEST(LoadTestRows, SlopesAreThoseOfCentralDifferences) {
  // At a point off the centre, with a cause. The error of a difference of 2e-3 in prior units is some 1e-7 of the slope.
  const WallAndPier wall;
  HandMade soft("scale.stiffness", {{"factor", 0.7}}, {wall.model.place("supports", "support:pier")});
  HandMade settled("support.settle", {{"rise", -0.002}}, {wall.model.place("supports", "support:pier")});
  soft.candidate.location = settled.candidate.location = "support:pier";
  soft.hypothesis.set = "supports";
  const diagnosis::FeatureMap map = wall.model.map();
  VectorXd x(std::ssize(map.nuisances()));
  for (Index j = 0; j < x.size(); ++j) x[j] = 0.3 * std::cos(static_cast<double>(j));
  for (const std::vector<diagnosis::Cause>& causes : {std::vector<diagnosis::Cause>{}, {soft.cause(), settled.cause()}}) {
    const MatrixXd slope = map.predict(map.base(x), causes, true).jacobian;
    for (Index j = 0; j < x.size(); ++j) {
      constexpr double h = 1e-3;
      const auto moved = [&](double step) {
        return map.predict(map.base(x + step * VectorXd::Unit(x.size(), j)), causes, false).g;
      };
      const VectorXd difference = (moved(h) - moved(-h)) / (2.0 * h);
      for (Index r = 0; r < slope.rows(); ++r)
        EXPECT_NEAR(slope(r, j), difference[r], 1e-6 * slope.row(r).norm())
            << "row " << r << ", " << map.nuisances()[static_cast<std::size_t>(j)].name;
    }
  }
}

TEST(LoadTestRows, AGaugedSupportThatMovesAwayIsNoPrediction) {
  for (const bool gauged : {true, false}) {
    const WallAndPier wall(gauged);
    HandMade moved("support.move", {{"position", 0.0}});
    moved.candidate.location = "support:pier";
    EXPECT_EQ(wall.model.predict({moved.cause()}).valid, !gauged);
  }
}

TEST(LoadTestRows, AStructureThatFallsIsNoPrediction) {
  const WallAndPier wall;
  HandMade lost("scale.stiffness", {{"factor", -5.0}}, {wall.model.place("supports", "support:pier")});
  lost.candidate.location = "support:pier";
  EXPECT_FALSE(wall.model.predict({lost.cause()}).valid);
}

}  // namespace
}  // namespace twindeck::tests
