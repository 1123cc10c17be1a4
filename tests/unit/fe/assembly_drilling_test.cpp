// Oracle: a shell turned as a rigid body about its normal stores no energy, whatever the drilling rule; corners that turn
// against each other store k/2 (sum r_i² - 2/3 sum_{i<j} r_i r_j), k = 0.03 E t A, written out.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "assembly_models.hpp"
#include "fe/assembly.hpp"
#include "fe/shell_quad.hpp"

namespace twindeck::fe {
namespace {

/// A free slab of 2 m x 2 m in the plane, E = 30 GPa, t = 0.1 m.
Model free_slab() {
  Model model = test::one_of_everything();
  model.nodes.clear(), model.elements.clear(), model.links.clear(), model.springs.clear(), model.masses.clear();
  model.supports.clear(), model.parameters.clear();
  model.prestress.rule = PullRule::none;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}) test::add_node(model, x, y, 0.0);
  test::add_element(model, ElementType::shell, "slab", 1, 1, {0, 1, 2, 3});
  model.formulation.drilling = Formulation::Drilling::diagonal;
  return model;
}

double twice_energy(const Model& model, const Eigen::VectorXd& u) {
  const ParametricSystem system = assemble(model, {});
  const linalg::SparseMatrix k = system.stiffness(system.initial());
  return u.dot(k.selfadjointView<Eigen::Lower>() * u);
}

TEST(Drilling, TurningInThePlaneMeetsNoResistance) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(24);
  const Model model = free_slab();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d& x = model.nodes[static_cast<std::size_t>(i)].x_m;
    u.segment<3>(6 * i) = Eigen::Vector3d(-x.y(), x.x(), 0.0);
    u[6 * i + 5] = 1.0;
  }
  const double k = 0.03 * 30e9 * 0.1 * 4.0;  // 3.6e8 N m
  EXPECT_LT(std::abs(twice_energy(model, u)), 1e-10 * k);
}

TEST(Drilling, CornersThatTurnAgainstEachOtherAreHeld) {
  const double k = 0.03 * 30e9 * 0.1 * 4.0;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(24);
  u[5] = 1.0;
  EXPECT_NEAR(twice_energy(free_slab(), u), k, 1e-9 * k);
  u[11] = -1.0;  // 1 + 1 - 2/3 (1)(-1)
  EXPECT_NEAR(twice_energy(free_slab(), u), k * (2.0 + 2.0 / 3.0), 1e-9 * k);
  u[17] = 1.0, u[23] = -1.0;  // 4 - 2/3 (-1 + 1 - 1 - 1 + 1 - 1)
  EXPECT_NEAR(twice_energy(free_slab(), u), k * (4.0 + 4.0 / 3.0), 1e-9 * k);
}

TEST(Drilling, SpreadActsAboutTheNormalOfATiltedShell) {
  ShellGeometry tilted;  // 2 m x 2 m, normal (0, -0.6, 0.8)
  tilted.node_m = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(2, 1.6, 1.2),
                   Eigen::Vector3d(0, 1.6, 1.2)};
  const Matrix24 spread = drilling_spread(tilted, {30e9, 0.2, 0.1, 1.0}, 0.03);
  const Eigen::Vector3d n(0.0, -0.6, 0.8);
  const Eigen::Matrix3d expected = -3.6e8 / 3.0 * n * n.transpose();
  EXPECT_LT((spread.block<3, 3>(3, 15) - expected).norm(), 1e-9 * 3.6e8);
  EXPECT_EQ((spread.block<3, 3>(3, 3).norm()), 0.0);
}

}  // namespace
}  // namespace twindeck::fe
