// Oracle: the matrices of Euler-Bernoulli beams, bars and springs written out by hand (12 EI/L³ = 12e6 N/m for E = 200 GPa,
// I = 4e-5 m4, L = 2 m, and so on), never the element functions.
#include "fe/assembly.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "assembly_models.hpp"

namespace twindeck::fe {
namespace {

Eigen::MatrixXd stiffness_of(const Model& model) {
  const ParametricSystem system = assemble(model, {});
  return test::full(system.stiffness(system.initial()));
}

TEST(Assembly, CantileverOfTwoBeamsEqualsTheMatrixWrittenOut) {
  const Model model = test::cantilever();
  const ParametricSystem system = assemble(model, {});
  ASSERT_EQ(system.size(), 12);
  const Eigen::MatrixXd k = test::full(system.stiffness(system.initial()));
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(12, 12);
  const auto both = [&](int i, int j, double value) { expected(i, j) = expected(j, i) = value; };
  // Middle node: x y z rx ry rz = 0..5, tip: 6..11. EA/L = 1e9; 12EI/L³: z 12e6, y 3e6; 6EI/L²: 12e6, 3e6; 4EI/L: 16e6, 4e6.
  both(0, 0, 2e9), both(0, 6, -1e9), both(6, 6, 1e9);
  both(1, 1, 6e6), both(1, 7, -3e6), both(7, 7, 3e6), both(1, 11, 3e6), both(5, 7, -3e6), both(7, 11, -3e6);
  both(5, 5, 8e6), both(5, 11, 2e6), both(11, 11, 4e6);
  both(2, 2, 24e6), both(2, 8, -12e6), both(8, 8, 12e6), both(2, 10, -12e6), both(4, 8, 12e6), both(8, 10, 12e6);
  both(4, 4, 32e6), both(4, 10, 8e6), both(10, 10, 16e6);
  both(3, 3, 2.4e6), both(3, 9, -1.2e6), both(9, 9, 1.2e6);
  EXPECT_LT((k - expected).cwiseAbs().maxCoeff(), 1e-3) << k - expected;
}

TEST(Assembly, MassOfTheCantileverEqualsTheConsistentMassWrittenOut) {
  const ParametricSystem system = assemble(test::cantilever(), {});
  const Eigen::MatrixXd m = test::full(system.mass(system.initial()));
  const double mass = 8000.0 * 0.01 * 2.0;  // 160 kg a beam
  EXPECT_NEAR(m(0, 0), 2.0 * mass / 3.0, 1e-9);
  EXPECT_NEAR(m(0, 6), mass / 6.0, 1e-9);
  EXPECT_NEAR(m(2, 2), 2.0 * mass * 156.0 / 420.0, 1e-9);
  EXPECT_NEAR(m(2, 8), mass * 54.0 / 420.0, 1e-9);
  EXPECT_NEAR(m(10, 10), mass * 4.0 * 4.0 / 420.0, 1e-9);
  EXPECT_NEAR(m(8, 10), mass * 22.0 * 2.0 / 420.0, 1e-9);   // deflection of the tip with its rotation about y
  EXPECT_NEAR(m(7, 11), -mass * 22.0 * 2.0 / 420.0, 1e-9);  // the same about z, of opposite sign
  EXPECT_NEAR(m(9, 9), 8000.0 * 5e-5 * 2.0 / 3.0, 1e-9);    // polar inertia
}

TEST(Assembly, SpringsActAlongTheirDirectionAndInactiveOnesDoNot) {
  Model model = test::cantilever();
  const Eigen::MatrixXd before = stiffness_of(model);
  Spring spring;
  spring.name = "slanted";
  spring.group = "bearings";
  spring.node = 2;
  spring.direction = Eigen::Vector3d(0.0, 3.0, 4.0);
  spring.stiffness = 25e3;
  model.springs.push_back(spring);
  spring.active = false;
  model.springs.push_back(spring);
  spring.active = true;
  spring.series = true;
  model.springs.push_back(spring);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(12, 12);
  expected(7, 7) = 9e3, expected(7, 8) = expected(8, 7) = 12e3, expected(8, 8) = 16e3;  // 25e3 (0.6, 0.8)(0.6, 0.8)'
  EXPECT_LT((stiffness_of(model) - before - expected).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Assembly, SpringBetweenTwoNodesPullsThemTogether) {
  Model model = test::cantilever();
  const Eigen::MatrixXd before = stiffness_of(model);
  Spring spring;
  spring.group = "joint";
  spring.node = 1;
  spring.node2 = 2;
  spring.rotation = true;
  spring.stiffness = 7e3;
  model.springs.push_back(spring);
  const Eigen::MatrixXd added = stiffness_of(model) - before;
  EXPECT_NEAR(added(5, 5), 7e3, 1e-4);
  EXPECT_NEAR(added(5, 11), -7e3, 1e-4);
  EXPECT_NEAR(added(11, 11), 7e3, 1e-4);
  EXPECT_NEAR(added.cwiseAbs().sum(), 28e3, 1e-3);
}

TEST(Assembly, StayCarriesDischingerModulusStringStiffnessAndHalfItsMassAtEachEnd) {
  Model model = test::with_steel();
  const int deck = test::add_node(model, 0.0, 0.0, 0.0), mast = test::add_node(model, 60.0, 0.0, 80.0);
  test::add_element(model, ElementType::stay, "stays", 0, 0, {deck, mast}).name = "N1";
  test::fix(model, mast);
  PrestressState state;
  state.stay_pull_N = Eigen::VectorXd::Constant(1, 1e6);
  state.axial_force_N = Eigen::VectorXd::Zero(1);
  const ParametricSystem system = assemble(model, state);
  ASSERT_EQ(system.size(), 3);  // rotations are not reached
  // L = 100 m, l = 60 m, gamma = 80 kN/m3, sigma = 100 MPa: E_eq = 200e9 / (1 + 4.8e6² 200e9 / (12e24)) = 200e9 / 1.384.
  const double axial = 200e9 / 1.384 * 0.01 / 100.0, across = 1e6 / 100.0;
  const Eigen::Vector3d c(0.6, 0.0, 0.8);
  const Eigen::Matrix3d expected = axial * c * c.transpose() + across * (Eigen::Matrix3d::Identity() - c * c.transpose());
  EXPECT_LT((test::full(system.stiffness(system.initial())) - expected).norm(), 1e-9 * axial);
  EXPECT_LT((test::full(system.mass(system.initial())) - 4000.0 * Eigen::Matrix3d::Identity()).norm(), 1e-9);
}

TEST(Assembly, AxialForceStiffensBeamsByTheCubicForm) {
  const Model model = test::cantilever();
  PrestressState state;
  state.stay_pull_N = Eigen::VectorXd::Zero(2);
  state.axial_force_N = Eigen::VectorXd::Zero(2);
  state.axial_force_N << 0.0, 30e3;
  const ParametricSystem system = assemble(model, state);
  const Eigen::MatrixXd added = test::full(system.stiffness(system.initial())) - stiffness_of(model);
  EXPECT_NEAR(added(7, 7), 6.0 * 30e3 / (5.0 * 2.0), 1e-3);   // 6N/5L
  EXPECT_NEAR(added(11, 11), 2.0 * 2.0 * 30e3 / 15.0, 1e-3);  // 2NL/15
  EXPECT_NEAR(added(7, 11), -30e3 / 10.0, 1e-3);              // N/10
  EXPECT_NEAR(added(6, 6), 0.0, 1e-3);
}

TEST(Assembly, MassOnASupportVanishesAndMassOfAnUnreachedRotationBreaksNothing) {
  Model model = test::cantilever();
  model.masses.push_back({"anchor", 0, 1e6, Eigen::Vector3d::Zero()});
  model.masses.push_back({"tip", 2, 10.0, Eigen::Vector3d(1.0, 2.0, 3.0)});
  const ParametricSystem system = assemble(model, {});
  const ParametricSystem bare = assemble(test::cantilever(), {});
  const Eigen::MatrixXd added = test::full(system.mass(system.initial())) - test::full(bare.mass(bare.initial()));
  Eigen::VectorXd expected(12);
  expected << 0, 0, 0, 0, 0, 0, 10, 10, 10, 1, 2, 3;
  EXPECT_LT((added - Eigen::MatrixXd(expected.asDiagonal())).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Assembly, TotalMassIsWhatTheDrawingsSay) {
  // 12 m2 slab (and a triangle of 2 m2) of 0.1 m at 2400; four edge beams and a tie; half the stay hangs on the deck, half on
  // the mast (held).
  const Model model = test::one_of_everything();
  Model free = model;
  free.supports.clear();
  const ParametricSystem system = assemble(free, {});
  Eigen::VectorXd up = Eigen::VectorXd::Zero(system.size());
  for (Eigen::Index i = 0; i < up.size(); ++i) up[i] = system.dofs[static_cast<std::size_t>(i)].direction == 2 ? 1.0 : 0.0;
  const double panel = std::sqrt(9.0 + 0.01);
  const double stay = std::sqrt(900.0 + 17.9 * 17.9), tie = std::sqrt(9.0 + 4.0 + 0.01);
  const double expected =
      (2.0 * panel * 2.0 + 2.0) * 0.1 * 2400.0 + 4.0 * panel * 0.01 * 8000.0 + (stay + tie) * 1.3e-3 * 8289.0 + 300.0;
  const linalg::SparseMatrix m = system.mass(system.initial());
  EXPECT_NEAR(up.dot(m.selfadjointView<Eigen::Lower>() * up), expected, 1e-9 * expected);
}

}  // namespace
}  // namespace twindeck::fe
