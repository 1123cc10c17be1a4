// Oracles: the roots of one degree of freedom in wind in closed form; each eigenvalue of a Maxwell unit satisfies its cubic.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>

#include "aero/aeroelastic_system.hpp"

namespace {

using namespace twindeck;

// λ² + (2ξω - ca) λ + ω² - ka = 0.
TEST(StateMatrix, WindActsAsDampingAndStiffness) {
  aero::ReducedStructure s;
  s.omega_rad_s = Eigen::VectorXd::Constant(1, 4.0);
  s.damping_ratio = Eigen::VectorXd::Constant(1, 0.02);
  const double ca = 0.3, ka = 1.5, c = 2 * 0.02 * 4.0 - ca, k = 16.0 - ka;
  const aero::AeroelasticSystem::Block air{Eigen::MatrixXd::Constant(1, 1, ca), Eigen::MatrixXd::Constant(1, 1, ka)};
  const Eigen::VectorXcd found = aero::state_matrix(s, air).eigenvalues();
  ASSERT_EQ(found.size(), 2);
  EXPECT_NEAR(found[0].real(), -0.5 * c, 1e-13);
  EXPECT_NEAR(std::abs(found[0].imag()), std::sqrt(k - 0.25 * c * c), 1e-13);
  const Eigen::MatrixXd still = aero::state_matrix(s);
  EXPECT_EQ(still(1, 0), -16.0);
  EXPECT_NEAR(still(1, 1), -0.16, 1e-15);
}

// (λ² + ω²)(k + λc) + λ k c d² = 0.
TEST(StateMatrix, AMaxwellUnitHasAStateOfItsOwn) {
  aero::ReducedStructure s;
  s.omega_rad_s = Eigen::VectorXd::Constant(1, 3.0);
  s.damping_ratio = Eigen::VectorXd::Zero(1);
  s.maxwell = {{7.0, 2.0, Eigen::VectorXd::Constant(1, 1.5)}};
  const Eigen::MatrixXd a = aero::state_matrix(s);
  ASSERT_EQ(a.rows(), 3);
  for (const std::complex<double>& x : a.eigenvalues()) {
    const std::complex<double> left = (x * x + 9.0) * (7.0 + 2.0 * x) + x * 7.0 * 2.0 * 2.25;
    EXPECT_LT(std::abs(left), 1e-11) << x.real();
  }
}

}  // namespace
