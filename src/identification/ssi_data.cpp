#include "identification/ssi_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "identification/ssi_cov.hpp"
#include "linalg/dense.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

/// sum over t < n of x_{t+k} y_t' for k = 0 … n_lags - 1, x and y of the first n + n_lags - 1 and n samples.
std::vector<Eigen::MatrixXd> lagged_products(const Eigen::Ref<const Eigen::MatrixXd>& x,
                                             const Eigen::Ref<const Eigen::MatrixXd>& y, Index n, Index n_lags) {
  std::vector<Eigen::MatrixXd> products(static_cast<std::size_t>(n_lags), Eigen::MatrixXd::Zero(x.cols(), y.cols()));
  // Pieces stay in the cache. Each product multiplies the lagged samples of one piece.
  const Index piece = std::max<Index>(512, n_lags);
  for (Index at = 0; at < n; at += piece) {
    const Index length = std::min(piece, n - at);
    const Eigen::MatrixXd rows = y.middleRows(at, length);
    const Eigen::MatrixXd window = x.middleRows(at, length + n_lags - 1);
    for (Index k = 0; k < n_lags; ++k)
      products[static_cast<std::size_t>(k)] += linalg::product(window.middleRows(k, length), rows, true);
  }
  return products;
}

/// Rows or columns of the Gram matrix: where they begin, what they are made of, and the sample of the first.
struct Side {
  Index at;
  Eigen::Ref<const Eigen::MatrixXd> data;
  Index sample;
};

void set_first_column(Eigen::MatrixXd& gram, Index row, Index column, const std::vector<Eigen::MatrixXd>& lags,
                      Index first_lag) {
  for (std::size_t k = static_cast<std::size_t>(first_lag), i = 0; k < lags.size(); ++k, ++i)
    gram.block(row + static_cast<Index>(i) * lags[k].rows(), column, lags[k].rows(), lags[k].cols()) = lags[k];
}

/// G_{i,j} = G_{i-1,j-1} + x_{i-1+n} y_{j-1+n}' - x_{i-1} y_{j-1}' for i, j >= 1; the lower half only if the part is symmetric.
void continue_diagonals(Eigen::MatrixXd& gram, const Side& x, const Side& y, Index p, Index n, bool symmetric) {
  const Index l = x.data.cols(), r = y.data.cols();
  for (Index j = 1; j < p; ++j) {
    for (Index i = symmetric ? j : 1; i < p; ++i) {
      const Index a = x.sample + i - 1, b = y.sample + j - 1;
      gram.block(x.at + i * l, y.at + j * r, l, r) = gram.block(x.at + (i - 1) * l, y.at + (j - 1) * r, l, r) +
                                                     x.data.row(a + n).transpose() * y.data.row(b + n) -
                                                     x.data.row(a).transpose() * y.data.row(b);
    }
  }
}

}  // namespace

Eigen::MatrixXd hankel_gram(const Eigen::Ref<const Eigen::MatrixXd>& data, const std::vector<Index>& references,
                            Index block_rows) {
  const Index p = block_rows, n = data.rows() - 2 * p + 1, l = data.cols(), r = static_cast<Index>(references.size());
  if (data.rows() < 4 * p)
    throw InputError({"", 0, "block_rows"},
                     fmt::format("is {}, but the record has {} samples, expected at least {}", p, data.rows(), 4 * p),
                     "ask for fewer block rows, or give a longer record");
  const Eigen::MatrixXd refs = data(Eigen::all, references);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero((r + l) * p, (r + l) * p);
  const Index future = r * p;

  // Past with past and future with future: lags 0 … p - 1 in the first column, then down the diagonals.
  set_first_column(gram, 0, 0, lagged_products(refs, refs, n, p), 0);
  continue_diagonals(gram, {0, refs, 0}, {0, refs, 0}, p, n, true);
  const Eigen::Ref<const Eigen::MatrixXd> later = data.bottomRows(data.rows() - p);
  set_first_column(gram, future, future, lagged_products(later, later, n, p), 0);
  continue_diagonals(gram, {future, later, 0}, {future, later, 0}, p, n, true);

  // Future with past: lags p … 2p - 1 in the first column, p - 1 … 1 in the first row; there the sum over t of y_{t+p} r_{t+j}'
  // is that of y_{t+p-j} r_t' with its ends exchanged.
  const auto lags = lagged_products(data, refs, n, 2 * p);
  set_first_column(gram, future, 0, lags, p);
  for (Index j = 1; j < p; ++j) {
    Eigen::MatrixXd block = lags[static_cast<std::size_t>(p - j)];
    block += data.middleRows(n + p - j, j).transpose() * refs.middleRows(n, j) -
             data.middleRows(p - j, j).transpose() * refs.topRows(j);
    gram.block(future, j * r, l, r) = block;
  }
  continue_diagonals(gram, {future, data, p}, {0, refs, 0}, p, n, false);
  return gram;
}

DataDriven ssi_data(const std::vector<Eigen::MatrixXd>& grams, double samples, Index n_references, Index n_outputs,
                    Index block_rows, Index n_max) {
  TWINDECK_ASSERT(!grams.empty());
  Eigen::MatrixXd gram = grams.front();
  for (std::size_t i = 1; i < grams.size(); ++i) gram += grams[i];
  gram /= samples;
  const Index past = n_references * block_rows, future = n_outputs * block_rows;
  require_order(n_max, block_rows, n_outputs, n_references);
  DataDriven found;
  found.samples = samples;
  // The anti-aliasing filter leaves the past nearly singular. Adding 1e-12 of its mean power keeps the factor real.
  const double floor = 1e-12 * gram.topLeftCorner(past, past).trace() / static_cast<double>(past);
  gram.diagonal().head(past).array() += floor;
  found.past_factor = linalg::cholesky_factor(gram.topLeftCorner(past, past));
  if (found.past_factor.size() == 0)
    throw InputError({"", 0, "references"}, "are linearly dependent: one repeats others",
                     "leave that channel out, or take fewer references");
  const Eigen::MatrixXd cross = gram.bottomLeftCorner(future, past);
  found.projection = found.past_factor.triangularView<Eigen::Lower>().solve(cross.transpose()).transpose();
  LeadingSvd svd = leading_svd(found.projection, n_max);
  found.observability = {std::move(svd.u), std::move(svd.values), std::move(svd.v), n_outputs};
  return found;
}

Changes data_changes(const signal::BlockCorrelations& blocks, const std::vector<Index>& references, Index block_rows,
                     const DataDriven& found, const ShiftModels& models) {
  const Index p = block_rows, r = static_cast<Index>(references.size());
  const std::vector<Eigen::MatrixXd> mean = blocks.mean();
  const Eigen::MatrixXd right = found.observability.right.leftCols(models.r.cols());
  const Eigen::MatrixXd solved = found.past_factor.transpose().triangularView<Eigen::Upper>().solve(right);  // L11^-T V
  Changes changes;
  for (Index b = 0; b < blocks.n_blocks(); ++b) {
    const auto lags = lag_change(blocks, mean, b);
    Eigen::MatrixXd cross(blocks.n_outputs * p, r * p), past(r * p, r * p);
    for (Index j = 0; j < p; ++j) {
      for (Index i = 0; i < p; ++i) {
        cross.block(i * blocks.n_outputs, j * r, blocks.n_outputs, r) = lags[static_cast<std::size_t>(p + i - j)];
        const Eigen::MatrixXd lag = lags[static_cast<std::size_t>(std::abs(i - j))](references, Eigen::all);
        past.block(i * r, j * r, r, r) = i >= j ? lag : Eigen::MatrixXd(lag.transpose());
      }
    }
    const Eigen::MatrixXd inner = found.past_factor.triangularView<Eigen::Lower>().solve(linalg::product(past, solved));
    const Eigen::MatrixXd w = linalg::product(cross, solved) - 0.5 * linalg::product(found.projection, inner);
    changes.push_back(subspace_change(found.observability, models, w));
  }
  return changes;
}

}  // namespace twindeck::identification
