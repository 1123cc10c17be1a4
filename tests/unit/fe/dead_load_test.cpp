// Oracles: weights from lengths, areas and densities by hand; moments about the origin.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "assembly_models.hpp"
#include "fe/static_stage.hpp"

namespace twindeck::fe {
namespace {

/// Sum of the forces, and of their moments about the origin.
Eigen::Matrix<double, 6, 1> resultant(const Model& model, const Eigen::VectorXd& load) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    const Eigen::Vector3d force = load.segment<3>(at);
    sum.head<3>() += force;
    sum.tail<3>() += load.segment<3>(at + 3) + model.nodes[i].x_m.cross(force);
  }
  return sum;
}

// Oracle: slabs 0.1 m of 2400 kg/m3 (two of 2 × sqrt(9.01) m, a triangle of 2 m2), beams 80 kg/m, stay and tie of
// 1.3e-3 · 8289 kg/m, 300 kg of railing. Parts on supports weigh too. Lumped masses weigh the same.
TEST(DeadLoad, OneOfEverythingWeighsTheSumOfItsParts) {
  Model model = test::one_of_everything();
  const double cable = 1.3e-3 * 8289.0, side = std::sqrt(9.01);
  const double mass =
      240.0 * (4.0 * side + 2.0) + 4.0 * 80.0 * side + cable * (std::sqrt(900.0 + 17.9 * 17.9) + std::sqrt(13.01)) + 300.0;
  for (const bool lumped : {false, true}) {
    model.formulation.lumped_mass = lumped;
    const Eigen::Matrix<double, 6, 1> sum = resultant(model, dead_load(model));
    EXPECT_NEAR(sum[2], -10.0 * mass, 1e-9 * mass);
    EXPECT_LT(sum.head<2>().norm(), 1e-9 * mass);
  }
}

// Oracle: a beam that rides 0.5 m beside its nodes: w L = 80·10·4 N acts in the middle of its own axis.
TEST(DeadLoad, WeightActsWhereTheBeamLies) {
  Model model = test::with_steel();
  test::add_node(model, 1.0, 2.0, 0.0);
  test::add_node(model, 5.0, 2.0, 0.0);
  Element& beam = test::add_element(model, ElementType::beam, "edge", 0, 0, {0, 1});
  beam.offset_m = {Eigen::Vector3d(0.0, 0.5, 0.2), Eigen::Vector3d(0.0, 0.5, 0.2)};
  for (const bool lumped : {false, true}) {
    model.formulation.lumped_mass = lumped;
    const Eigen::VectorXd load = dead_load(model);
    const Eigen::Vector3d force(0.0, 0.0, -3200.0), moment = Eigen::Vector3d(3.0, 2.5, 0.2).cross(force);
    const Eigen::Matrix<double, 6, 1> sum = resultant(model, load);
    EXPECT_LT((sum.head<3>() - force).norm(), 1e-9);
    EXPECT_LT((sum.tail<3>() - moment).norm(), 1e-8);
    EXPECT_NEAR(load[3], -0.5 * 1600.0, 1e-9);                                 // half of it, 0.5 m beside the node
    EXPECT_NEAR(load[4], lumped ? 0.0 : 3200.0 * 4.0 / 12.0, 1e-9) << lumped;  // w L²/12
  }
}

// Oracle: half of a stay at each end, without moments; a vertical beam too, whose weight runs along it.
TEST(DeadLoad, StaysAndMastsLoadTheirEndsAlike) {
  for (const ElementType type : {ElementType::stay, ElementType::bar, ElementType::beam}) {
    Model model = test::with_steel();
    test::add_node(model, 0.0, 0.0, 0.0);
    test::add_node(model, 0.0, 0.0, 6.0);
    test::add_element(model, type, "mast", 0, 0, {0, 1});
    const Eigen::VectorXd load = dead_load(model);
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(12);
    expected[2] = expected[8] = -0.5 * 80.0 * 10.0 * 6.0;
    EXPECT_LT((load - expected).norm(), 1e-9);
  }
}

// Oracle: weight is proportional to gravity; a point mass loads z alone, whatever its inertia.
TEST(DeadLoad, PointMassAndGravity) {
  Model model = test::with_steel();
  test::add_node(model, 3.0, 0.0, 0.0);
  model.masses.push_back({"railing", 0, 300.0, Eigen::Vector3d(5.0, 6.0, 7.0)});
  model.masses.push_back({"lamp", 0, 20.0, Eigen::Vector3d::Zero()});
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
  expected[2] = -3200.0;
  EXPECT_LT((dead_load(model) - expected).norm(), 1e-10);
  model.gravity_m_s2 = 0.0;
  EXPECT_EQ(dead_load(model).norm(), 0.0);
  EXPECT_EQ(dead_load(Model{}).size(), 0);
}

}  // namespace
}  // namespace twindeck::fe
