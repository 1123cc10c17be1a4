#include "identification/merge_preger.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "identification/leading_svd.hpp"
#include "identification/ssi_cov.hpp"
#include "linalg/dense.hpp"

namespace twindeck::identification {

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

/// The rows of a setup whose sensors move, in the units of its references.
struct Moving {
  Eigen::MatrixXd rows;  ///< of the Toeplitz matrix (moving outputs p × columns)
  std::vector<Index> channels;
};

/// All setups with their references brought to one norm.
struct JointSetups {
  Index references, block_rows;
  Eigen::MatrixXd joint;  ///< references' rows, setups side by side
  std::vector<Moving> moving;
  std::vector<Index> row_channel;  ///< of each row of a block of the merged observability matrix

  [[nodiscard]] Index columns() const { return references * block_rows; }
};

JointSetups side_by_side(const std::vector<SetupCorrelations>& setups, Index block_rows) {
  JointSetups all{std::ssize(setups.front().references), block_rows, {}, {}, {}};
  all.joint.resize(all.columns(), all.columns() * std::ssize(setups));
  for (const Index reference : setups.front().references)
    all.row_channel.push_back(setups.front().channels[static_cast<std::size_t>(reference)]);
  for (std::size_t s = 0; s < setups.size(); ++s) {
    const SetupCorrelations& setup = setups[s];
    const Index l = setup.lags.front().rows();
    const Eigen::MatrixXd toeplitz = block_toeplitz(setup.lags, block_rows);
    const Eigen::MatrixXd references = rows_of(toeplitz, l, setup.references);
    const double norm = references.norm();
    all.joint.middleCols(static_cast<Index>(s) * all.columns(), all.columns()) = references / norm;
    Moving moving;
    std::vector<Index> outputs;
    for (Index i = 0; i < l; ++i) {
      if (std::find(setup.references.begin(), setup.references.end(), i) != setup.references.end()) continue;
      outputs.push_back(i);
      moving.channels.push_back(setup.channels[static_cast<std::size_t>(i)]);
    }
    moving.rows = rows_of(toeplitz, l, outputs) / norm;
    all.row_channel.insert(all.row_channel.end(), moving.channels.begin(), moving.channels.end());
    all.moving.push_back(std::move(moving));
  }
  return all;
}

/// Observability of an order with the rows of all setups, block by block; the decomposition's scale is in it.
Observability merged_observability(const JointSetups& all, const LeadingSvd& svd, int order) {
  const Index r = all.references, p = all.block_rows;
  const auto l = static_cast<Index>(all.row_channel.size());
  const Eigen::VectorXd root = svd.values.cwiseSqrt();
  const Eigen::MatrixXd of_references = svd.u * root.asDiagonal();
  Eigen::MatrixXd rows(l * p, order);
  for (Index i = 0; i < p; ++i) rows.block(i * l, 0, r, order) = of_references.block(i * r, 0, r, order);
  Index at = r;
  for (std::size_t s = 0; s < all.moving.size(); ++s) {
    const Moving& moving = all.moving[s];
    const auto n = static_cast<Index>(moving.channels.size());
    if (n == 0) continue;
    const auto of_setup = svd.v.middleRows(static_cast<Index>(s) * all.columns(), all.columns());
    const Eigen::MatrixXd z = root.head(order).asDiagonal() * of_setup.leftCols(order).transpose(), zt = z.transpose();
    Eigen::MatrixXd gram = linalg::product(z, zt);
    gram.diagonal().array() += 1e-10 * gram.trace() / static_cast<double>(order);
    const Eigen::MatrixXd o = gram.llt().solve(linalg::product(moving.rows, zt).transpose()).transpose();
    for (Index i = 0; i < p; ++i) rows.block(i * l + at, 0, n, order) = o.middleRows(i * n, n);
    at += n;
  }
  return {std::move(rows), Eigen::VectorXd::Ones(order), {}, l};
}

}  // namespace

std::vector<std::vector<Pole>> merge_preger(const std::vector<SetupCorrelations>& setups, Index n_channels, Index block_rows,
                                            const std::vector<int>& orders, double rate_Hz) {
  TWINDECK_ASSERT(!setups.empty() && !orders.empty());
  const Index r = static_cast<Index>(setups.front().references.size()), n_max = orders.back();
  if (n_max > (block_rows - 1) * r) {
    throw InputError({"", 0, "maximum_order"},
                     fmt::format("is {}, but {} block rows of {} references carry at most {} when setups are merged before "
                                 "identification",
                                 n_max, block_rows, r, (block_rows - 1) * r),
                     "raise block_rows or lower maximum_order");
  }
  const JointSetups all = side_by_side(setups, block_rows);
  const LeadingSvd svd = leading_svd(all.joint, n_max);
  std::vector<std::vector<Pole>> poles;
  for (const int order : orders) {
    std::vector<Pole> found = poles_of_orders(merged_observability(all, svd, order), {order}, rate_Hz).front();
    for (Pole& pole : found) {
      Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(n_channels);
      for (std::size_t i = 0; i < all.row_channel.size(); ++i) shape[all.row_channel[i]] = pole.shape[static_cast<Index>(i)];
      pole.shape = normalised_shape(shape);
    }
    poles.push_back(std::move(found));
  }
  return poles;
}

}  // namespace twindeck::identification
