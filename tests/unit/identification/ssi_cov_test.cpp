// Oracle: closed-form modes of a chain of masses, from exact correlations (to rounding); a direct least-squares solve of every
// order.
#include "identification/ssi_cov.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"
#include "core/error.hpp"
#include "modal/mac.hpp"

namespace twindeck::identification {
namespace {

TEST(SsiCov, ExactCorrelationsGiveTheExactPoles) {
  const test::Chain chain(4, 10.0, 0.02, 20.0);
  const Observability o = ssi_cov(chain.exact_correlations(40), 20, 4, 8);
  const auto poles = poles_of_orders(o, {8}, 20.0).front();
  ASSERT_EQ(poles.size(), 4U);
  for (int r = 0; r < 4; ++r) {
    const Pole& pole = poles[static_cast<std::size_t>(r)];
    EXPECT_NEAR(pole.frequency_Hz, chain.frequency_Hz(r), 1e-8);
    EXPECT_NEAR(pole.damping_ratio, 0.02, 1e-8);
    const Eigen::MatrixXcd truth = chain.shape(r).cast<std::complex<double>>();
    EXPECT_NEAR(modal::mac(truth, Eigen::MatrixXcd(pole.shape))(0, 0), 1.0, 1e-12);
  }
}

TEST(SsiCov, ReferencesSeeTheSamePoles) {
  const test::Chain chain(4, 10.0, 0.02, 20.0);
  auto lags = chain.exact_correlations(60);
  for (Eigen::MatrixXd& lag : lags)
    lag = lag.leftCols(1).eval();  // one reference, at the end of the chain: it moves in every mode
  const auto poles = poles_of_orders(ssi_cov(lags, 30, 4, 8), {8}, 20.0).front();
  ASSERT_EQ(poles.size(), 4U);
  for (int r = 0; r < 4; ++r) EXPECT_NEAR(poles[static_cast<std::size_t>(r)].frequency_Hz, chain.frequency_Hz(r), 1e-8);
}

TEST(SsiCov, PolesOfEveryOrderEqualADirectSolve) {
  const test::Chain chain(3, 8.0, 0.01, 20.0);
  const Eigen::MatrixXd data = chain.simulate(4000, 5, 0.1);
  std::vector<Eigen::MatrixXd> lags;
  for (Eigen::Index k = 0; k < 30; ++k)
    lags.emplace_back(data.bottomRows(4000 - k).transpose() * data.topRows(4000 - k) / (4000.0 - static_cast<double>(k)));
  const Observability observability = ssi_cov(lags, 15, 3, 20);
  const Eigen::MatrixXd o = observability.matrix();
  const std::vector<int> orders = {2, 6, 11, 20};
  const auto poles = poles_of_orders(observability, orders, 20.0);
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const Eigen::Index rows = o.rows() - 3, n = orders[k];
    const Eigen::MatrixXd a = o.topLeftCorner(rows, n).colPivHouseholderQr().solve(o.bottomLeftCorner(rows, n));
    const Eigen::VectorXcd mu = a.eigenvalues();
    for (const Pole& pole : poles[k]) {
      const std::complex<double> mine = std::exp(pole.eigenvalue / 20.0);
      EXPECT_LT((mu.array() - mine).abs().minCoeff(), 1e-10);
    }
    EXPECT_EQ(static_cast<Eigen::Index>(poles[k].size()), (mu.array().imag() > 0.0).count());
  }
}

TEST(SsiCov, AnOrderThatTheBlockRowsCannotCarryIsRefused) {
  const test::Chain chain(2, 8.0, 0.01, 20.0);
  EXPECT_THROW(static_cast<void>(ssi_cov(chain.exact_correlations(8), 4, 2, 7)), InputError);
}

}  // namespace
}  // namespace twindeck::identification
