// Oracles: virtual work (what the nodal 6 × 6 blocks give through the modes is what the modal matrices hold), symmetry of a
// rotation about the vertical (turning bridge and wind together changes nothing), hand-written entries of Eq. (8).
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>

#include "aero/aeroelastic_system.hpp"
#include "known_derivatives.hpp"
#include "linear_polar.hpp"
#include "unit/aero/static_forces.hpp"

namespace {

using namespace twindeck;

aero::Derivatives18 some_derivatives() {
  aero::Derivatives18 values{};
  for (std::size_t i = 0; i < 18; ++i) values[i] = std::sin(1.0 + static_cast<double>(i));
  return values;
}

aero::AeroelasticSystem some_system(const aero::Deployment& deployment, double turn_rad = 0.0) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const aero::Wind wind{1.25, turn * Eigen::Vector3d::UnitY()};
  std::vector<aero::Strip> strips;
  std::vector<aero::StripMotion> motions;
  for (int i = 0; i < 5; ++i) {
    const double angle = -0.8 + 0.4 * i;
    aero::Strip strip = aero::make_strip(i < 3 ? "a" : "b", i < 3 ? 0 : 1, 0, 4.0 + i, {1.0 * i, 0, 0},
                                         turn * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0), wind);
    strip.alpha_rad = 0.01 * i;
    strips.push_back(strip);
    aero::StripMotion motion(6, 3);
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 3; ++c) motion(r, c) = std::cos(0.3 + 1.7 * r + 2.3 * c + 0.9 * i);
    }
    motion.topRows<3>() = (turn * motion.topRows<3>()).eval();
    motion.bottomRows<3>() = (turn * motion.bottomRows<3>()).eval();
    motions.push_back(motion);
  }
  aero::ReducedStructure structure;
  structure.omega_rad_s = Eigen::Vector3d(3, 4, 5);
  structure.damping_ratio = Eigen::Vector3d::Constant(0.01);
  const aero::Polar polar = aero::linear_polar({0.2, -0.1, 0.03, 0.4, -5.0, 0.6});
  const auto derivatives = std::make_shared<aero::ConstantZasso>(some_derivatives());
  return {structure, {{"a", 4.5, polar, derivatives}, {"b", 5.0, polar, derivatives}}, strips, motions, wind, deployment};
}

TEST(Forces, NodalBlocksThroughTheModesAreTheModalMatrices) {
  for (const aero::YawRule& rule : aero::published_yaw_rules()) {
    const aero::AeroelasticSystem system = some_system(aero::everywhere(rule));
    Eigen::Matrix3d damping = Eigen::Matrix3d::Zero(), stiffness = Eigen::Matrix3d::Zero();
    bool symmetric = true;
    for (std::size_t i = 0; i < system.strips().size(); ++i) {
      const aero::Strip& strip = system.strips()[i];
      const aero::StripBlock block =
          aero::self_excited(system.sections()[static_cast<std::size_t>(strip.section)], strip, rule, 1.25, 20.0, 4.0);
      // At the node in global axes: what the paper's pair of Matrix27 elements holds.
      const aero::Kinematics r = aero::kinematics(strip, rule.axes, system.wind());
      const Eigen::Matrix<double, 6, 6> c = r.transpose() * block.damping * r, k = r.transpose() * block.stiffness * r;
      damping += system.motions()[i].transpose() * c * system.motions()[i];
      stiffness += system.motions()[i].transpose() * k * system.motions()[i];
      symmetric = symmetric && c.isApprox(c.transpose());
    }
    const aero::AeroelasticSystem::Block modal = system.self_excited(20.0, 4.0);
    EXPECT_TRUE(modal.damping.isApprox(damping, 1e-12)) << rule.name;
    EXPECT_TRUE(modal.stiffness.isApprox(stiffness, 1e-12)) << rule.name;
    EXPECT_FALSE(symmetric) << "they must be stored full";
  }
}

TEST(Forces, TurningBridgeAndWindTogetherChangesNothing) {
  const aero::Deployment hybrid{"hybrid", aero::published_yaw_rule("A"), {{"a", 0.5, aero::published_yaw_rule("D")}}};
  for (const aero::Deployment& deployment :
       {hybrid, aero::everywhere(aero::published_yaw_rule("H")), aero::everywhere(aero::oblique_rule_H())}) {
    const auto a = some_system(deployment), b = some_system(deployment, 1.1);
    EXPECT_TRUE(a.self_excited(20.0, 4.0).damping.isApprox(b.self_excited(20.0, 4.0).damping, 1e-12));
    EXPECT_TRUE(aero::static_forces(a, 20.0).isApprox(aero::static_forces(b, 20.0), 1e-12));
    EXPECT_TRUE(a.static_stiffness().isApprox(b.static_stiffness(), 1e-12));
  }
}

TEST(Forces, EntriesAreThoseOfEquation8) {
  const auto system = some_system(aero::everywhere(aero::published_yaw_rule("A")));
  const aero::Strip& strip = system.strips()[1];
  const double V = 20.0, w = 4.0, B = 4.5, L = strip.length_m, q = 0.5 * 1.25 * V * V * B * L, v = V / (w * B);
  const aero::Derivatives18 z = some_derivatives();
  const aero::StripBlock block = aero::self_excited(system.sections()[0], strip, aero::published_yaw_rule("A"), 1.25, V, w);
  const double pi = std::numbers::pi;
  // Lift (row 1): -h1 ż/V - h2 Bα̇/V + h3 α + h4 π/(2V*²) z/B - h5 ẏ/V + h6 π/(2V*²) y/B
  EXPECT_NEAR(block.damping(1, 1), -q * z[0] / V, 1e-9 * q);
  EXPECT_NEAR(block.damping(1, 2), -q * z[1] * B / V, 1e-9 * q);
  EXPECT_NEAR(block.stiffness(1, 2), q * z[2], 1e-9 * q);
  EXPECT_NEAR(block.stiffness(1, 1), q * z[3] * pi / (2 * v * v) / B, 1e-9 * q);
  EXPECT_NEAR(block.damping(1, 0), -q * z[4] / V, 1e-9 * q);
  EXPECT_NEAR(block.stiffness(1, 0), q * z[5] * pi / (2 * v * v) / B, 1e-9 * q);
  // Drag (row 0): p1, p4 with z; p5, p6 with y
  EXPECT_NEAR(block.damping(0, 1), -q * z[6] / V, 1e-9 * q);
  EXPECT_NEAR(block.damping(0, 0), -q * z[10] / V, 1e-9 * q);
  EXPECT_NEAR(block.stiffness(0, 0), q * z[11] * pi / (2 * v * v) / B, 1e-9 * q);
  // Moment (row 2): one chord more
  EXPECT_NEAR(block.damping(2, 2), -q * B * z[13] * B / V, 1e-8 * q);
  EXPECT_NEAR(block.stiffness(2, 2), q * B * z[14], 1e-8 * q);
}

TEST(Forces, HybridTakesItsRuleByTheYawOfEachStrip) {
  const aero::Deployment hybrid{"hybrid", aero::published_yaw_rule("A"), {{"a", 0.5, aero::published_yaw_rule("D")}}};
  EXPECT_EQ(hybrid.at("a", 0.6).name, "D");
  EXPECT_EQ(hybrid.at("a", -0.6).name, "D");
  EXPECT_EQ(hybrid.at("a", 0.5).name, "A");
  EXPECT_EQ(hybrid.at("b", 0.6).name, "A");
}

}  // namespace
