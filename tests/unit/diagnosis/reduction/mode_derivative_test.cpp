// Oracle: central differences of modes that are solved anew, with and without dampers. A shape is compared after it was scaled
// as its derivative is: the part along T'(s) phi stays as it is.
#include "diagnosis/reduction/mode_derivative.hpp"

#include <gtest/gtest.h>

#include "unit/diagnosis/matrix_model.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::Attachment;
using diagnosis::StateModes;
using diagnosis::StructureState;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kHighest_Hz = 100.0;

/// Six unequal masses and springs, so that no two modes are close.
StructureState six_masses() {
  StructureState state;
  state.stiffness = springs_in_a_row((VectorXd(7) << 2.0, 1.7, 2.3, 1.9, 2.6, 1.5, 2.1).finished() * 1e6);
  state.mass = (VectorXd(6) << 900.0, 1100.0, 1000.0, 1250.0, 800.0, 1050.0).finished().asDiagonal();
  return state;
}

struct Change {
  MatrixXd stiffness, mass;
};

/// A spring to the ground, a mass, and both with a coupling between two dofs.
std::vector<Change> changes() {
  std::vector<Change> out(3, {MatrixXd::Zero(6, 6), MatrixXd::Zero(6, 6)});
  out[0].stiffness(2, 2) = 1e5;
  out[1].mass(4, 4) = 50.0;
  out[2].stiffness(1, 1) = out[2].stiffness(3, 3) = 8e4;
  out[2].stiffness(1, 3) = out[2].stiffness(3, 1) = -8e4;
  out[2].mass(0, 0) = 30.0;
  return out;
}

StateModes solved(const StructureState& state) {
  diagnosis::UndampedStore store;
  return diagnosis::solve_state(state, kHighest_Hz, store);
}

/// Derivatives of every mode by each change against differences of 2 h; the relative error of these is of the order of h².
void expect_differences(const StructureState& state) {
  constexpr double h = 1e-3, kTolerance = 2e-5;
  const StateModes modes = solved(state);
  ASSERT_EQ(modes.s.size(), 6);
  const std::vector<Change> by = changes();
  for (Index mode = 0; mode < modes.s.size(); ++mode) {
    const VectorXcd phi = modes.shapes.col(mode);
    const std::complex<double> s = modes.s[mode];
    MatrixXcd force(6, std::ssize(by)), t;
    for (std::size_t j = 0; j < by.size(); ++j)
      force.col(static_cast<Index>(j)) = -(by[j].stiffness.cast<std::complex<double>>() + s * s * by[j].mass) * phi;
    VectorXcd t_prime_phi;
    dynamic_matrices(state, s, phi, t, t_prime_phi);
    const auto derivative = differentiate(state, modes, mode, force);
    for (std::size_t j = 0; j < by.size(); ++j) {
      const auto moved = [&](double step) {
        StructureState other = state;
        other.stiffness += step * by[j].stiffness;
        other.mass += step * by[j].mass;
        const StateModes there = solved(other);
        const VectorXcd shape = there.shapes.col(mode);
        const std::complex<double> scale = (t_prime_phi.transpose() * phi)(0) / (t_prime_phi.transpose() * shape)(0);
        return std::pair<std::complex<double>, VectorXcd>(there.s[mode], scale * shape);
      };
      const auto [s_up, up] = moved(h);
      const auto [s_down, down] = moved(-h);
      const auto k = static_cast<Index>(j);
      EXPECT_LT(std::abs(derivative.s[k] - (s_up - s_down) / (2.0 * h)), kTolerance * std::abs(s)) << mode << " by " << j;
      EXPECT_LT((derivative.shapes.col(k) - (up - down) / (2.0 * h)).norm(), kTolerance * phi.norm()) << mode << " by " << j;
    }
  }
}

TEST(ModeDerivative, OfAnUndampedStateIsThatOfDifferences) { expect_differences(six_masses()); }

TEST(ModeDerivative, WithADashpotIsThatOfDifferences) {
  StructureState state = six_masses();
  state.attachments.push_back({Attachment::Kind::dashpot, VectorXd::Unit(6, 1), 0.0, 4e3, 0.0});
  expect_differences(state);
}

TEST(ModeDerivative, WithASpringInSeriesIsThatOfDifferences) {
  StructureState state = six_masses();
  state.attachments.push_back({Attachment::Kind::maxwell, VectorXd::Unit(6, 4) - VectorXd::Unit(6, 3), 9e5, 6e3, 0.0});
  expect_differences(state);
}

TEST(ModeDerivative, OfOneMassIsTheClosedForm) {
  // omega = sqrt(k/m): d omega/dk = omega / (2 k), d omega/dm = -omega / (2 m); a shape of one dof cannot change.
  StructureState state;
  state.stiffness = MatrixXd::Constant(1, 1, 4e6);
  state.mass = MatrixXd::Constant(1, 1, 1e3);
  const StateModes modes = solved(state);
  const double omega = std::sqrt(4e3);
  ASSERT_EQ(modes.s.size(), 1);
  MatrixXcd force(1, 2);
  force << -modes.shapes(0, 0), -modes.s[0] * modes.s[0] * modes.shapes(0, 0);
  const auto derivative = differentiate(state, modes, 0, force);
  EXPECT_NEAR(derivative.s[0].imag() / (omega / 8e6), 1.0, 1e-12);
  EXPECT_NEAR(derivative.s[1].imag() / (-omega / 2e3), 1.0, 1e-12);
  EXPECT_EQ(derivative.s[0].real(), 0.0);
  EXPECT_LT(derivative.shapes.cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace twindeck::tests
