#include "fe/bar.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "fe/beam.hpp"

namespace twindeck::fe {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

const std::array<Eigen::Vector3d, 2> kEnds = {Eigen::Vector3d(1.0, 2.0, 3.0), Eigen::Vector3d(4.0, 6.0, 15.0)};  // length 13

Vector6 rigid_motion(int d) {
  const Eigen::Vector3d e = Eigen::Vector3d::Unit(d % 3);
  Vector6 u;
  if (d < 3) {
    u << e, e;
  } else {
    u << e.cross(kEnds[0]), e.cross(kEnds[1]);
  }
  return u;
}

// Oracle: Hooke, force EA/L along the chord; six rigid motions without energy.
TEST(Bar, StiffnessIsAlongTheChord) {
  const Matrix6 k = bar_stiffness(kEnds, 210e9, 1e-3);
  const Eigen::Vector3d n = (kEnds[1] - kEnds[0]) / 13.0;
  Vector6 stretch;
  stretch << Eigen::Vector3d::Zero(), 1e-3 * n;
  const Vector6 force = k * stretch;
  EXPECT_NEAR((force.tail<3>() - 210e9 * 1e-3 * 1e-3 / 13.0 * n).norm(), 0.0, 1e-9);
  EXPECT_NEAR((force.tail<3>() + force.head<3>()).norm(), 0.0, 1e-9);
  for (int d = 0; d < 6; ++d) EXPECT_NEAR((k * rigid_motion(d)).norm() / k.norm(), 0.0, 1e-14);
}

// Oracle: equilibrium of a taut string: a small transverse displacement δ of one end asks for the force T δ/L; none along it.
TEST(Bar, StringStiffnessIsAcrossTheChord) {
  const double pull = 3e5;
  const Matrix6 k = string_stiffness(kEnds, pull);
  const Eigen::Vector3d n = (kEnds[1] - kEnds[0]) / 13.0;
  const Eigen::Vector3d across = n.unitOrthogonal();
  Vector6 u;
  u << Eigen::Vector3d::Zero(), across;
  EXPECT_NEAR(((k * u).tail<3>() - pull / 13.0 * across).norm(), 0.0, 1e-9);
  u << Eigen::Vector3d::Zero(), n;
  EXPECT_NEAR((k * u).norm(), 0.0, 1e-9);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR((k * rigid_motion(d)).norm(), 0.0, 1e-9);
}

// Oracle: Newton: total mass in each direction; consistent inertia of a rod about its centre μ L³/12, lumped μ L³/4.
TEST(Bar, MassAndInertia) {
  const double mu = 12.0;
  const Matrix6 consistent = bar_mass_consistent(kEnds, mu), lumped = bar_mass_lumped(kEnds, mu);
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(rigid_motion(d).dot(consistent * rigid_motion(d)), mu * 13.0, 1e-10);
    EXPECT_NEAR(rigid_motion(d).dot(lumped * rigid_motion(d)), mu * 13.0, 1e-10);
  }
  const Eigen::Vector3d across = (kEnds[1] - kEnds[0]).unitOrthogonal();
  Vector6 turn;
  turn << -6.5 * across, 6.5 * across;
  EXPECT_NEAR(turn.dot(consistent * turn), mu * 13.0 * 13.0 * 13.0 / 12.0, 1e-9);
  EXPECT_NEAR(turn.dot(lumped * turn), mu * 13.0 * 13.0 * 13.0 / 4.0, 1e-9);
}

// Oracle: first two frequencies of a taut string, f_n = n/(2L) sqrt(T/μ), with 40 elements; lumped mass errs by (nπ/N)²/24.
TEST(Bar, TautStringFrequencies) {
  const int elements = 40;
  const double length = 20.0, pull = 4e5, mu = 11.0;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(elements + 1, elements + 1), m = k;
  for (int e = 0; e < elements; ++e) {
    const std::array<Eigen::Vector3d, 2> x = {Eigen::Vector3d(length * e / elements, 0, 0),
                                              Eigen::Vector3d(length * (e + 1) / elements, 0, 0)};
    const Matrix6 ke = string_stiffness(x, pull), me = bar_mass_lumped(x, mu);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        k(e + i, e + j) += ke(3 * i + 2, 3 * j + 2);
        m(e + i, e + j) += me(3 * i + 2, 3 * j + 2);
      }
  }
  const int n = elements - 1;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(k.block(1, 1, n, n), m.block(1, 1, n, n));
  for (int mode = 1; mode <= 2; ++mode) {
    const double computed = std::sqrt(solver.eigenvalues()[mode - 1]);
    const double exact = mode * M_PI / length * std::sqrt(pull / mu);
    EXPECT_NEAR(computed / exact, 1.0, 1.1 * std::pow(mode * M_PI / elements, 2) / 24.0);
  }
}

// Oracle: the contract on bad input.
TEST(Bar, RefusesNoLength) { EXPECT_THROW((void)bar_stiffness({kEnds[0], kEnds[0]}, 1.0, 1.0), InputError); }

}  // namespace
}  // namespace twindeck::fe
