#include "matching/shapes_at_sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/fe/assembly_models.hpp"
#include "unit/matching/measured_modes.hpp"

namespace twindeck::matching {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using fe::test::add_node;
using fe::test::cantilever;
using tests::SpringChain;

/// Adds a channel, and the row of the shapes that it measures.
void add_channel(Measured& measured, const std::string& name, const std::string& point, const std::optional<Vector3d>& x_m,
                 const Vector3d& direction) {
  Channel channel;
  channel.name = name;
  channel.point = point;
  channel.x_m = x_m;
  channel.direction = direction;
  measured.channels.push_back(channel);
  measured.modes.dofs.push_back({point, name});
}

/// What channels show while one free degree of freedom alone moves by 1.
Eigen::VectorXd shown(const Measured& measured, const dynamics::LoadedModel& model, const std::string& node, int direction) {
  dynamics::EigenModes modes;
  modes.shapes = MatrixXd::Zero(model.system.size(), 1);
  for (std::size_t i = 0; i < model.system.dofs.size(); ++i)
    if (model.system.dofs[i].node == node && model.system.dofs[i].direction == direction)
      modes.shapes(static_cast<Index>(i), 0) = 1.0;
  EXPECT_EQ(modes.shapes.sum(), 1.0) << node << " is not free";
  return shapes_at_sensors(measured, model, modes, 0.05).col(0).real();
}

// Oracle: the definition. A channel with cosines (0, 0.6, -0.8) shows 0.6 v - 0.8 w of the nearest node, and nothing of others.
TEST(ShapesAtSensors, ProjectOnTheCosines) {
  const dynamics::LoadedModel model = dynamics::from_model(cantilever());
  Measured measured;
  add_channel(measured, "a1", "tip", Vector3d(4.0, 0.0, 0.04), {0.0, 0.6, -0.8});
  add_channel(measured, "a2", "middle", Vector3d(1.97, 0.0, 0.0), Vector3d::UnitX());
  EXPECT_EQ(shown(measured, model, "3", 0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(shown(measured, model, "3", 1), Eigen::Vector2d(0.6, 0.0));
  EXPECT_EQ(shown(measured, model, "3", 2), Eigen::Vector2d(-0.8, 0.0));
  EXPECT_EQ(shown(measured, model, "3", 5), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(shown(measured, model, "2", 0), Eigen::Vector2d(0.0, 1.0));
  EXPECT_EQ(shown(measured, model, "2", 2), Eigen::Vector2d(0.0, 0.0));
}

// Oracle: the definition. Where no channel is described a dof is named by node and direction; each of six directions shows its
// own displacement alone. A support shows nothing.
TEST(ShapesAtSensors, TakeNodesAndDirectionsByName) {
  const dynamics::LoadedModel model = dynamics::from_model(cantilever());
  Measured measured;
  for (const char* direction : {"x", "y", "z", "rx", "ry", "rz"}) measured.modes.dofs.push_back({"2", direction});
  measured.modes.dofs.push_back({"1", "z"});
  for (int d = 0; d < 6; ++d) {
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(7);
    expected[d] = 1.0;
    EXPECT_EQ(shown(measured, model, "2", d), expected) << d;
  }
}

// Oracle: the header. A point called "1" with the coordinates of node 3 is node 3: positions go before names.
TEST(ShapesAtSensors, PutPositionsBeforeNames) {
  const dynamics::LoadedModel model = dynamics::from_model(cantilever());
  Measured measured;
  add_channel(measured, "a1", "1", Vector3d(4.0, 0.0, 0.0), Vector3d::UnitZ());
  add_channel(measured, "a2", "2", std::nullopt, Vector3d::UnitZ());
  EXPECT_EQ(shown(measured, model, "3", 2), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(shown(measured, model, "2", 2), Eigen::Vector2d(0.0, 1.0));
}

// Oracle: a rigid body, u = u_m + theta × r. An arm of r = (0, 0, 1.5) m shows 1.5 theta_y along x and -1.5 theta_x along y.
TEST(ShapesAtSensors, FollowRigidLinks) {
  fe::Model built = cantilever();
  built.links.push_back({"mast", 2, add_node(built, 4.0, 0.0, 1.5)});
  const dynamics::LoadedModel model = dynamics::from_model(built);
  Measured measured;
  for (const Vector3d& direction : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY()), Vector3d(Vector3d::UnitZ())})
    add_channel(measured, "a" + std::to_string(measured.channels.size()), "head", Vector3d(4.0, 0.0, 1.5), direction);
  EXPECT_NEAR((shown(measured, model, "3", 4) - Vector3d(1.5, 0.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((shown(measured, model, "3", 3) - Vector3d(0.0, -1.5, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((shown(measured, model, "3", 2) - Vector3d(0.0, 0.0, 1.0)).norm(), 0.0, 1e-14);
}

// Oracle: a node of a chain moves along x alone. A channel of any name means that; one with cosines shows its part; one across
// shows nothing.
TEST(ShapesAtSensors, TakeTheOnlyDegreeOfFreedom) {
  const dynamics::LoadedModel model = matrix_model(SpringChain{.n = 5}.system());
  Measured measured;
  measured.modes.dofs = {{"2", "sensor_7"}, {"4", "z"}};
  add_channel(measured, "a1", "p", Vector3d(3.0, 0.04, 0.0), {0.6, 0.8, 0.0});  // mass 4 stands at x = 3 m
  EXPECT_EQ(shown(measured, model, "2", 0), Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(shown(measured, model, "4", 0), Vector3d(0.0, 0.0, 0.6));
}

// Oracle: duality. c' phi of the sensor vectors is what the channels show of phi, for an FE model with a link and for a matrix
// model; 1e-14 is rounding of values below 10.
TEST(SensorVectors, ShowTheSame) {
  fe::Model built = cantilever();
  built.links.push_back({"mast", 2, add_node(built, 4.0, 0.0, 1.5)});
  const dynamics::LoadedModel beam = dynamics::from_model(built), chain = matrix_model(SpringChain{.n = 5}.system());
  Measured on_beam, on_chain;
  add_channel(on_beam, "a1", "head", Vector3d(4.0, 0.0, 1.5), {0.48, -0.6, 0.64});
  add_channel(on_beam, "a2", "middle", Vector3d(2.0, 0.0, 0.0), Vector3d::UnitZ());
  on_beam.modes.dofs.push_back({"2", "ry"});
  on_chain.modes.dofs = {{"2", "x"}, {"5", "any"}, {"5", "z"}};
  for (const auto& [measured, model] : {std::pair(&on_beam, &beam), std::pair(&on_chain, &chain)}) {
    dynamics::EigenModes modes;
    modes.shapes.resize(model->system.size(), 3);
    for (Index i = 0; i < modes.shapes.size(); ++i) modes.shapes(i) = std::sin(1.0 + static_cast<double>(i * i));
    const MatrixXd vectors = sensor_vectors(*measured, *model, 0.05);
    ASSERT_EQ(vectors.rows(), model->system.size());
    EXPECT_LT((vectors.transpose() * modes.shapes - shapes_at_sensors(*measured, *model, modes, 0.05).real()).norm(), 1e-14);
  }
}

/// The cantilever with a node "4" at the place of its tip "3", on a vertical spring of its own; "A" in points.csv is node 4.
fe::Model two_at_the_tip() {
  fe::Model built = cantilever();
  fe::Spring spring;
  spring.name = "isolator";
  spring.node = 2;
  spring.node2 = add_node(built, 4.0, 0.0, 0.0);
  spring.stiffness = 1e5;
  built.springs.push_back(spring);
  built.masses.push_back({"machine", 3, 300.0, Vector3d::Zero()});
  built.monitoring_points["A"] = 3;
  return built;
}

/// What is said of a channel at the tip, before anything is solved.
std::string refusal_at_the_tip(const fe::Model& built, const std::string& point) {
  Measured measured;
  measured.source = "measured";
  add_channel(measured, "a1", point, Vector3d(4.0, 0.0, 0.0), Vector3d::UnitZ());
  try {
    refuse_unplaced_channels(measured, dynamics::valid_model(built), 0.05);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Oracle: the header. Of nodes at one place it is the one that the sensor names, whichever stands first.
TEST(ShapesAtSensors, StandOnTheNodeOfTheirName) {
  const dynamics::LoadedModel model = dynamics::from_model(two_at_the_tip());
  Measured measured;
  for (const char* point : {"A", "4", "3"})
    add_channel(measured, std::string("a") + point, point, Vector3d(4.0, 0.0, 0.0), Vector3d::UnitZ());
  EXPECT_EQ(shown(measured, model, "4", 2), Vector3d(1.0, 1.0, 0.0));
  EXPECT_EQ(shown(measured, model, "3", 2), Vector3d(0.0, 0.0, 1.0));
}

// Oracle: the header. Without such a name nothing says which of the two moves is measured; nodes that a link ties, or of which
// one alone can move, leave no doubt.
TEST(RefuseUnplacedChannels, AsksWhichOfTwoNodesIsMeant) {
  for (const char* point : {"A", "3", "4"}) EXPECT_EQ(refusal_at_the_tip(two_at_the_tip(), point), "") << point;
  const std::string words = refusal_at_the_tip(two_at_the_tip(), "p");
  EXPECT_TRUE(says(words, "measured: a1: lies where the nodes 3, 4 coincide, which can move apart"));
  EXPECT_TRUE(says(words, "points.csv"));
  fe::Model tied = cantilever();
  tied.links.push_back({"tie", 2, add_node(tied, 4.0, 0.0, 0.0)});
  EXPECT_EQ(refusal_at_the_tip(tied, "p"), "");
  fe::Model grounded = two_at_the_tip();
  fe::test::fix(grounded, 3);
  EXPECT_EQ(refusal_at_the_tip(grounded, "p"), "");
}

// Oracle: by construction. Two matrix points at one place, one along x and one along z: a sensor along z is the second.
TEST(ShapesAtSensors, TakeTheMatrixPointThatMovesTheirWay) {
  fe::ParametricSystem system = SpringChain{.n = 5}.system();
  system.dofs[3] = {"4z", 2, system.dofs[2].x_m};
  const dynamics::LoadedModel model = matrix_model(system);
  Measured measured;
  add_channel(measured, "a1", "p", system.dofs[2].x_m, Vector3d::UnitZ());
  add_channel(measured, "a2", "p", system.dofs[2].x_m, Vector3d::UnitX());
  EXPECT_EQ(shown(measured, model, "4z", 2), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(shown(measured, model, "3", 0), Eigen::Vector2d(0.0, 1.0));
}

/// The refusal of a channel at a position, before anything is solved. The beam lies 10 m beside the origin: a node there would
/// be near any position in km.
std::string refusal(const Vector3d& x_m, double tolerance_m, double model_scale = 1.0) {
  fe::Model built = cantilever();
  for (fe::Node& node : built.nodes) node.x_m = model_scale * (node.x_m + Vector3d(0.0, 10.0, 0.0));
  Measured measured;
  measured.source = "measured";
  add_channel(measured, "a1", "p", x_m, Vector3d::UnitZ());
  try {
    refuse_unplaced_channels(measured, dynamics::valid_model(built), tolerance_m);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Oracle: distances by hand. (4, 10.3, 0.4) m lies 0.5 m from node 3.
TEST(RefuseUnplacedChannels, HoldsAtTheTolerance) {
  EXPECT_EQ(refusal({4.0, 10.3, 0.4}, 0.51), "");
  const std::string words = refusal({4.0, 10.3, 0.4}, 0.49);
  EXPECT_TRUE(says(words, "measured: a1: lies 0.50 m from the nearest node (3), expected at most 0.49 m"));
  EXPECT_TRUE(says(words, "sensor_tolerance"));
}

// Oracle: by construction. 4000 is 4 m in mm; a model of 4000 m is one of 4 m in mm.
TEST(RefuseUnplacedChannels, GuessesTheUnit) {
  EXPECT_TRUE(says(refusal({4000.0, 10000.0, 20.0}, 0.05), "in mm it would lie on a node"));
  EXPECT_TRUE(says(refusal({4.0, 10.0, 0.02}, 0.05, 1000.0), "the model seems to be in mm"));
}

// Oracle: by construction. (4, 0.3, 0.4) m is no slip of units, although 4 mm lie near a node at the origin.
TEST(RefuseUnplacedChannels, SuspectsNoUnitNearTheOrigin) {
  Measured measured;
  add_channel(measured, "a1", "p", Vector3d(4.0, 0.3, 0.4), Vector3d::UnitZ());
  try {
    refuse_unplaced_channels(measured, dynamics::valid_model(cantilever()), 0.1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(says(error.what(), "sensor_tolerance"));
  }
}

// Oracle: the header. Points that no name and no position places, and a direction that says nothing, are refused.
TEST(RefuseUnplacedChannels, NamesWhatIsMissing) {
  const dynamics::ReadModel model = dynamics::valid_model(cantilever());
  const auto words = [&](const modal::ShapeDof& dof) -> std::string {
    Measured measured;
    measured.modes.dofs = {dof};
    try {
      refuse_unplaced_channels(measured, model, 0.05);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(words({"3", "z"}), "");
  EXPECT_TRUE(says(words({"4", "z"}), "4: is no node of the model"));
  EXPECT_TRUE(says(words({"3", "up"}), "up: is no direction"));
}

}  // namespace
}  // namespace twindeck::matching
