#include "identification/era.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/random.hpp"
#include "linalg/dense.hpp"
#include "signal/surrogate_noise.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

Index columns_of(const std::vector<Eigen::MatrixXd>& decays, Index block_rows, Index block_columns) {
  return std::min(block_columns, decays.front().rows() - block_rows + 1);
}

Eigen::MatrixXd white(Index samples, Index channels, double deviation, std::uint64_t seed, std::uint64_t draw) {
  Eigen::MatrixXd noise(samples, channels);
  std::uint64_t at = 0;
  for (double& value : noise.reshaped()) value = deviation * normal_number(seed, draw, at++);
  return noise;
}

/// Block Hankel matrix of free responses  H = [ Y_0 … Y_{q-1} ; Y_1 … Y_q ; … ],  Y_k the outputs (n_outputs × n_decays) at
/// sample k.
/// @param decays  free responses (n_samples × n_outputs) that start at the release, all of one length
/// @param block_rows  p; the columns use the remaining samples, at most `block_columns`
Eigen::MatrixXd block_hankel(const std::vector<Eigen::MatrixXd>& decays, Index block_rows, Index block_columns) {
  TWINDECK_ASSERT(!decays.empty());
  const Index l = decays.front().cols(), n = static_cast<Index>(decays.size()),
              q = columns_of(decays, block_rows, block_columns);
  Eigen::MatrixXd hankel(l * block_rows, n * q);
  for (Index d = 0; d < n; ++d) {
    const Eigen::MatrixXd& y = decays[static_cast<std::size_t>(d)];
    TWINDECK_ASSERT(y.cols() == l && y.rows() >= block_rows + q - 1);
    for (Index j = 0; j < q; ++j)
      for (Index i = 0; i < block_rows; ++i) hankel.block(i * l, j * n + d, l, 1) = y.row(i + j).transpose();
  }
  return hankel;
}

}  // namespace

FreeDecay era(const std::vector<Eigen::MatrixXd>& decays, Index block_rows, const std::vector<int>& orders, double rate_Hz,
              std::uint64_t seed, int n_draws, const std::vector<Eigen::MatrixXd>& quiet) {
  TWINDECK_ASSERT(!decays.empty() && !orders.empty());
  for (const Eigen::MatrixXd& record : quiet)
    TWINDECK_ASSERT(record.rows() >= decays.front().rows() && record.cols() == decays.front().cols());
  const Index l = decays.front().cols(), samples = decays.front().rows(), n_max = orders.back();
  const Index q = columns_of(decays, block_rows, samples);
  const Index most = samples < 2 * block_rows ? 0 : std::min((block_rows - 1) * l, q * static_cast<Index>(decays.size()));
  if (n_max > most)
    throw InputError({"", 0, "maximum_order"},
                     fmt::format("is {}, but free decays of {} samples with {} block rows carry at most {}", n_max, samples,
                                 block_rows, most),
                     "give longer decays, fewer block rows, or a lower order");
  const Eigen::MatrixXd hankel = block_hankel(decays, block_rows, q);
  LeadingSvd svd = leading_svd(hankel, n_max);
  FreeDecay found;
  found.observability = {std::move(svd.u), std::move(svd.values), std::move(svd.v), l};
  found.models = shift_models(found.observability, orders, rate_Hz);
  const double left = std::max(0.0, hankel.squaredNorm() - found.observability.singular_values.squaredNorm());
  const double entries = static_cast<double>(hankel.rows() - n_max) * static_cast<double>(hankel.cols() - n_max);
  found.noise = entries > 0.0 ? std::sqrt(left / entries) : 0.0;

  std::uint64_t drawn = 0;
  const double share = 1.0 / std::sqrt(static_cast<double>(n_draws));
  for (int draw = 0; draw < n_draws; ++draw) {
    std::vector<Eigen::MatrixXd> disturbance;
    for (std::size_t d = 0; d < decays.size(); ++d) {
      disturbance.push_back(
          share * (quiet.empty()
                       ? white(samples, l, found.noise, seed, drawn)
                       : Eigen::MatrixXd(signal::surrogate_noise(quiet[drawn % quiet.size()], seed, drawn).topRows(samples))));
      ++drawn;
    }
    const Eigen::MatrixXd change = block_hankel(disturbance, block_rows, q);
    found.changes.push_back(
        subspace_change(found.observability, found.models, linalg::product(change, found.observability.right)));
  }
  return found;
}

}  // namespace twindeck::identification
