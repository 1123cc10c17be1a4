// Oracles: strains of a bar and of an Euler beam whose displacements are written down; forces of springs; rows by hand.
#include "diagnosis/reduction/load_test_vectors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/reduction/diagnosed_model.hpp"
#include "unit/diagnosis/matrix_model.hpp"
#include "unit/fe/assembly_models.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Gauge;
using diagnosis::LoadTests;
using diagnosis::NodalLoad;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A rod of 5 m to node 2, a beam of 4 m along x to node 3, a tapered one to node 4; springs in z and x under node 3.
class Frame {
 public:
  Frame() {
    fe::Model model = fe::test::with_steel();
    model.sections.push_back(model.sections[0]);
    model.sections[1].name = "thin";
    model.sections[1].inertia_y_m4 = 2e-5;
    for (const Vector3d& x : {Vector3d(0, 0, 0), Vector3d(3, 4, 0), Vector3d(7, 4, 0), Vector3d(9, 4, 0)})
      fe::test::add_node(model, x.x(), x.y(), x.z());
    fe::test::add_element(model, fe::ElementType::bar, "rods", 0, 0, {0, 1}).name = "rod";
    fe::test::add_element(model, fe::ElementType::beam, "beams", 0, 0, {1, 2});
    fe::test::add_element(model, fe::ElementType::beam, "beams", 0, 0, {2, 3}).section2 = 1;
    for (const Vector3d& direction : {Vector3d::UnitZ().eval(), Vector3d::UnitX().eval()}) {
      fe::Spring spring;
      spring.name = direction.z() > 0.0 ? "pad_z" : "pad_x";
      spring.group = "pad";
      spring.node = 2;
      spring.direction = direction;
      spring.stiffness = direction.z() > 0.0 ? 2e6 : 1e6;
      model.springs.push_back(spring);
    }
    fe::test::fix(model, 0);
    model.supports.push_back({"end", 3, {false, true, false, true, false, true}});
    model.supports.push_back({"roof", 1, {false, false, true, true, true, true}});
    model.parameters.push_back({"E", fe::Target::youngs_modulus, {"steel"}, "Pa", 200e9, 180e9, 220e9});
    model.parameters.push_back({"k_pad", fe::Target::spring_stiffness, {"pad"}, "-", 1.0, 0.5, 2.0});
    matching::Channel channel;
    channel.name = "w";
    channel.point = "3";
    channel.direction = Vector3d::UnitZ();
    prepared_ = diagnosis::prepare_model(dynamics::from_model(model), {channel}, 0.1);
    structure_ = prepared_->structure();
    places_ = diagnosis::find_places(structure_, {});
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  [[nodiscard]] LoadTests tests(const std::vector<NodalLoad>& loads, const std::vector<Gauge>& gauges) const {
    return diagnosis::load_tests_of(structure_, places_, loads, gauges, "loads.csv", "channels.csv");
  }
  [[nodiscard]] std::string refused(const NodalLoad& load, const Gauge& gauge = {}) const {
    try {
      (void)tests({load}, {gauge});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] VectorXd at(const std::string& node, int direction, double value) const {
    VectorXd out = VectorXd::Zero(structure_.system->size());
    for (std::size_t i = 0; i < structure_.system->dofs.size(); ++i)
      if (structure_.system->dofs[i].node == node && structure_.system->dofs[i].direction == direction)
        out[static_cast<Eigen::Index>(i)] = value;
    EXPECT_GT(out.norm(), 0.0) << node << " " << direction;
    return out;
  }
  [[nodiscard]] int ground(const LoadTests& tests, const std::string& id) const {
    for (std::size_t g = 0; g < tests.grounds.size(); ++g)
      if (tests.grounds[g].support == id) return static_cast<int>(g);
    return -1;
  }

 private:
  std::shared_ptr<diagnosis::DiagnosedModel> prepared_;
  diagnosis::Structure structure_;
  diagnosis::Places places_;
};

NodalLoad down(const std::string& load = "lorry", const std::string& node = "3") { return {load, node, 2, -1e5, false, 4}; }

Gauge strain_of(const std::string& element, double xi = 0.5, const Vector2d& fibre = Vector2d::Zero()) {
  Gauge gauge;
  gauge.element = element;
  gauge.xi = xi;
  gauge.fibre_m = fibre;
  gauge.line = 7;
  return gauge;
}
Gauge force_of(const std::string& support, const Vector3d& direction) {
  Gauge gauge;
  gauge.support = support;
  gauge.direction = direction;
  gauge.line = 7;
  return gauge;
}

TEST(LoadTestsOf, ForcesAndMomentsStandByTheirCase) {
  const Frame frame;
  const LoadTests tests = frame.tests({down(), {"crane", "2", 0, 3e4, false, 5}, {"lorry", "4", 4, 2e3, false, 6}, down()}, {});
  EXPECT_EQ(tests.cases, (std::vector<std::string>{"lorry", "crane"}));
  EXPECT_LT((tests.force.col(0) - frame.at("3", 2, -2e5) - frame.at("4", 4, 2e3)).norm(), 1e-9);  // rows of one node add up
  EXPECT_LT((tests.force.col(1) - frame.at("2", 0, 3e4)).norm(), 1e-9);
  EXPECT_TRUE(frame.tests({}, {strain_of("nowhere")}).empty());
}

TEST(LoadTestsOf, StrainOfABarIsItsChordsStretch) {
  const Frame frame;
  const LoadTests tests = frame.tests({down()}, {strain_of("rod"), strain_of("rod", 0.1, {0.1, 0.2}), strain_of("1")});
  const VectorXd u = frame.at("2", 0, 2e-3) + frame.at("2", 1, -5e-4);  // 0.6 and 0.8 of it along 5 m
  for (int g = 0; g < 3; ++g) EXPECT_NEAR(tests.strain.row(g).dot(u), (0.6 * 2e-3 - 0.8 * 5e-4) / 5.0, 1e-15) << g;
}

// w = a x² + b x³ from a clamped end has the curvature 2 a + 6 b x: strain -z w''. Likewise v; both are exact in Euler's beam.
TEST(LoadTestsOf, StrainOfABeamIsThatOfItsFibre) {
  const Frame frame;
  const double length = 4.0, a = 3e-4, b = -2e-5, stretch = 1e-3;
  const VectorXd vertical = frame.at("3", 2, a * length * length + b * std::pow(length, 3)) +
                            frame.at("3", 4, -(2.0 * a * length + 3.0 * b * length * length));
  const VectorXd lateral = frame.at("3", 1, a * length * length + b * std::pow(length, 3)) +
                           frame.at("3", 5, 2.0 * a * length + 3.0 * b * length * length);
  for (const double xi : {0.0, 0.3, 1.0}) {
    const LoadTests tests =
        frame.tests({down()}, {strain_of("2", xi, {0.0, 0.2}), strain_of("2", xi, {0.15, 0.0}), strain_of("2", xi)});
    const double curvature = 2.0 * a + 6.0 * b * xi * length;
    EXPECT_NEAR(tests.strain.row(0).dot(vertical), -0.2 * curvature, 1e-12) << xi;
    EXPECT_NEAR(tests.strain.row(0).dot(lateral), 0.0, 1e-12);
    EXPECT_NEAR(tests.strain.row(1).dot(lateral), -0.15 * curvature, 1e-12) << xi;
    EXPECT_NEAR(tests.strain.row(2).dot(vertical + lateral), 0.0, 1e-12);  // on the axis
    for (int g = 0; g < 3; ++g) EXPECT_NEAR(tests.strain.row(g).dot(frame.at("3", 0, stretch)), stretch / length, 1e-12);
  }
}

TEST(LoadTestsOf, RotationIsAboutTheGaugesAxis) {
  const Frame frame;
  Gauge gauge;
  gauge.node = "3";
  gauge.direction = Vector3d(0.6, 0.8, 0.0);
  const LoadTests tests = frame.tests({down()}, {gauge, strain_of("rod")});
  EXPECT_LT((tests.rotation.row(0).transpose() - frame.at("3", 3, 0.6) - frame.at("3", 4, 0.8)).norm(), 1e-12);
  EXPECT_EQ(tests.rotation.row(1).norm(), 0.0);
  EXPECT_EQ(tests.strain.row(0).norm(), 0.0);
}

// The pad has 2 MN/m upwards and 1 MN/m along x.
TEST(LoadTestsOf, GroundsAndForcesAreThoseOfTheSprings) {
  const Frame frame;
  const LoadTests tests =
      frame.tests({down(), {"settled", "3", 2, -0.01, true, 5}},
                  {force_of("pad", Vector3d::UnitZ()), force_of("pad", Vector3d::UnitX()), strain_of("rod")});
  const int pad = frame.ground(tests, "support:pad");
  ASSERT_GE(pad, 0);
  const auto& ground = tests.grounds[static_cast<std::size_t>(pad)];
  EXPECT_LT((ground.settle - frame.at("3", 2, 2e6)).norm(), 1e-6);  // of one metre
  EXPECT_EQ(ground.moved.col(0).norm(), 0.0);
  EXPECT_LT((ground.moved.col(1) - frame.at("3", 2, -2e4)).norm(), 1e-6);
  for (const auto& other : tests.grounds) EXPECT_EQ(other.parameter, other.support == "support:pad" ? 1 : -1) << other.support;
  EXPECT_EQ(tests.force.col(1).norm(), 0.0);
  const auto& up = tests.forces[0];
  EXPECT_EQ(up.ground, pad);
  EXPECT_LT((up.pull - frame.at("3", 2, 2e6)).norm(), 1e-6);
  EXPECT_NEAR(up.settle, 2e6, 1e-6);
  EXPECT_EQ(up.moved[0], 0.0);
  EXPECT_NEAR(up.moved[1], -2e4, 1e-6);
  const auto& along = tests.forces[1];
  EXPECT_LT((along.pull - frame.at("3", 0, 1e6)).norm(), 1e-6);
  EXPECT_EQ(along.settle, 0.0);
  EXPECT_EQ(along.moved[1], 0.0);
  EXPECT_EQ(tests.forces[2].ground, -1);
}

TEST(LoadTestsOf, WhatTheModelHasNoPlaceForIsRefusedByLine) {
  const Frame frame;
  const auto says = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  says(frame.refused(down("lorry", "88")), "loads.csv:4: node: '88' is no node of the model");
  says(frame.refused({"a", "2", 1, 0.01, true, 9}), "loads.csv:9: node: no support holds node '2' in direction y");
  EXPECT_EQ(frame.refused({"a", "2", 2, 0.01, true, 9}), "");
  says(frame.refused(down(), strain_of("rot")), "channels.csv:7: element: 'rot' is no element of the model");
  says(frame.refused(down(), strain_of("3")), "'3' is no uniform beam, bar or stay");
  says(frame.refused(down(), force_of("padd", Vector3d::UnitZ())),
       "channels.csv:7: support: 'padd' is no support of the model");
  says(frame.refused(down(), force_of("padd", Vector3d::UnitZ())), "pad");
  says(frame.refused(down(), force_of("pad", Vector3d::Zero())), "measures a force along no direction");
  says(frame.refused(down(), force_of("pad", Vector3d::UnitY())), "support 'pad' does not hold along the channel's direction");
}

TEST(LoadTestsOf, AModelOfMatricesHasLoadsAndRotationsButNoStrains) {
  std::vector<fe::DofLabel> dofs = {{"p", 2, {0, 0, 0}}, {"p", 4, {0, 0, 0}}, {"q", 2, {5, 0, 0}}};
  const MatrixModel model(dofs, 1e6 * MatrixXd::Identity(3, 3), MatrixXd::Identity(3, 3));
  const diagnosis::Places places = find_places(model.structure(), {});
  const auto tests_of = [&](const NodalLoad& load, const Gauge& gauge) {
    return diagnosis::load_tests_of(model.structure(), places, {load}, {gauge}, "loads.csv", "channels.csv");
  };
  Gauge turn;
  turn.node = "p";
  turn.direction = Vector3d::UnitY();
  const LoadTests tests = tests_of({"a", "q", 2, 5e3, false, 2}, turn);
  EXPECT_EQ(tests.force, Vector3d(0.0, 0.0, 5e3));
  EXPECT_EQ(tests.rotation, Eigen::RowVector3d(0.0, 1.0, 0.0));
  EXPECT_TRUE(tests.grounds.empty());
  const auto refused = [&](const NodalLoad& load, const Gauge& gauge) -> std::string {
    try {
      (void)tests_of(load, gauge);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refused({"a", "q", 4, 1.0, false, 2}, turn).find("node 'q' cannot move in direction ry"), std::string::npos);
  EXPECT_EQ(refused({"a", "q", 4, 0.0, false, 2}, turn), "");  // nothing acts
  EXPECT_NE(refused({"a", "q", 2, 1.0, false, 2}, strain_of("1")).find("a model of matrices has none"), std::string::npos);
  EXPECT_NE(refused({"a", "q", 2, 1.0, false, 2}, force_of("A", Vector3d::UnitZ())).find("the model has none"),
            std::string::npos);
}

}  // namespace
}  // namespace twindeck::tests
