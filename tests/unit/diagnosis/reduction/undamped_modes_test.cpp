// Oracles: the closed form of masses in a row between two walls, omega = 2 sqrt(k/m) sin(i pi / (2 (n + 1))); the scaling that
// the header states; a free pair of masses, omega² = 2 k / m.
#include "diagnosis/reduction/undamped_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "unit/diagnosis/matrix_model.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::UndampedModes;
using diagnosis::UndampedStore;
using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kAll = std::numeric_limits<double>::infinity();
constexpr int kMasses = 7;
constexpr double kSpring = 2e6, kMass = 1000.0;

double row_eigenvalue(int i) {
  return 4.0 * kSpring / kMass * std::pow(std::sin(i * std::numbers::pi / (2.0 * (kMasses + 1))), 2);
}

MatrixXd row_stiffness() { return springs_in_a_row(Eigen::VectorXd::Constant(kMasses + 1, kSpring)); }
MatrixXd row_mass() { return kMass * MatrixXd::Identity(kMasses, kMasses); }

TEST(UndampedModes, OfMassesInARowAreTheClosedForm) {
  const UndampedModes modes(row_stiffness(), row_mass(), kAll);
  ASSERT_EQ(modes.size(), kMasses);
  EXPECT_EQ(modes.shift, 0.0);
  for (int i = 0; i < kMasses; ++i) {
    EXPECT_NEAR(modes.eigenvalue(i) / row_eigenvalue(i + 1), 1.0, 1e-12) << i;
    // Shape i is sin(i j pi / (n + 1)).
    Eigen::VectorXd sine(kMasses);
    for (int j = 0; j < kMasses; ++j) sine[j] = std::sin((i + 1) * (j + 1) * std::numbers::pi / (kMasses + 1));
    EXPECT_NEAR(std::abs(sine.normalized().dot(modes.shapes.col(i).normalized())), 1.0, 1e-12) << i;
  }
}

TEST(UndampedModes, AreScaledToUnitStrainEnergy) {
  const UndampedModes modes(row_stiffness(), row_mass(), kAll);
  const MatrixXd energy = modes.shapes.transpose() * row_stiffness() * modes.shapes;
  const MatrixXd inertia = modes.shapes.transpose() * row_mass() * modes.shapes;
  EXPECT_LT((energy - MatrixXd::Identity(kMasses, kMasses)).norm(), 1e-12);
  EXPECT_LT((inertia - MatrixXd(modes.mu.asDiagonal())).norm(), 1e-12 * modes.mu[0]);
}

TEST(UndampedModes, UpToALimitAreTheLowOnes) {
  const double between = 0.5 * (row_eigenvalue(3) + row_eigenvalue(4));
  const UndampedModes modes(row_stiffness(), row_mass(), between);
  ASSERT_EQ(modes.size(), 3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(modes.eigenvalue(i) / row_eigenvalue(i + 1), 1.0, 1e-12) << i;
}

TEST(UndampedModes, MotionWithoutMassIsInfinitelyFast) {
  // One of two dofs has no mass: k on each side of it leaves k/2 for the other, beside its own spring.
  MatrixXd k(2, 2), m = MatrixXd::Zero(2, 2);
  k << 2.0 * kSpring, -kSpring, -kSpring, 2.0 * kSpring;
  m(0, 0) = kMass;
  const UndampedModes modes(k, m, kAll);
  ASSERT_EQ(modes.size(), 2);
  EXPECT_NEAR(modes.eigenvalue(0) / (1.5 * kSpring / kMass), 1.0, 1e-12);
  EXPECT_GT(modes.eigenvalue(1), 1e12 * modes.eigenvalue(0));  // rounding may leave it a mass of 1e-16 of the other's
}

TEST(UndampedModes, OfAFreePairAreTheRigidBodyAndTheSpring) {
  MatrixXd k(2, 2);
  k << kSpring, -kSpring, -kSpring, kSpring;
  const UndampedModes modes(k, kMass * MatrixXd::Identity(2, 2), kAll);
  EXPECT_GT(modes.shift, 0.0);
  const double spring = 2.0 * kSpring / kMass;
  EXPECT_LT(modes.eigenvalue(0), 1e-12 * spring);  // the shift of 1e-7 is taken off again, to rounding
  EXPECT_NEAR(modes.eigenvalue(1) / spring, 1.0, 1e-8);
  EXPECT_NEAR(modes.shapes(0, 0) / modes.shapes(1, 0), 1.0, 1e-6);
  EXPECT_NEAR(modes.shapes(0, 1) / modes.shapes(1, 1), -1.0, 1e-6);
}

TEST(UndampedModes, OfAStructureThatFallsAreNone) {
  MatrixXd k = row_stiffness();
  k(2, 2) = -kSpring;
  const UndampedModes modes(k, row_mass(), kAll);
  EXPECT_TRUE(modes.mu.isZero(0.0));
  for (Index i = 0; i < modes.size(); ++i) EXPECT_EQ(modes.eigenvalue(i), kAll);
}

TEST(UndampedStore, KnowsMatricesAgain) {
  UndampedStore store;
  const UndampedModes& first = store.of(row_stiffness(), row_mass());
  EXPECT_EQ(&store.of(row_stiffness(), row_mass()), &first);
  EXPECT_EQ(&store.of(row_stiffness(), row_mass(), row_eigenvalue(2)), &first);  // all of them hold the low ones
  EXPECT_NE(&store.of(1.01 * row_stiffness(), row_mass()), &first);
  EXPECT_NE(&store.of(row_stiffness(), 1.01 * row_mass()), &first);
}

TEST(UndampedStore, ComputesMoreWhereMoreAreWanted) {
  UndampedStore store;
  EXPECT_EQ(store.of(row_stiffness(), row_mass(), 1.01 * row_eigenvalue(2)).size(), 2);
  EXPECT_EQ(store.of(row_stiffness(), row_mass(), 1.01 * row_eigenvalue(4)).size(), 4);
}

TEST(UndampedStore, LooksIntoTheSharedOneFirst) {
  UndampedStore shared;
  const UndampedModes& known = shared.of(row_stiffness(), row_mass());
  UndampedStore own(&shared);
  EXPECT_EQ(&own.of(row_stiffness(), row_mass()), &known);
  const UndampedModes& further = own.of(2.0 * row_stiffness(), row_mass());
  EXPECT_NE(&shared.of(2.0 * row_stiffness(), row_mass()), &further);  // what the other finds is not put into it
}

}  // namespace
}  // namespace twindeck::tests
