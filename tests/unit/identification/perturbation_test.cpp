// Oracle: central differences of the whole computation (decomposition, shift equation, eigenvalues, normalised shapes).
#include "identification/perturbation.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"
#include "identification/ssi_cov.hpp"
#include "identification/state_space.hpp"

namespace twindeck::identification {
namespace {

Observability of(const Eigen::MatrixXd& h, Eigen::Index n_outputs, Eigen::Index n) {
  const LeadingSvd svd = leading_svd(h, n);
  return {svd.u, svd.values, svd.v, n_outputs};
}

Eigen::MatrixXd noisy_toeplitz(std::uint64_t seed, int references) {
  const test::Chain chain(3, 8.0, 0.01, 20.0);
  auto lags = chain.exact_correlations(24);
  test::Noise noise(seed);
  const double size = lags.front().cwiseAbs().maxCoeff();
  for (Eigen::MatrixXd& lag : lags) {
    lag = lag.leftCols(references).eval();
    for (double& x : lag.reshaped()) x += 0.01 * size * noise();
  }
  return block_toeplitz(lags, 12);
}

TEST(Perturbation, ChangesOfEveryPoleEqualCentralDifferences) {
  // One reference: the twelve columns are all kept, so that the first-order formula is exact at every order.
  const Eigen::MatrixXd h = noisy_toeplitz(3, 1), d = noisy_toeplitz(4, 1) - noisy_toeplitz(5, 1);
  const std::vector<int> orders = {6, 8, 12};
  const Observability o = of(h, 3, 12);
  const ShiftModels models = shift_models(o, orders, 20.0);
  const SubspaceChange change = subspace_change(o, models, d * o.right);
  const double step = 1e-6;
  const auto plus = poles_of_orders(of(h + step * d, 3, 12), orders, 20.0),
             minus = poles_of_orders(of(h - step * d, 3, 12), orders, 20.0);
  int compared = 0;
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const auto changes = pole_changes(o, models, k, change);
    ASSERT_EQ(changes.size(), plus[k].size());
    for (std::size_t i = 0; i < changes.size(); ++i, ++compared) {
      const double df = (plus[k][i].frequency_Hz - minus[k][i].frequency_Hz) / (2.0 * step);
      const double dz = (plus[k][i].damping_ratio - minus[k][i].damping_ratio) / (2.0 * step);
      const Eigen::VectorXcd ds = (plus[k][i].shape - minus[k][i].shape) / (2.0 * step);
      EXPECT_NEAR(changes[i].frequency_Hz, df, 1e-5 * (1.0 + std::abs(df))) << orders[k] << " " << i;
      EXPECT_NEAR(changes[i].damping_ratio, dz, 1e-5 * (1.0 + std::abs(dz)));
      EXPECT_LT((changes[i].shape - ds).norm(), 1e-5 * (1.0 + ds.norm()));
    }
  }
  EXPECT_GE(compared, 9);
}

TEST(LeadingSvd, SquaresGiveTheTripletsOfTheDirectDecomposition) {
  // Oracle: A v = sigma u, A' u = sigma v, and the values of Eigen's full decomposition; wide and tall.
  test::Noise noise(6);
  Eigen::MatrixXd a(500, 420);
  for (double& x : a.reshaped()) x = noise();
  for (int j = 0; j < 12; ++j) {
    Eigen::VectorXd left(500), right(420);
    for (double& x : left) x = noise();
    for (double& x : right) x = noise();
    a += 5.0 / (j + 1) * left * right.transpose();
  }
  for (const Eigen::MatrixXd& m : {a, Eigen::MatrixXd(a.transpose())}) {
    const LeadingSvd svd = leading_svd(m, 30);
    const Eigen::VectorXd direct = Eigen::JacobiSVD<Eigen::MatrixXd>(m).singularValues().head(30);
    EXPECT_LT((svd.values - direct).norm(), 1e-12 * direct[0]);
    EXPECT_LT((m * svd.v - svd.u * svd.values.asDiagonal()).norm(), 1e-10 * direct[0]);
    EXPECT_LT((m.transpose() * svd.u - svd.v * svd.values.asDiagonal()).norm(), 1e-9 * direct[0]);
  }
}

}  // namespace
}  // namespace twindeck::identification
