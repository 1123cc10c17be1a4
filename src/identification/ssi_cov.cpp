#include "identification/ssi_cov.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"

namespace twindeck::identification {

using Eigen::Index;

Eigen::MatrixXd block_toeplitz(const std::vector<Eigen::MatrixXd>& lags, Index block_rows) {
  TWINDECK_ASSERT(static_cast<Index>(lags.size()) >= 2 * block_rows);
  const Index l = lags.front().rows(), r = lags.front().cols();
  Eigen::MatrixXd toeplitz(l * block_rows, r * block_rows);
  for (Index i = 0; i < block_rows; ++i)
    for (Index j = 0; j < block_rows; ++j)
      toeplitz.block(i * l, j * r, l, r) = lags[static_cast<std::size_t>(block_rows + i - j)];
  return toeplitz;
}

void require_order(Index n_max, Index block_rows, Index n_outputs, Index n_references) {
  const Index most = std::min(n_outputs * (block_rows - 1), n_references * block_rows);
  if (n_max > most)
    throw InputError({"", 0, "maximum_order"},
                     fmt::format("is {}, but {} block rows of {} channels with {} references carry at most {}", n_max,
                                 block_rows, n_outputs, n_references, most),
                     "raise block_rows or lower maximum_order");
}

Observability ssi_cov(const std::vector<Eigen::MatrixXd>& lags, Index block_rows, Index n_outputs, Index n_max) {
  const Eigen::MatrixXd toeplitz = block_toeplitz(lags, block_rows);
  require_order(n_max, block_rows, n_outputs, lags.front().cols());
  LeadingSvd svd = leading_svd(toeplitz, n_max);
  return {std::move(svd.u), std::move(svd.values), std::move(svd.v), n_outputs};
}

}  // namespace twindeck::identification
