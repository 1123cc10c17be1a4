#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "dynamics/eigenmodes.hpp"
#include "inertia.hpp"
#include "linalg/generalized_eigen.hpp"
#include "random_system.hpp"
#include "sensitivity/frequency_jacobian.hpp"

/// Properties that modes and their derivatives have whatever the structure; each holds over random systems, small (solved
/// densely) and large (by Lanczos).
namespace {

using twindeck::dynamics::EigenModes;
using twindeck::dynamics::ModalSolver;
using twindeck::tests::random_system;

class ModesLaw : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  [[nodiscard]] twindeck::fe::ParametricSystem system() const {
    return random_system(static_cast<std::uint64_t>(std::get<0>(GetParam())), std::get<1>(GetParam()));
  }
  static constexpr int kModes = 8;
};

// Law: K phi = lambda M phi and Phi' M Phi = I.
TEST_P(ModesLaw, ModesSolveTheirEquation) {
  const auto s = system();
  ModalSolver solver(s);
  const EigenModes modes = solver.solve(s.initial(), kModes);
  ASSERT_TRUE(modes.status.converged) << modes.status.message;
  const Eigen::MatrixXd kx = s.stiffness(s.initial()).selfadjointView<Eigen::Lower>() * modes.shapes;
  const Eigen::MatrixXd mx = solver.mass().selfadjointView<Eigen::Lower>() * modes.shapes;
  for (int i = 0; i < kModes; ++i) {
    EXPECT_LT((kx.col(i) - modes.eigenvalue[i] * mx.col(i)).norm(), 1e-7 * kx.col(i).norm());
    EXPECT_GE(modes.shapes.col(i).maxCoeff(), (1.0 - 1e-9) * -modes.shapes.col(i).minCoeff());
    EXPECT_GE(modes.frequency_Hz[i], modes.frequency_Hz[std::max(0, i - 1)]);
  }
  EXPECT_LT((modes.shapes.transpose() * mx - Eigen::MatrixXd::Identity(kModes, kModes)).cwiseAbs().maxCoeff(), 1e-10);
}

// Law (Sylvester): as many negative pivots of K - s M as modes below s, so none was passed over.
TEST_P(ModesLaw, NoModeIsPassedOver) {
  const auto s = system();
  ModalSolver solver(s);
  const EigenModes modes = solver.solve(s.initial(), kModes);
  for (int i = 0; i + 1 < kModes; ++i) {
    if (modes.eigenvalue[i + 1] - modes.eigenvalue[i] < 1e-6 * modes.eigenvalue[i]) continue;
    const double between = 0.5 * (modes.eigenvalue[i] + modes.eigenvalue[i + 1]);
    EXPECT_EQ(count_eigenvalues_below(s.stiffness(s.initial()), solver.mass(), between), i + 1);
  }
}

// Law: K -> c² K gives f -> c f and leaves the shapes.
TEST_P(ModesLaw, FrequenciesScaleWithTheRootOfStiffness) {
  const auto s = system();
  const double c = 1.7;
  Eigen::VectorXd theta = s.initial();
  const EigenModes before = ModalSolver(s).solve(theta, kModes);
  theta.head(3) *= c * c;
  const EigenModes after = ModalSolver(s).solve(theta, kModes);
  EXPECT_LT((after.frequency_Hz - c * before.frequency_Hz).norm(), 1e-10 * before.frequency_Hz.norm());
  EXPECT_LT((after.shapes - before.shapes).norm(), 1e-5 * before.shapes.norm());
}

// Law (Euler, homogeneous functions): K is of degree one in its parameters and M in its own, so that
// sum theta_k df/dtheta_k = f/2 and sum theta_m df/dtheta_m = -f/2.
TEST_P(ModesLaw, DerivativesObeyTheSumRule) {
  const auto s = system();
  const EigenModes modes = ModalSolver(s).solve(s.initial(), kModes);
  const Eigen::MatrixXd jacobian = twindeck::sensitivity::frequency_jacobian(s, s.initial(), modes);
  const Eigen::VectorXd theta = s.initial();
  const Eigen::VectorXd stiffness = jacobian.leftCols(3) * theta.head(3), mass = jacobian.rightCols(2) * theta.tail(2);
  EXPECT_LT((stiffness - 0.5 * modes.frequency_Hz).norm(), 1e-8 * modes.frequency_Hz.norm());
  EXPECT_LT((mass + 0.5 * modes.frequency_Hz).norm(), 1e-8 * modes.frequency_Hz.norm());
}

// Law: stiffening raises every frequency, mass lowers it (Rayleigh).
TEST_P(ModesLaw, StiffnessRaisesMassLowers) {
  const auto s = system();
  const EigenModes modes = ModalSolver(s).solve(s.initial(), kModes);
  const Eigen::MatrixXd jacobian = twindeck::sensitivity::frequency_jacobian(s, s.initial(), modes);
  EXPECT_GE(jacobian.leftCols(3).minCoeff(), 0.0);
  EXPECT_LE(jacobian.rightCols(2).maxCoeff(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(RandomSystems, ModesLaw, testing::Combine(testing::Values(1, 2, 3), testing::Values(5, 24)));

}  // namespace
