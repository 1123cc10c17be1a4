#include "sensitivity/frequency_jacobian.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "dynamics/loaded_model.hpp"
#include "unit/fe/assembly_models.hpp"
#include "unit/updating/chain.hpp"

namespace twindeck::sensitivity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using updating::SmallSystem;
using updating::spring;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

MatrixXd jacobian_of(const fe::ParametricSystem& system, const VectorXd& theta, int n_modes) {
  return frequency_jacobian(system, theta, dynamics::available_modes(system, theta, n_modes));
}

/// A mass matrix with couplings and a stiffness of three springs, without any symmetry.
SmallSystem coupled() {
  SmallSystem small(3);
  for (const char* name : {"k1", "k2", "k3", "m"}) small.parameter(name, 1.0, 0.1, 10.0);
  small.stiffness(50.0 * spring(3, 0, -1), 0).stiffness(30.0 * spring(3, 0, 1), 1).stiffness(20.0 * spring(3, 1, 2), 2);
  small.stiffness(4.0 * spring(3, 2, -1));
  small.mass((MatrixXd(3, 3) << 2.0, 0.3, 0.1, 0.3, 1.0, 0.2, 0.1, 0.2, 1.5).finished(), 3);
  return small;
}

// Oracle: central differences of dense eigenvalues (Eigen), extrapolated; a step of 1e-3 leaves 1e-10.
TEST(FrequencyJacobianOfFullMatrices, EqualsDifferencesOfDenseEigenvalues) {
  const SmallSystem small = coupled();
  const VectorXd theta = (VectorXd(4) << 1.2, 0.8, 1.5, 0.9).finished();
  const MatrixXd jacobian = jacobian_of(small.system(), theta, 3);
  for (Index p = 0; p < 4; ++p) {
    const auto central = [&](double h) {
      const VectorXd step = h * VectorXd::Unit(4, p);
      return VectorXd((updating::dense_frequencies(small.system(), theta + step) -
                       updating::dense_frequencies(small.system(), theta - step)) /
                      (2.0 * h));
    };
    EXPECT_LT((jacobian.col(p) - (4.0 * central(5e-4) - central(1e-3)) / 3.0).norm(), 1e-8) << p;
  }
}

// Oracle: Euler's theorem. Every stiffness has a parameter and f is homogeneous of degree 1/2 in all of them together, so that
// the sum of theta df/dtheta is f/2.
TEST(FrequencyJacobianOfFullMatrices, IsHomogeneous) {
  SmallSystem small(3);
  for (const char* name : {"k1", "k2", "k3"}) small.parameter(name, 1.0, 0.1, 10.0);
  small.stiffness(50.0 * spring(3, 0, -1), 0).stiffness(30.0 * spring(3, 0, 1), 1).stiffness(20.0 * spring(3, 1, 2), 2);
  small.mass((MatrixXd(3, 3) << 2.0, 0.3, 0.1, 0.3, 1.0, 0.2, 0.1, 0.2, 1.5).finished());
  const VectorXd theta = Eigen::Vector3d(1.2, 0.8, 1.5);
  const VectorXd f = updating::dense_frequencies(small.system(), theta);
  EXPECT_LT((jacobian_of(small.system(), theta, 3) * theta - 0.5 * f).norm(), 1e-9);
}

// Oracle: closed form. Two equal masses, tied by a spring and free: one mode stays at zero whatever the spring, the other has
// lambda = 2 k/m and df/dk = f/(2 k). Rounding of the rigid body's shape and frequency changes nothing.
TEST(FrequencyJacobianOfFullMatrices, LeavesRigidBodiesAtZero) {
  SmallSystem small(2);
  small.parameter("k", 50.0, 1.0, 100.0);
  small.stiffness(spring(2, 0, 1), 0).mass(MatrixXd::Identity(2, 2));
  const VectorXd theta = VectorXd::Constant(1, 50.0);
  dynamics::EigenModes modes = dynamics::available_modes(small.system(), theta, 2);
  for (const double rounding : {0.0, 1e-8}) {
    modes.shapes(0, 0) += rounding;
    modes.frequency_Hz[0] = rounding;
    const MatrixXd jacobian = frequency_jacobian(small.system(), theta, modes);
    ASSERT_EQ(jacobian.rows(), 2);
    EXPECT_EQ(jacobian(0, 0), 0.0);
    EXPECT_NEAR(jacobian(1, 0), 10.0 / kTwoPi / 100.0, 1e-9);
  }
}

// Oracle: hand calculation. Two equal masses on springs 1 + a and 1 + 2 b, tied by c, at a = b = c = 0: lambda = 1 twice. A
// parameter that ties moves one of them by 2 dc and the other not; one that stiffens a single spring moves one by da or 2 db,
// the one whose shape is nearer to that mass. The basis that the solver returns does not matter otherwise.
TEST(FrequencyJacobianOfFullMatrices, DifferentiatesARepeatedPair) {
  SmallSystem small(2);
  for (const char* name : {"a", "b", "c"}) small.parameter(name, 0.0, -1.0, 1.0);
  small.stiffness(MatrixXd::Identity(2, 2)).mass(MatrixXd::Identity(2, 2));
  small.stiffness(spring(2, 0, -1), 0).stiffness(2.0 * spring(2, 1, -1), 1).stiffness(spring(2, 0, 1), 2);
  const VectorXd theta = VectorXd::Zero(3);
  dynamics::EigenModes modes = dynamics::available_modes(small.system(), theta, 2);
  for (const double angle : {0.0, 0.4, 1.1}) {
    modes.shapes << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const MatrixXd jacobian = frequency_jacobian(small.system(), theta, modes, 1e-6);
    for (const auto& [p, moved] : {std::pair{0, 1.0}, std::pair{1, 2.0}, std::pair{2, 2.0}}) {
      EXPECT_NEAR(jacobian.col(p).minCoeff(), 0.0, 1e-9);
      EXPECT_NEAR(jacobian.col(p).maxCoeff(), 0.5 * moved / kTwoPi, 1e-9);
    }
    const Index at_first = angle < 0.5 ? 0 : 1;  // the mode that moves the first mass most
    EXPECT_GT(jacobian(at_first, 0), jacobian(1 - at_first, 0)) << angle;
    EXPECT_LT(jacobian(at_first, 1), jacobian(1 - at_first, 1)) << angle;
  }
}

// Oracle: closed forms of a cantilever of Euler beams, whose matrices scale as a whole. f ~ sqrt(E) and 1/sqrt(rho), so that
// d ln f/d ln E = 1/2 and d ln f/d ln rho = -1/2 in every mode.
TEST(FrequencyJacobianOfABeam, ScalesWithModulusAndDensity) {
  fe::Model built = fe::test::cantilever();
  built.parameters.push_back({"E", fe::Target::youngs_modulus, {"steel"}, "Pa", 200e9, 100e9, 300e9});
  built.parameters.push_back({"rho", fe::Target::density, {"steel"}, "kg/m3", 8000.0, 4000.0, 9000.0});
  const dynamics::LoadedModel model = dynamics::from_model(built);
  const dynamics::EigenModes modes = dynamics::available_modes(model.system, model.theta, 4);
  const MatrixXd jacobian = frequency_jacobian(model.system, model.theta, modes);
  for (Index i = 0; i < 4; ++i) {
    EXPECT_NEAR(jacobian(i, 0) * 200e9 / modes.frequency_Hz[i], 0.5, 1e-9) << i;
    EXPECT_NEAR(jacobian(i, 1) * 8000.0 / modes.frequency_Hz[i], -0.5, 1e-9) << i;
  }
}

}  // namespace
}  // namespace twindeck::sensitivity
