// Residuals of two masses in closed form: springs l, m, r = 400, 100, 400 N/m, omega² = 400 and 600. Further oracles: central
// differences; a count of solves; modes that cross.
#include "updating/residuals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "measured_chain.hpp"
#include "shaped_chain.hpp"

namespace twindeck::updating {
namespace {

using Eigen::VectorXd;

double frequency_of(double omega_squared) { return std::sqrt(omega_squared) / (2.0 * std::numbers::pi); }

ResidualDefinition definition_of(const fe::ParametricSystem& system, std::vector<FrequencyTarget> targets,
                                 std::vector<int> active, VectorXd scale, int n_modes) {
  ResidualDefinition out;
  out.targets = std::move(targets);
  out.active = std::move(active);
  out.initial = system.initial();
  out.scale = std::move(scale);
  out.n_modes = n_modes;
  dynamics::ModalSolver solver(system);
  const dynamics::EigenModes reference = solver.solve(out.initial, n_modes);
  out.follower = std::make_shared<const matching::ModeFollower>(solver.mass(), reference);
  return out;
}

struct TwoMasses {
  std::shared_ptr<const fe::ParametricSystem> system = std::make_shared<const fe::ParametricSystem>(two_masses().system());
  ResidualDefinition definition = definition_of(*system, {{"1", 0, 3.0}, {"2", 1, 4.0}}, {1}, VectorXd::Ones(1), 2);
};

TEST(ResidualDefinition, PutsActiveValuesInTheirPlace) {
  ResidualDefinition definition;
  definition.initial = Eigen::Vector3d(1.0, 2.0, 3.0);
  definition.active = {2, 0};
  definition.scale = Eigen::Vector2d(10.0, 100.0);
  EXPECT_EQ(definition.theta(Eigen::Vector2d(0.5, 0.25)), VectorXd(Eigen::Vector3d(25.0, 2.0, 5.0)));
}

// omega² = 400 for (1, 1), whatever the middle spring c; 400 + 200 c for (1, -1).
TEST(ModalResiduals, AreRelativeFrequencies) {
  const TwoMasses two;
  ModalResiduals residuals(two.system, two.definition);
  const Evaluation& at = residuals.at(VectorXd::Constant(1, 1.3), true);
  ASSERT_TRUE(at.valid);
  const double second = frequency_of(400.0 + 200.0 * 1.3);
  EXPECT_NEAR(at.residual(0), frequency_of(400.0) / 3.0 - 1.0, 1e-12);
  EXPECT_NEAR(at.residual(1), second / 4.0 - 1.0, 1e-12);
  // df/dc = 200 / (8 pi² f).
  EXPECT_NEAR(at.jacobian(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(at.jacobian(1, 0), 200.0 / (8.0 * std::numbers::pi * std::numbers::pi * second) / 4.0, 1e-10);
  EXPECT_NEAR(at.cost(), 0.5 * (at.residual(0) * at.residual(0) + at.residual(1) * at.residual(1)), 1e-15);
  EXPECT_NEAR(at.gradient()(0), at.jacobian(1, 0) * at.residual(1), 1e-14);
  EXPECT_NEAR(at.mac(1), 1.0, 1e-12);  // the shapes stay
}

TEST(ModalResiduals, OfATargetThatIsNotFittedVanish) {
  TwoMasses two;
  two.definition.targets[1].fitted = false;
  ModalResiduals residuals(two.system, two.definition);
  const Evaluation& at = residuals.at(VectorXd::Constant(1, 1.3), true);
  EXPECT_EQ(at.residual(1), 0.0);
  EXPECT_EQ(at.jacobian.row(1).norm(), 0.0);
  EXPECT_NEAR(at.frequency_Hz(1), frequency_of(660.0), 1e-10);  // it is followed all the same
}

// A negative middle spring c < 0 puts (1, -1) below (1, 1): the targets keep their shapes.
TEST(ModalResiduals, FollowModesThatCross) {
  const TwoMasses two;
  ModalResiduals residuals(two.system, two.definition);
  const Evaluation& at = residuals.at(VectorXd::Constant(1, -0.5), false);
  ASSERT_TRUE(at.valid);
  EXPECT_EQ(at.mode, (std::vector<int>{1, 0}));
  EXPECT_NEAR(at.frequency_Hz(0), frequency_of(400.0), 1e-10);
  EXPECT_NEAR(at.frequency_Hz(1), frequency_of(300.0), 1e-10);
}

// Central differences with a scale that is not 1, for a stiffness and a mass of a chain without symmetry. The error of the
// difference is h²/6 of the third derivative, 1e-9 here.
TEST(ModalResiduals, JacobianIsThatOfTheResiduals) {
  SmallSystem small(4);
  const int k = small.parameter("k", 2.0, 1.0, 4.0), m = small.parameter("m", 5.0, 2.0, 9.0);
  small.stiffness(30.0 * spring(4, 0, -1) + 20.0 * spring(4, 1, 2), k)
      .stiffness(50.0 * spring(4, 0, 1) + 45.0 * spring(4, 2, 3) + 70.0 * spring(4, 3, -1))
      .mass(Eigen::Vector4d(1.0, 0.0, 0.3, 0.0).asDiagonal().toDenseMatrix(), m)
      .mass(Eigen::Vector4d(1.0, 2.0, 1.5, 1.0).asDiagonal().toDenseMatrix());
  const auto system = std::make_shared<const fe::ParametricSystem>(small.system());
  const ResidualDefinition definition =
      definition_of(*system, {{"1", 0, 0.4}, {"3", 2, 1.1}}, {m, k}, Eigen::Vector2d(5.0, 2.0), 4);
  ModalResiduals residuals(system, definition);
  const Eigen::Vector2d x(1.1, 0.9);
  const Eigen::MatrixXd jacobian = residuals.at(x, true).jacobian;
  for (int j = 0; j < 2; ++j) {
    const Eigen::Vector2d h = 1e-4 * Eigen::Vector2d::Unit(j);
    const VectorXd above = residuals.at(x + h, false).residual, below = residuals.at(x - h, false).residual;
    EXPECT_LT((jacobian.col(j) - (above - below) / 2e-4).norm(), 1e-7) << j;
  }
}

// The same for rows with covariance and shapes at three of five masses.
TEST(ModalResiduals, JacobianOfWeighedRowsIsThatOfTheResiduals) {
  const auto system = std::make_shared<const fe::ParametricSystem>(twin_chain(5, 0.3, 1.7).system());
  const ShapedMeasurement measured = measure_chain(*system, Eigen::Vector2d(0.8, 1.1), {0, 1, 3}, 3, 0.01, 0.02, nullptr);
  ResidualDefinition definition = definition_of(*system, measured.targets, {0, 1}, Eigen::Vector2d::Ones(), 5);
  VectorXd frequency_Hz(3);
  for (int i = 0; i < 3; ++i) frequency_Hz(i) = measured.targets[static_cast<std::size_t>(i)].measured_Hz;
  definition.weighted = std::make_shared<const WeightedRows>(std::make_shared<const MeasuredRows>(measured.rows), frequency_Hz,
                                                             std::vector<bool>(3, true));
  EXPECT_EQ(definition.n_residuals(), 3 + 3 * 3);
  EXPECT_DOUBLE_EQ(definition.negligible_residual(), 1.0);
  ModalResiduals residuals(system, definition);
  // Rows without error vanish at the values that they were made with.
  EXPECT_LT(residuals.at(Eigen::Vector2d(0.8, 1.1), false).residual.norm(), 1e-6);
  const Eigen::Vector2d x(1.05, 0.9);
  const Evaluation at = residuals.at(x, true);
  ASSERT_TRUE(at.valid);
  EXPECT_EQ(at.scales, 3);
  for (int j = 0; j < 2; ++j) {
    const Eigen::Vector2d h = 1e-4 * Eigen::Vector2d::Unit(j);
    const VectorXd above = residuals.at(x + h, false).residual, below = residuals.at(x - h, false).residual;
    EXPECT_LT((at.jacobian.col(j) - (above - below) / 2e-4).norm(), 1e-5 * at.jacobian.col(j).norm()) << j;
  }
}

// One solve a point; a Jacobian asked for at a point of before costs one more, and is the same.
TEST(ModalResiduals, KeepTheLastPoints) {
  const TwoMasses two;
  ModalResiduals residuals(two.system, two.definition);
  const VectorXd first = VectorXd::Constant(1, 1.1), second = VectorXd::Constant(1, 1.4);
  (void)residuals.at(first, false);
  (void)residuals.at(second, true);
  (void)residuals.at(first, false);
  EXPECT_EQ(residuals.solves(), 2);
  const Evaluation again = residuals.at(first, true);
  EXPECT_EQ(residuals.solves(), 3);
  ModalResiduals fresh(two.system, two.definition);
  EXPECT_EQ(again.jacobian, fresh.at(first, true).jacobian);
  EXPECT_EQ(fresh.solves(), 1);
  // Eight points are kept: after nine others the first is solved anew.
  for (int i = 0; i < 9; ++i) (void)residuals.at(VectorXd::Constant(1, 2.0 + i), false);
  (void)residuals.at(first, false);
  EXPECT_EQ(residuals.solves(), 3 + 9 + 1);
}

// Springs that pull apart: K is indefinite, so there are no modes and the point is not valid.
TEST(ModalResiduals, AreNotValidWithoutModes) {
  const TwoMasses two;
  ModalResiduals residuals(two.system, two.definition);
  EXPECT_FALSE(residuals.at(VectorXd::Constant(1, -10.0), true).valid);
  EXPECT_EQ(residuals.at(VectorXd::Constant(1, -10.0), true).jacobian.size(), 0);
}

}  // namespace
}  // namespace twindeck::updating
