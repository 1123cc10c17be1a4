// Weighed residuals of frequencies and shapes. Oracles: the definition of the MAC; invariance to scales, phases and rotations
// in a cluster; central differences of the residual itself.
#include "updating/weighted_rows.hpp"

#include <gtest/gtest.h>

#include <random>

#include "modal/mac.hpp"
#include "shaped_chain.hpp"
#include "updating/surrogate.hpp"

namespace twindeck::updating {
namespace {

using Eigen::Index;

Eigen::MatrixXd random_matrix(Index rows, Index columns, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(engine); });
}

/// Two targets: real and imaginary rows with a missing channel, correlated; the second one's shape is spanned by two modes.
struct OddRows {
  static constexpr int channels = 5;
  MeasuredRows rows;
  Eigen::Vector2d frequency{1.1, 2.3};

  explicit OddRows(Index n_dofs) {
    rows.channels = random_matrix(n_dofs, channels, 3);
    for (const int target : {0, 1})
      for (const bool imaginary : {false, true})
        for (int c = 0; c < channels; ++c)
          if (!(target == 1 && c == 2)) rows.shape.push_back({target, c, imaginary, 0.0});
    const Eigen::MatrixXd values = random_matrix(std::ssize(rows.shape), 1, 4);
    for (std::size_t i = 0; i < rows.shape.size(); ++i) rows.shape[i].value = values(static_cast<Index>(i));
    rows.span = {{0}, {2, 1}};
    const Index n = 2 + std::ssize(rows.shape);
    const Eigen::MatrixXd mix = random_matrix(n, n, 5);
    rows.covariance = 1e-4 * (mix * mix.transpose() / static_cast<double>(n) + Eigen::MatrixXd::Identity(n, n));
  }
  [[nodiscard]] WeightedRows weighted() const { return {std::make_shared<const MeasuredRows>(rows), frequency, {true, true}}; }
};

TEST(WeightedRows, ShapeResidualIsOneMinusMac) {
  const Eigen::MatrixXd shape = random_matrix(6, 1, 1), measured = random_matrix(6, 1, 2);
  MeasuredRows rows;
  rows.channels = Eigen::MatrixXd::Identity(6, 6);
  for (int c = 0; c < 6; ++c) rows.shape.push_back({0, c, false, measured(c)});
  rows.span = {{0}};
  rows.covariance = 0.04 * Eigen::MatrixXd::Identity(7, 7);
  const WeightedRows weighted(std::make_shared<const MeasuredRows>(rows), Eigen::VectorXd::Constant(1, 2.0), {true});
  const Linearised at = weighted.evaluate({Eigen::VectorXd::Constant(1, 2.1), shape, {{0}}, {}, {}}, false);
  EXPECT_NEAR(at.residual(0), 0.1 / 0.2, 1e-12);
  const double mac = modal::mac(shape, measured)(0, 0);
  EXPECT_NEAR(at.residual.tail(6).squaredNorm(), (1.0 - mac) * measured.squaredNorm() / 0.04, 1e-10);
  EXPECT_EQ(at.scales, 1);
  EXPECT_NEAR(shape.col(0).dot(at.predicted.tail(6) - measured.col(0)), 0.0, 1e-12);  // least squares
}

TEST(WeightedRows, ScalesPhasesAndRotationsInAClusterAreFree) {
  const OddRows odd(7);
  const WeightedRows weighted = odd.weighted();
  const Eigen::MatrixXd shape = random_matrix(OddRows::channels, 4, 6);
  const std::vector<std::vector<int>> span = {{3}, {0, 1}};
  const Eigen::VectorXd before = weighted.evaluate({odd.frequency, shape, span, {}, {}}, false).residual;
  Eigen::MatrixXd turned = shape;
  turned.col(3) *= -7.3;
  turned.col(0) = 0.6 * shape.col(0) + 0.8 * shape.col(1);
  turned.col(1) = 0.8 * shape.col(0) - 0.6 * shape.col(1);
  EXPECT_LT((weighted.evaluate({odd.frequency, turned, span, {}, {}}, false).residual - before).norm(), 1e-9 * before.norm());
  // A measured shape that is a complex multiple of the computed one leaves nothing.
  OddRows exact(7);
  const std::complex<double> factor(0.4, -1.7);
  for (ShapeRow& row : exact.rows.shape) {
    const std::complex<double> value = factor * shape(row.channel, row.target == 0 ? 3 : 1);
    row.value = row.imaginary ? value.imag() : value.real();
  }
  const Linearised at = exact.weighted().evaluate({exact.frequency, shape, span, {}, {}}, false);
  EXPECT_LT(at.residual.norm(), 1e-10);
  EXPECT_EQ(at.scales, 2 + 4);
}

TEST(WeightedRows, WithoutATargetNothingOfItIsLeft) {
  const OddRows odd(7);
  OddRows changed(7);
  changed.frequency(1) = 9.0;
  for (ShapeRow& row : changed.rows.shape)
    if (row.target == 1) row.value += 1.0;
  const Eigen::MatrixXd shape = random_matrix(OddRows::channels, 4, 6);
  const ComputedRows computed{Eigen::Vector2d(1.0, 2.0), shape, {{3}, {0, 1}}, {}, {}};
  const auto residual = [&](const OddRows& rows) { return rows.weighted().without(1)->evaluate(computed, false).residual; };
  EXPECT_EQ(residual(odd).size(), 1 + 2 * OddRows::channels);
  EXPECT_EQ(residual(odd), residual(changed));
}

/// Residuals of a chain of seven masses with three parameters, and its definition.
struct OddChain {
  std::shared_ptr<const fe::ParametricSystem> system;
  ResidualDefinition definition;

  OddChain() {
    constexpr int n = 7;
    SmallSystem small(n);
    const int a = small.parameter("a", 1.0, 0.5, 2.0), b = small.parameter("b", 2.0, 0.5, 3.0),
              m = small.parameter("m", 1.0, 0.5, 2.0);
    for (int i = 0; i <= n; ++i) small.stiffness((200.0 + 30.0 * i) * spring(n, i < n ? i : -1, i - 1), i < 4 ? a : b);
    Eigen::VectorXd variable = Eigen::VectorXd::Zero(n);
    variable(1) = variable(5) = 0.7;
    small.mass(Eigen::MatrixXd::Identity(n, n)).mass(variable.asDiagonal().toDenseMatrix(), m);
    system = std::make_shared<const fe::ParametricSystem>(small.system());
    OddRows odd(n);
    definition.targets = {{"1", 0, odd.frequency(0)}, {"2", 2, odd.frequency(1)}};
    definition.active = {b, a, m};
    definition.initial = system->initial();
    definition.scale = Eigen::Vector3d(2.0, 1.0, 1.0);
    definition.n_modes = 4;
    dynamics::ModalSolver solver(*system);
    const dynamics::EigenModes modes = solver.solve(definition.initial, definition.n_modes);
    definition.follower = std::make_shared<const matching::ModeFollower>(solver.mass(), modes);
    definition.weighted = std::make_shared<const WeightedRows>(odd.weighted());
  }
};

/// Central differences, extrapolated: the error is of fourth order in the step.
template <class Function>
Eigen::MatrixXd differences(const Function& residual, const Eigen::VectorXd& x) {
  const auto slope = [&](Index j, double h) {
    Eigen::VectorXd up = x, down = x;
    up(j) += h, down(j) -= h;
    return Eigen::VectorXd((residual(up) - residual(down)) / (2.0 * h));
  };
  Eigen::MatrixXd all(residual(x).size(), x.size());
  for (Index j = 0; j < x.size(); ++j) all.col(j) = (4.0 * slope(j, 5e-4) - slope(j, 1e-3)) / 3.0;
  return all;
}

TEST(ModalResiduals, ExactDerivativesOfWeighedShapesEqualDifferences) {
  const OddChain chain;
  ModalResiduals residuals(chain.system, chain.definition);
  const Eigen::Vector3d x(0.9, 1.15, 1.2);
  const Eigen::MatrixXd exact = residuals.at(x, true).jacobian;
  ASSERT_EQ(exact.rows(), chain.definition.n_residuals());
  const Eigen::MatrixXd numerical =
      differences([&](const Eigen::VectorXd& at) { return Eigen::VectorXd(residuals.at(at, false).residual); }, x);
  EXPECT_LT((exact - numerical).cwiseAbs().maxCoeff(), 1e-6 * numerical.cwiseAbs().maxCoeff());
  // Each parameter moves the shapes' rows, not those of the frequencies alone.
  for (Index j = 0; j < 3; ++j) EXPECT_GT(exact.col(j).tail(16).norm(), 0.01 * exact.col(j).norm());
}

TEST(CorrectedResiduals, OnACompleteBasisAreTheFullOnesWithExactDerivatives) {
  const OddChain chain;
  const Eigen::Index n = chain.system->size();
  Surrogate surrogate;
  surrogate.basis = std::make_shared<const Eigen::MatrixXd>(Eigen::MatrixXd::Identity(n, n));
  const ReducedSystem reduced(chain.system, surrogate.basis, nullptr);
  surrogate.mass_reference = chain.definition.follower->mass_reference();
  surrogate.mass = reduced.mass(chain.definition.initial);
  surrogate.channels = chain.definition.weighted->measured().channels;
  ModalResiduals full(chain.system, chain.definition);
  const Evaluation centre = full.at(Eigen::Vector3d::Ones(), true);
  const CorrectedResiduals corrected(reduced, chain.definition, surrogate, centre);
  ASSERT_TRUE(corrected.valid());
  const Eigen::Vector3d x(0.9, 1.15, 1.2);
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  ASSERT_TRUE(corrected(x, residual, &jacobian));
  const Evaluation there = full.at(x, true);
  EXPECT_LT((residual - there.residual).norm(), 1e-6 * there.residual.norm());
  EXPECT_LT((jacobian - there.jacobian).norm(), 1e-6 * there.jacobian.norm());
}

}  // namespace
}  // namespace twindeck::updating
