#include <gtest/gtest.h>

#include <Eigen/LU>

#include "sensitivity/channel_sensitivity.hpp"
#include "sensitivity/frequency_jacobian.hpp"
#include "unit/dynamics/spring_chain.hpp"

namespace {

using twindeck::dynamics::EigenModes;
using twindeck::dynamics::ModalSolver;
using twindeck::fe::ParametricSystem;
using twindeck::sensitivity::channel_shape_derivatives;
using twindeck::sensitivity::frequency_jacobian;
using twindeck::tests::SpringChain;

EigenModes solve(const ParametricSystem& system, const Eigen::VectorXd& theta, int n) {
  ModalSolver solver(system);
  return solver.solve(theta, n);
}

// Oracle: closed form. f ~ sqrt(k/m), so df/dk = f/(2k) and df/dm = -f/(2m).
TEST(FrequencyJacobian, MeetsTheClosedForm) {
  for (const int n : {9, 200}) {
    const SpringChain chain{.n = n};
    const auto system = chain.system();
    const EigenModes modes = solve(system, system.initial(), 5);
    const Eigen::MatrixXd jacobian = frequency_jacobian(system, system.initial(), modes);
    for (int j = 1; j <= 5; ++j) {
      EXPECT_NEAR(jacobian(j - 1, 0) / (chain.frequency_Hz(j) / (2.0 * chain.k)), 1.0, 1e-9);
      EXPECT_NEAR(jacobian(j - 1, 1) / (-chain.frequency_Hz(j) / (2.0 * chain.m)), 1.0, 1e-9);
    }
  }
}

// Oracle: central differences of the solution itself, extrapolated (error of fourth order).
TEST(FrequencyJacobian, EqualsFiniteDifferences) {
  auto system = SpringChain{.n = 120}.system();
  SpringChain::add_ground_spring(system, 37, 3.0);
  const Eigen::VectorXd theta = system.initial();
  const EigenModes modes = solve(system, theta, 6);
  const Eigen::MatrixXd jacobian = frequency_jacobian(system, theta, modes);
  const int p = static_cast<int>(theta.size()) - 1;
  const auto central = [&](double h) {
    Eigen::VectorXd up = theta, down = theta;
    up[p] += h;
    down[p] -= h;
    return Eigen::VectorXd((solve(system, up, 6).frequency_Hz - solve(system, down, 6).frequency_Hz) / (2.0 * h));
  };
  const Eigen::VectorXd extrapolated = (4.0 * central(0.005) - central(0.01)) / 3.0;
  EXPECT_LT((jacobian.col(p) - extrapolated).cwiseAbs().maxCoeff(), 1e-7 * extrapolated.cwiseAbs().maxCoeff());
}

// Oracle: closed form. Two equal chains, of which parameter 2 stiffens the first alone: of each doubled frequency one copy
// moves at f/2 and the other not at all, whatever the basis that the solver returned for the pair. The quotient phi'dK phi of a
// mixed basis gives something in between.
TEST(FrequencyJacobian, SplitsRepeatedFrequencies) {
  const SpringChain chain{.n = 100, .copies = 2};
  const auto system = chain.system();
  EigenModes modes = solve(system, system.initial(), 6);
  for (int pair = 0; pair < 3; ++pair) {  // mixed on purpose
    const Eigen::MatrixXd phi = modes.shapes.middleCols(2 * pair, 2);
    modes.shapes.col(2 * pair) = 0.6 * phi.col(0) + 0.8 * phi.col(1);
    modes.shapes.col(2 * pair + 1) = -0.8 * phi.col(0) + 0.6 * phi.col(1);
  }
  const Eigen::MatrixXd jacobian = frequency_jacobian(system, system.initial(), modes, 1e-6);
  for (int pair = 0; pair < 3; ++pair) {
    const double f = chain.frequency_Hz(pair + 1);
    const double low = std::min(jacobian(2 * pair, 2), jacobian(2 * pair + 1, 2));
    const double high = std::max(jacobian(2 * pair, 2), jacobian(2 * pair + 1, 2));
    EXPECT_NEAR(low, 0.0, 1e-8 * f);
    EXPECT_NEAR(high, 0.5 * f, 1e-7 * f);
  }
}

/// A channel at every seventh degree of freedom.
Eigen::MatrixXd spread_channels(const ParametricSystem& system) {
  constexpr Eigen::Index apart = 7;
  Eigen::MatrixXd channels = Eigen::MatrixXd::Zero(system.size(), system.size() / apart);
  for (Eigen::Index c = 0; c < channels.cols(); ++c) channels(apart * c + apart / 2, c) = 1.0;
  return channels;
}

void expect_shape_derivative(const ParametricSystem& system, int parameter, int n_modes, double h, double tolerance) {
  const Eigen::VectorXd theta = system.initial();
  const EigenModes modes = solve(system, theta, n_modes);
  const Eigen::MatrixXd channels = spread_channels(system);
  const Eigen::MatrixXd derivative =
      channel_shape_derivatives(system, theta, modes, channels)[static_cast<std::size_t>(parameter)];
  const auto shapes_at = [&](double step) {
    Eigen::VectorXd moved = theta;
    moved[parameter] += step;
    Eigen::MatrixXd shapes = solve(system, moved, n_modes).shapes;
    for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
      if (shapes.col(i).dot(modes.shapes.col(i)) < 0.0) shapes.col(i) *= -1.0;
    }
    return Eigen::MatrixXd(channels.transpose() * shapes);
  };
  const auto central = [&](double step) { return Eigen::MatrixXd((shapes_at(step) - shapes_at(-step)) / (2.0 * step)); };
  const Eigen::MatrixXd extrapolated = (4.0 * central(0.5 * h) - central(h)) / 3.0;
  for (Eigen::Index i = 0; i < derivative.cols(); ++i) {
    EXPECT_LT((derivative.col(i) - extrapolated.col(i)).norm(), tolerance * extrapolated.col(i).norm()) << "mode " << i + 1;
  }
}

// Oracle: central differences of the shapes, extrapolated.
TEST(ChannelShapeDerivatives, EqualFiniteDifferences) {
  auto system = SpringChain{.n = 80}.system();
  SpringChain::add_ground_spring(system, 23, 2.0);
  expect_shape_derivative(system, static_cast<int>(system.parameters.size()) - 1, 7, 0.02, 1e-5);
}

// Oracle: the same, for two chains, one half a thousandth stiffer, tied at their ends: pairs of modes 0.03 % apart that turn
// into each other, so that the derivative is some hundred times the shape and goes into the partner almost wholly.
TEST(ChannelShapeDerivatives, HoldForCloseModes) {
  auto system = SpringChain{.n = 60, .copies = 2}.system();
  system.parameters[3].initial = 1.0005;
  SpringChain::add_tie(system, 59, 0.5);
  SpringChain::add_ground_spring(system, 12, 0.0);
  const EigenModes modes = solve(system, system.initial(), 6);
  ASSERT_LT(modes.frequency_Hz[1] / modes.frequency_Hz[0] - 1.0, 1e-3);
  expect_shape_derivative(system, static_cast<int>(system.parameters.size()) - 1, 6, 4e-5, 1e-4);
}

/// Nelson's method itself, one bordered system a mode,
///   [K - lambda M, M Phi_c; Phi_c' M, 0] [dphi; .] = [-(dK - lambda dM) phi; -1/2 Phi_c' dM phi],
/// by a dense LU; Phi_c are the modes of equal eigenvalue, `copies` of each, or the mode alone.
Eigen::MatrixXd nelson(const ParametricSystem& system, const EigenModes& modes, int parameter, Eigen::Index copies) {
  const Eigen::VectorXd theta = system.initial();
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(system.stiffness(theta)).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd mass = Eigen::MatrixXd(system.mass(theta)).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd dk = system.stiffness_derivative_times(theta, parameter, modes.shapes);
  const Eigen::MatrixXd dm = system.mass_derivative_times(theta, parameter, modes.shapes);
  const Eigen::Index n = mass.rows();
  Eigen::MatrixXd derivative(n, modes.shapes.cols());
  for (Eigen::Index i = 0; i < derivative.cols(); ++i) {
    const Eigen::MatrixXd cluster = modes.shapes.middleCols(i - i % copies, copies);
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + copies, n + copies);
    bordered.topLeftCorner(n, n) = stiffness - modes.eigenvalue[i] * mass;
    bordered.topRightCorner(n, copies) = mass * cluster;
    bordered.bottomLeftCorner(copies, n) = bordered.topRightCorner(n, copies).transpose();
    Eigen::VectorXd right(n + copies);
    right << modes.eigenvalue[i] * dm.col(i) - dk.col(i), -0.5 * cluster.transpose() * dm.col(i);
    derivative.col(i) = bordered.fullPivLu().solve(right).head(n);
  }
  return derivative;
}

// Oracle: Nelson's bordered systems, read at the channels. One channel is a difference of two masses, one stands twice, so that
// the adjoint vectors depend on each other.
TEST(ChannelShapeDerivatives, EqualNelsonsBorderedSystems) {
  auto system = SpringChain{.n = 80}.system();
  SpringChain::add_ground_spring(system, 23, 2.0);
  const Eigen::VectorXd theta = system.initial();
  const EigenModes modes = solve(system, theta, 9);
  Eigen::MatrixXd channels = Eigen::MatrixXd::Zero(system.size(), 5);
  channels(3, 0) = channels(22, 1) = channels(22, 2) = channels(60, 3) = 1.0;
  channels(40, 4) = 1.0, channels(41, 4) = -1.0;
  const std::vector<Eigen::MatrixXd> found = channel_shape_derivatives(system, theta, modes, channels);
  ASSERT_EQ(found.size(), system.parameters.size());
  for (int p = 0; p < std::ssize(found); ++p) {
    const Eigen::MatrixXd whole = channels.transpose() * nelson(system, modes, p, 1);
    EXPECT_LT((found[static_cast<std::size_t>(p)] - whole).cwiseAbs().maxCoeff(), 1e-6 * whole.cwiseAbs().maxCoeff()) << p;
  }
}

// Oracle: the same, for two equal chains whose pairs of modes are exactly repeated: derivatives of the subspace. Those of the
// shapes with the parameters that scale a chain are zero, so that the bound goes by the shapes themselves.
TEST(ChannelShapeDerivatives, HoldForRepeatedModes) {
  auto system = SpringChain{.n = 70, .copies = 2}.system();
  SpringChain::add_ground_spring(system, 23, 0.0);
  const Eigen::VectorXd theta = system.initial();
  const EigenModes modes = solve(system, theta, 6);
  Eigen::MatrixXd channels = Eigen::MatrixXd::Zero(system.size(), 2);
  channels(11, 0) = channels(97, 1) = 1.0;
  const auto found = channel_shape_derivatives(system, theta, modes, channels, 1e-6);
  for (int p = 0; p < std::ssize(found); ++p) {
    const Eigen::MatrixXd whole = channels.transpose() * nelson(system, modes, p, 2);
    const double size = std::max(whole.cwiseAbs().maxCoeff(), 1e-3 * modes.shapes.cwiseAbs().maxCoeff());
    EXPECT_LT((found[static_cast<std::size_t>(p)] - whole).cwiseAbs().maxCoeff(), 1e-6 * size) << p;
  }
}

// Oracle: closed form. With m the shape keeps its form and its norm falls as 1/sqrt(m): dphi = -phi/(2m).
TEST(ChannelShapeDerivatives, FollowTheNormalisation) {
  const SpringChain chain{.n = 90};
  const auto system = chain.system();
  const EigenModes modes = solve(system, system.initial(), 5);
  const Eigen::MatrixXd channels = spread_channels(system);
  const Eigen::MatrixXd derivative = channel_shape_derivatives(system, system.initial(), modes, channels)[1];
  EXPECT_LT((derivative + channels.transpose() * modes.shapes / (2.0 * chain.m)).norm(), 1e-8 * derivative.norm());
}

}  // namespace
