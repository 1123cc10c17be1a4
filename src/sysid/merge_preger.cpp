#include "sysid/merge_preger.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>

#include "core/error.hpp"
#include "linalg/dense.hpp"
#include "sysid/leading_svd.hpp"
#include "sysid/merging.hpp"
#include "sysid/ssi_cov.hpp"

namespace twindeck::sysid {

using Eigen::Index;

namespace {

/// Rows of the block matrix (l p × columns) that belong to the given outputs, block by block.
Eigen::MatrixXd rows_of(const Eigen::MatrixXd& block_matrix, Index n_outputs, const std::vector<Index>& outputs) {
  const Index p = block_matrix.rows() / n_outputs, n = static_cast<Index>(outputs.size());
  Eigen::MatrixXd rows(p * n, block_matrix.cols());
  for (Index i = 0; i < p; ++i) {
    for (Index k = 0; k < n; ++k) rows.row(i * n + k) = block_matrix.row(i * n_outputs + outputs[static_cast<std::size_t>(k)]);
  }
  return rows;
}

struct Scaled {
  Eigen::MatrixXd moving, states;        ///< T_moving, V_s' S^(1/2) (filled later)
  std::vector<Index> channels, outputs;  ///< of the moving rows
};

}  // namespace

std::vector<std::vector<Pole>> merge_preger(const std::vector<SetupCorrelations>& setups, Index n_channels, Index block_rows,
                                            const std::vector<int>& orders, double rate_Hz) {
  TWINDECK_ASSERT(!setups.empty() && !orders.empty());
  const Index r = static_cast<Index>(setups.front().references.size()), n_max = orders.back();
  const Index columns = r * block_rows;
  if (n_max > std::min((block_rows - 1) * r, columns)) {
    throw InputError({"", 0, "maximum_order"},
                     fmt::format("is {}, but {} block rows of {} references carry at most {} when setups are merged before "
                                 "identification",
                                 n_max, block_rows, r, (block_rows - 1) * r),
                     "raise block_rows or lower maximum_order");
  }
  Eigen::MatrixXd joint(columns, columns * static_cast<Index>(setups.size()));
  std::vector<Scaled> scaled;
  std::vector<Index> row_channel;  // channel of each row of a block of the merged observability matrix
  for (const Index reference : setups.front().references)
    row_channel.push_back(setups.front().channels[static_cast<std::size_t>(reference)]);
  for (std::size_t s = 0; s < setups.size(); ++s) {
    const SetupCorrelations& setup = setups[s];
    const Index l = setup.lags.front().rows();
    Eigen::MatrixXd toeplitz = block_toeplitz(setup.lags, block_rows);
    const Eigen::MatrixXd references = rows_of(toeplitz, l, setup.references);
    const double norm = references.norm();
    joint.middleCols(static_cast<Index>(s) * columns, columns) = references / norm;
    Scaled one;
    for (Index i = 0; i < l; ++i) {
      if (std::find(setup.references.begin(), setup.references.end(), i) != setup.references.end()) continue;
      one.outputs.push_back(i);
      one.channels.push_back(setup.channels[static_cast<std::size_t>(i)]);
      row_channel.push_back(one.channels.back());
    }
    one.moving = rows_of(toeplitz, l, one.outputs) / norm;
    scaled.push_back(std::move(one));
  }
  const LeadingSvd svd = leading_svd(joint, n_max);
  const Eigen::MatrixXd o_ref = svd.u * svd.values.cwiseSqrt().asDiagonal();
  for (std::size_t s = 0; s < setups.size(); ++s) {
    scaled[s].states =
        svd.values.cwiseSqrt().asDiagonal() * svd.v.middleRows(static_cast<Index>(s) * columns, columns).transpose();
  }

  const auto l_all = static_cast<Index>(row_channel.size());
  std::vector<std::vector<Pole>> poles;
  for (const int order : orders) {
    Eigen::MatrixXd merged(l_all * block_rows, order);
    for (Index i = 0; i < block_rows; ++i) merged.block(i * l_all, 0, r, order) = o_ref.block(i * r, 0, r, order);
    Index at = r;
    for (const Scaled& one : scaled) {
      const Index n = static_cast<Index>(one.outputs.size());
      if (n == 0) continue;
      const Eigen::MatrixXd z = one.states.topRows(order), zt = z.transpose();
      Eigen::MatrixXd gram = linalg::product(z, zt);
      gram.diagonal().array() += 1e-10 * gram.trace() / static_cast<double>(order);
      const Eigen::MatrixXd o = gram.llt().solve(linalg::product(one.moving, zt).transpose()).transpose();
      for (Index i = 0; i < block_rows; ++i) merged.block(i * l_all + at, 0, n, order) = o.middleRows(i * n, n);
      at += n;
    }
    // The decomposition's scale is already in `merged`.
    const Observability observability{merged, Eigen::VectorXd::Ones(order), {}, l_all};
    std::vector<Pole> found = poles_of_orders(observability, {order}, rate_Hz).front();
    for (Pole& pole : found) {
      Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(n_channels);
      for (Index i = 0; i < l_all; ++i) shape[row_channel[static_cast<std::size_t>(i)]] = pole.shape[i];
      pole.shape = normalised_shape(shape);
    }
    poles.push_back(std::move(found));
  }
  return poles;
}

}  // namespace twindeck::sysid
