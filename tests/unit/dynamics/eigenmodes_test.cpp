#include "dynamics/eigenmodes.hpp"

#include <gtest/gtest.h>

#include "spring_chain.hpp"

namespace {

using twindeck::dynamics::EigenModes;
using twindeck::dynamics::ModalSolver;
using twindeck::tests::SpringChain;

// Oracle: closed form, with few masses (dense) and many (Lanczos); frequencies and shapes.
TEST(ModalSolver, MeetsTheChainInClosedForm) {
  for (const int n : {8, 300}) {
    const SpringChain chain{.n = n};
    const auto system = chain.system();
    ModalSolver solver(system);
    const EigenModes modes = solver.solve(system.initial(), 5);
    ASSERT_TRUE(modes.status.converged) << modes.status.message;
    for (int j = 1; j <= 5; ++j) {
      EXPECT_NEAR(modes.frequency_Hz[j - 1] / chain.frequency_Hz(j), 1.0, 1e-11);
      Eigen::VectorXd shape(n);
      for (int i = 0; i < n; ++i) shape[i] = std::sin(j * std::numbers::pi * (i + 1) / (n + 1));
      shape *= std::sqrt(2.0 / (chain.m * (n + 1)));
      EXPECT_NEAR(std::abs(shape.dot(modes.shapes.col(j - 1))) / shape.squaredNorm(), 1.0, 1e-9);
    }
  }
}

// Oracle: closed form at other parameter values, from the modes and the ordering of the first solution.
TEST(ModalSolver, SolvesAgainWithNewParameters) {
  const SpringChain chain{.n = 200}, other{.n = 200, .k = 130.0, .m = 1.5};
  const auto system = chain.system();
  ModalSolver solver(system);
  (void)solver.solve(system.initial(), 6);
  Eigen::VectorXd theta = system.initial();
  theta[0] = other.k;
  theta[1] = other.m;
  const EigenModes modes = solver.solve(theta, 6);
  ASSERT_TRUE(modes.status.converged);
  for (int j = 1; j <= 6; ++j) EXPECT_NEAR(modes.frequency_Hz[j - 1] / other.frequency_Hz(j), 1.0, 1e-11);
  EXPECT_NEAR(solver.mass().coeff(0, 0), 1.5, 1e-15);
}

// Oracle: closed form. Two equal chains: each frequency twice.
TEST(ModalSolver, FindsRepeatedFrequencies) {
  const SpringChain chain{.n = 150, .copies = 2};
  const auto system = chain.system();
  ModalSolver solver(system);
  const EigenModes modes = solver.solve(system.initial(), 8);
  ASSERT_TRUE(modes.status.converged);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(modes.frequency_Hz[i] / chain.frequency_Hz(i / 2 + 1), 1.0, 1e-11);
}

// Oracle: closed form of the free chain, sqrt(lambda) = 2 sqrt(k/m) sin(j pi / (2 n)): the rigid mode comes out as 0 Hz.
TEST(ModalSolver, SolvesAFreeStructure) {
  for (const int n : {20, 200}) {
    const SpringChain chain{.n = n};
    auto system = chain.system();
    SpringChain::add_ground_spring(system, 0, -chain.k);
    SpringChain::add_ground_spring(system, n - 1, -chain.k);
    ModalSolver solver(system);
    const EigenModes modes = solver.solve(system.initial(), 4);
    ASSERT_TRUE(modes.status.converged) << modes.status.message;
    EXPECT_LT(modes.frequency_Hz[0], 1e-4 * modes.frequency_Hz[1]);
    for (int j = 1; j < 4; ++j) {
      const double omega = 2.0 * std::sqrt(chain.k / chain.m) * std::sin(j * std::numbers::pi / (2.0 * n));
      EXPECT_NEAR(modes.frequency_Hz[j] * 2.0 * std::numbers::pi / omega, 1.0, 1e-9);
    }
  }
}

// Oracle: the contract. A negative stiffness is not solved in silence.
TEST(ModalSolver, SaysWhenTheStiffnessIsNotPositive) {
  const SpringChain chain{.n = 30};
  auto system = chain.system();
  SpringChain::add_ground_spring(system, 15, -400.0);
  ModalSolver solver(system);
  const EigenModes modes = solver.solve(system.initial(), 3);
  EXPECT_FALSE(modes.status.converged);
  EXPECT_NE(modes.status.message.find("positive definite"), std::string::npos) << modes.status.message;
}

}  // namespace
