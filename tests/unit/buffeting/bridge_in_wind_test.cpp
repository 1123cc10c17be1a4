/// Oracles: modes and influence lines of a simply supported beam in closed form; wind axes and profiles of the turbulence by
/// hand.
#include "buffeting/bridge_in_wind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "unit/buffeting/gusty_beam.hpp"

namespace twindeck::buffeting {
namespace {

using tests::GustyBeam;

// Monitoring points are those of an M; every third aerodynamic node is a sensor too, from the second: 1, 4, 7 of 0 … 7.
TEST(BridgeInWind, SensorsAreThePointsAndEveryThirdNode) {
  const GustyBeam beam;
  const BridgeInWind bridge = beam.bridge();
  EXPECT_EQ(bridge.sensors.points, (std::vector<std::string>{"M1", "M2"}));
  EXPECT_EQ(bridge.sensors.nodes, (std::vector<std::size_t>{1, 4, 7}));
  EXPECT_EQ(bridge.sensors.motion.rows(), 3 * 2 + 2 * 3);
  EXPECT_EQ(bridge.sensors.motion.cols(), bridge.reduced.structure.size());
  EXPECT_EQ(bridge.sensors.vertical(1), 5);
  EXPECT_EQ(bridge.sensors.lateral_row(0), 6);
  EXPECT_EQ(bridge.sensors.vertical_row(2), 11);
  EXPECT_NEAR(bridge.frozen_omega / beam.deck.omega(1), 1.0, 1e-4);
}

// In its first mode, sin(πx/L) sqrt(2/(mL)), the beam moves vertically alone; the points are at L/2 and L/4.
TEST(BridgeInWind, SensorsMoveWithTheFirstMode) {
  const GustyBeam beam;
  const BridgeInWind bridge = beam.bridge();
  const double size = std::sqrt(2.0 / (beam.deck.mass() * beam.deck.length));
  const Eigen::VectorXd mode = bridge.sensors.motion.col(0);
  // The mesh errs by (π/16)⁴/720 in the mode.
  EXPECT_NEAR(std::abs(mode[bridge.sensors.vertical(0)]) / size, 1.0, 1e-5);
  EXPECT_NEAR(mode[bridge.sensors.vertical(1)] / mode[bridge.sensors.vertical(0)], std::sqrt(0.5), 1e-5);
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = beam.deck.strip_x(static_cast<int>(bridge.sensors.nodes[i]));
    EXPECT_NEAR(mode[bridge.sensors.vertical_row(i)] / mode[bridge.sensors.vertical(0)],
                std::sin(std::numbers::pi * x / beam.deck.length), 1e-5);
    EXPECT_NEAR(mode[bridge.sensors.lateral_row(i)], 0.0, 1e-9 * size);
  }
  EXPECT_NEAR(mode[0], 0.0, 1e-9 * size);
  EXPECT_NEAR(mode[1], 0.0, 1e-9 * size);
}

// The static shape of a monitoring point makes its flexibility that of the beam with few modes: L³/48EI and 3L³/256EI.
TEST(BridgeInWind, PointsYieldAsTheBeamDoes) {
  GustyBeam beam;
  beam.aerodynamics.n_modes = 1;
  const BridgeInWind bridge = beam.bridge();
  for (std::size_t p = 0; p < 2; ++p) {
    const Eigen::VectorXd d = bridge.sensors.motion.row(bridge.sensors.vertical(p));
    const double x = beam.deck.length / (p == 0 ? 2.0 : 4.0);
    const double found = d.cwiseQuotient(bridge.reduced.structure.omega_rad_s).squaredNorm();
    EXPECT_NEAR(found / beam.deck.influence(x, x, beam.deck.I_vertical), 1.0, 1e-7) << p;
  }
}

// Lateral gusts are among the patterns: with one vertical mode alone, drag still bends the beam laterally.
TEST(BridgeInWind, StaticShapesHoldTheGustsThatTheModesLeave) {
  GustyBeam beam;
  beam.aerodynamics.n_modes = 1;
  beam.config.point_shapes = 0;
  beam.config.static_shapes = 0;
  EXPECT_EQ(beam.bridge().reduced.structure.size(), 1);
  beam.config.static_shapes = 3;
  const BridgeInWind bridge = beam.bridge();
  EXPECT_EQ(bridge.reduced.structure.size(), 4);
  EXPECT_GT(bridge.sensors.motion.row(bridge.sensors.lateral_row(1)).norm(), 0.0);
}

TEST(BridgeInWind, DampersTakePartWhereTheyAreAskedFor) {
  GustyBeam beam;
  EXPECT_EQ(beam.bridge(1.0, true).reduced.dampers, 1);
  EXPECT_EQ(beam.bridge(1.0, true).reduced.structure.maxwell.size(), 1U);
  beam.config.dampers = false;
  EXPECT_EQ(beam.bridge(1.0, true).reduced.dampers, 0);
  EXPECT_TRUE(beam.bridge(1.0, true).reduced.structure.maxwell.empty());
}

TEST(DeploymentOf, AnUnknownModelIsRefusedWithTheKnownOnes) {
  aero::WindSettings settings;
  settings.models = {"A", "H_oblique"};
  EXPECT_EQ(deployment_of(settings, "H_oblique").everywhere.name, "H_oblique");
  try {
    static_cast<void>(deployment_of(settings, "hybrid"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("step 7 has A, H_oblique"), std::string::npos) << error.what();
  }
  settings.hybrid = {{"deck", 30.0}};
  EXPECT_EQ(deployment_of(settings, "hybrid").zones.size(), 1U);
}

// Wind along +Y: along is y, across = e_z × e_y = -x. I = 1/ln(z/z0), w' has half of it; L = 300 (z/200)^kappa, w' a tenth.
TEST(FieldAtNodes, IsInTheAxesOfTheWind) {
  const GustyBeam beam;
  const BridgeInWind bridge = beam.bridge();
  const wind::FieldDefinition found = field_at_nodes(bridge, beam.set, 10.0, 15.0, wind::Component::vertical, false);
  ASSERT_EQ(found.size(), 8);
  for (int i = 0; i < 8; ++i) {
    EXPECT_LT((found.position_m.row(i).transpose() - Eigen::Vector3d(0.0, -beam.deck.strip_x(i), 0.0)).norm(), 1e-12);
    EXPECT_EQ(found.speed_m_s[i], 15.0);
    EXPECT_NEAR(found.sigma_m_s[i], 0.5 * 15.0 / std::log(200.0), 1e-13);
    EXPECT_NEAR(found.length_m[i], 30.0 * std::pow(0.05, 0.52), 1e-12);
  }
  EXPECT_EQ(found.decay, (wind::PerComponent{1.0, 6.0, 5.0}));
  EXPECT_FALSE(found.frozen);
  EXPECT_EQ(found.component, wind::Component::vertical);
  const wind::FieldDefinition along = field_at_nodes(bridge, beam.set, 1.0, 15.0, wind::Component::along, true);
  EXPECT_TRUE(along.frozen);
  EXPECT_NEAR(along.sigma_m_s[0], 15.0 / std::log(80.0), 1e-13);  // constant below 4 m
  EXPECT_EQ(along.decay, (wind::PerComponent{3.0, 10.0, 11.0}));
}

// A wind that blows to +X runs along the nodes, which then lie behind each other.
TEST(FieldAtNodes, FollowsTheDirectionOfTheWind) {
  GustyBeam beam;
  beam.aerodynamics.direction_deg = 60.0;
  const BridgeInWind bridge = beam.bridge();
  const wind::FieldDefinition found = field_at_nodes(bridge, beam.set, 10.0, 15.0, wind::Component::along, true);
  for (int i = 0; i < 8; ++i) {
    const double x = beam.deck.strip_x(i);
    EXPECT_LT((found.position_m.row(i).transpose() - Eigen::Vector3d(0.5 * x, -std::sqrt(0.75) * x, 0.0)).norm(), 1e-12);
  }
}

// The strips, sections and coordinates are those of the bridge, with the deployment of the run.
TEST(SystemOf, TakesTheDeploymentOfTheRun) {
  const GustyBeam beam;
  const BridgeInWind bridge = beam.bridge();
  const aero::AeroelasticSystem system = system_of(bridge, deployment_of(bridge.aerodynamics, "D"));
  EXPECT_EQ(system.deployment().name, "D");
  EXPECT_EQ(system.strips().size(), 8U);
  EXPECT_EQ(system.structure().size(), bridge.reduced.structure.size());
  EXPECT_EQ(system.structure().damping_ratio[0], 0.02);
}

}  // namespace
}  // namespace twindeck::buffeting
