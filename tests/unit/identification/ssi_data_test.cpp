// Oracles: the Hankel matrix written out, an orthogonal (Householder) LQ decomposition of it, closed-form modes, the spread
// over seeds.
#include "identification/ssi_data.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "calibration.hpp"
#include "core/error.hpp"
#include "identification/identify.hpp"
#include "identification/state_space.hpp"
#include "signal/condition.hpp"

namespace twindeck::identification {
namespace {

Eigen::MatrixXd hankel(const Eigen::MatrixXd& data, const std::vector<Eigen::Index>& references, Eigen::Index p) {
  const Eigen::Index n = data.rows() - 2 * p + 1, r = static_cast<Eigen::Index>(references.size()), l = data.cols();
  Eigen::MatrixXd h((r + l) * p, n);
  for (Eigen::Index t = 0; t < n; ++t) {
    for (Eigen::Index i = 0; i < p; ++i) {
      h.block(i * r, t, r, 1) = data(t + i, references).transpose();
      h.block(r * p + i * l, t, l, 1) = data.row(t + p + i).transpose();
    }
  }
  return h;
}

TEST(SsiData, GramMatrixIsThatOfTheHankelMatrix) {
  const Eigen::MatrixXd data = test::Chain(3, 8.0, 0.02, 20.0).simulate(300, 3, 0.2);
  const std::vector<Eigen::Index> references = {2, 0};
  const Eigen::MatrixXd h = hankel(data, references, 7);
  const Eigen::MatrixXd expected = h * h.transpose(), gram = hankel_gram(data, references, 7);
  const auto lower = [](const Eigen::MatrixXd& m) { return Eigen::MatrixXd(m.triangularView<Eigen::Lower>()); };
  EXPECT_LT((lower(gram) - lower(expected)).cwiseAbs().maxCoeff(), 1e-10 * expected.cwiseAbs().maxCoeff());
}

TEST(SsiData, PolesEqualThoseOfAnOrthogonalDecomposition) {
  const double rate = 20.0;
  const Eigen::MatrixXd data = test::Chain(3, 8.0, 0.01, rate).simulate(3000, 4, 0.1);
  const std::vector<Eigen::Index> references = {0, 1};
  const Eigen::Index p = 10, n = data.rows() - 2 * p + 1;
  const Eigen::MatrixXd ht = hankel(data, references, p).transpose();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(ht);
  const Eigen::MatrixXd l = qr.matrixQR().topRows(ht.cols()).triangularView<Eigen::Upper>().transpose();
  const LeadingSvd svd = leading_svd(l.bottomLeftCorner(3 * p, 2 * p), 12);
  const std::vector<int> orders = {6, 12};
  const auto direct = poles_of_orders({svd.u, svd.values, svd.v, 3}, orders, rate);
  const DataDriven found = ssi_data({hankel_gram(data, references, p)}, static_cast<double>(n), 2, 3, p, 12);
  const auto poles = poles_of_orders(found.observability, orders, rate);
  for (std::size_t k = 0; k < orders.size(); ++k) {
    ASSERT_EQ(poles[k].size(), direct[k].size());
    for (std::size_t i = 0; i < poles[k].size(); ++i)
      EXPECT_NEAR(std::abs(poles[k][i].eigenvalue - direct[k][i].eigenvalue), 0.0, 1e-7);
  }
}

TEST(SsiData, IdentifiesTheChainWithCalibratedDeviations) {
  // Pooled normalised errors of 12 seeds and three modes: 36 values scatter by 12 %, their deviation by 1.06 more (20 blocks).
  const double rate = 20.0, zeta = 0.01;
  const test::Chain chain(3, 20.0, zeta, rate);
  const std::vector<Eigen::Index> references = {0, 1, 2};
  IdentifyOptions options;
  options.block_rows = 20;
  options.maximum_order = 30;
  test::NormalisedErrors errors;
  for (std::uint64_t seed = 300; seed < 312; ++seed) {
    const Eigen::MatrixXd data = signal::detrended(chain.simulate(30000, seed, 0.05));
    const Identification found =
        identify_from_data({data}, references, signal::correlations(data, references, 40, 20), rate, options);
    ASSERT_EQ(found.modes.size(), 3U) << "seed " << seed;
    errors.add(found, chain, zeta);
  }
  errors.expect_between(0.7, 1.4);
}

TEST(SsiData, ShortRecordIsRefused) {
  EXPECT_THROW(static_cast<void>(hankel_gram(Eigen::MatrixXd::Zero(30, 2), {0}, 10)), InputError);
}

}  // namespace
}  // namespace twindeck::identification
