#include "sensitivity/channel_sensitivity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "dynamics/loaded_model.hpp"
#include "unit/updating/chain.hpp"

namespace twindeck::sensitivity {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using updating::SmallSystem;
using updating::spring;

/// The lowest modes of dense matrices by Eigen, mass-normalised, the signs as in `like`.
MatrixXd dense_shapes(const fe::ParametricSystem& system, const VectorXd& theta, const MatrixXd& like) {
  const MatrixXd k = MatrixXd(system.stiffness(theta)).selfadjointView<Eigen::Lower>();
  const MatrixXd m = MatrixXd(system.mass(theta)).selfadjointView<Eigen::Lower>();
  MatrixXd shapes = Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(k, m).eigenvectors().leftCols(like.cols());
  for (Index i = 0; i < shapes.cols(); ++i)
    if (shapes.col(i).dot(m * like.col(i)) < 0.0) shapes.col(i) *= -1.0;
  return shapes;
}

/// Central differences of dense shapes, extrapolated, against the derivatives at the channels.
void expect_differences(const fe::ParametricSystem& system, const VectorXd& theta, int n_modes, const MatrixXd& channels) {
  const dynamics::EigenModes modes = dynamics::available_modes(system, theta, n_modes);
  const std::vector<MatrixXd> found = channel_shape_derivatives(system, theta, modes, channels);
  ASSERT_EQ(found.size(), system.parameters.size());
  for (std::size_t p = 0; p < found.size(); ++p) {
    const auto central = [&](double h) {
      const VectorXd step = h * VectorXd::Unit(theta.size(), static_cast<Index>(p));
      return MatrixXd(channels.transpose() *
                      (dense_shapes(system, theta + step, modes.shapes) - dense_shapes(system, theta - step, modes.shapes)) /
                      (2.0 * h));
    };
    const MatrixXd whole = (4.0 * central(5e-4) - central(1e-3)) / 3.0;
    ASSERT_EQ(found[p].rows(), channels.cols());
    EXPECT_LT((found[p] - whole).norm(), 1e-6 * (1.0 + whole.norm())) << p;
  }
}

/// Five masses in a row, coupled in mass too; parameters scale two springs and a part of the mass.
SmallSystem row_of_five(bool held) {
  SmallSystem small(5);
  for (const char* name : {"k1", "k3", "m"}) small.parameter(name, 1.0, 0.1, 10.0);
  small.stiffness(30.0 * spring(5, 0, 1), 0).stiffness(20.0 * spring(5, 1, 2)).stiffness(25.0 * spring(5, 2, 3), 1);
  small.stiffness(15.0 * spring(5, 3, 4));
  if (held) small.stiffness(10.0 * spring(5, 0, -1)).stiffness(4.0 * spring(5, 4, -1));
  const MatrixXd fixed = Eigen::Vector<double, 5>(2.0, 1.0, 1.5, 1.2, 0.8).asDiagonal();
  MatrixXd scaled = MatrixXd::Zero(5, 5);
  scaled.block(1, 1, 2, 2) << 0.4, 0.1, 0.1, 0.3;
  small.mass(fixed).mass(scaled, 2);
  return small;
}

// Oracle: central differences of dense eigenvectors (Eigen), a held structure and all its modes or some. One channel is a
// difference of two masses.
TEST(ChannelShapeDerivativesOfFullMatrices, EqualDifferencesOfDenseShapes) {
  MatrixXd channels = MatrixXd::Zero(5, 3);
  channels(1, 0) = channels(4, 1) = channels(2, 2) = 1.0;
  channels(3, 2) = -1.0;
  const SmallSystem small = row_of_five(true);
  for (const int n_modes : {1, 3, 5}) expect_differences(small.system(), Eigen::Vector3d(1.2, 0.8, 1.4), n_modes, channels);
}

// Oracle: the same for a structure that is free as a rigid body, which the solver shifts.
TEST(ChannelShapeDerivativesOfFullMatrices, HoldForAFreeStructure) {
  MatrixXd channels = MatrixXd::Zero(5, 2);
  channels(0, 0) = channels(3, 1) = 1.0;
  expect_differences(row_of_five(false).system(), Eigen::Vector3d(1.2, 0.8, 1.4), 3, channels);
}

// Oracle: linearity. A channel is a covector: its derivative is that of its parts, weighted.
TEST(ChannelShapeDerivativesOfFullMatrices, AreLinearInTheChannels) {
  const SmallSystem small = row_of_five(true);
  const VectorXd theta = Eigen::Vector3d(1.2, 0.8, 1.4);
  const dynamics::EigenModes modes = dynamics::available_modes(small.system(), theta, 3);
  const MatrixXd weights = (MatrixXd(5, 2) << 1.0, 0.0, -2.0, 0.5, 0.0, 0.3, 0.7, 0.0, 0.0, 4.0).finished();
  const std::vector<MatrixXd> all = channel_shape_derivatives(small.system(), theta, modes, MatrixXd::Identity(5, 5));
  const std::vector<MatrixXd> some = channel_shape_derivatives(small.system(), theta, modes, weights);
  for (std::size_t p = 0; p < 3; ++p) EXPECT_LT((some[p] - weights.transpose() * all[p]).norm(), 1e-6 * all[p].norm()) << p;
}

// Oracle: the normalisation. phi_i' M dphi_i = -1/2 phi_i' dM phi_i, and phi_i' M dphi_j + phi_j' M dphi_i = -phi_i' dM phi_j.
TEST(ChannelShapeDerivativesOfFullMatrices, KeepTheShapesOrthonormal) {
  const SmallSystem small = row_of_five(true);
  const VectorXd theta = Eigen::Vector3d(1.2, 0.8, 1.4);
  const dynamics::EigenModes modes = dynamics::available_modes(small.system(), theta, 3);
  const MatrixXd m = MatrixXd(small.system().mass(theta)).selfadjointView<Eigen::Lower>();
  const std::vector<MatrixXd> all = channel_shape_derivatives(small.system(), theta, modes, MatrixXd::Identity(5, 5));
  for (int p = 0; p < 3; ++p) {
    const MatrixXd product = modes.shapes.transpose() * m * all[static_cast<std::size_t>(p)];
    const MatrixXd change = modes.shapes.transpose() * small.system().mass_derivative_times(theta, p, modes.shapes);
    EXPECT_LT((product + product.transpose() + change).norm(), 1e-6) << p;
  }
}

}  // namespace
}  // namespace twindeck::sensitivity
