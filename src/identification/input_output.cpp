#include "identification/input_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/statistics.hpp"
#include "identification/ssi_data.hpp"
#include "identification/state_space.hpp"
#include "linalg/dense.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

struct Sizes {
  Index inputs, outputs, block_rows;
  [[nodiscard]] Index all() const { return inputs + outputs; }
};

/// Rows of the Gram matrix in the order of the decomposition: future inputs, past of both, future outputs.
std::vector<Index> ordering(const Sizes& size) {
  std::vector<Index> order;
  const Index past = size.all() * size.block_rows;
  for (Index i = 0; i < size.block_rows; ++i)
    for (Index c = 0; c < size.inputs; ++c) order.push_back(past + i * size.all() + c);
  for (Index k = 0; k < past; ++k) order.push_back(k);
  for (Index i = 0; i < size.block_rows; ++i)
    for (Index c = size.inputs; c < size.all(); ++c) order.push_back(past + i * size.all() + c);
  return order;
}

Observability observability_of(const Eigen::MatrixXd& lower_gram, const Sizes& size, Index n_max) {
  Eigen::MatrixXd gram = lower_gram.selfadjointView<Eigen::Lower>();
  const std::vector<Index> order = ordering(size);
  gram = Eigen::MatrixXd(gram(order, order));
  // The diagonal scales channels of different size; the scale goes back into L.
  const Eigen::VectorXd scale = gram.diagonal().cwiseSqrt();
  if (!(scale.minCoeff() > 0.0))
    throw InputError({"", 0, "role"}, "one of the inputs or outputs is zero throughout", "leave that channel out");
  gram = scale.cwiseInverse().asDiagonal() * gram * scale.cwiseInverse().asDiagonal();
  gram.diagonal().array() += 1e-10;
  const Eigen::MatrixXd l = linalg::cholesky_factor(gram);
  TWINDECK_ASSERT(l.size() > 0);
  const Index first = size.inputs * size.block_rows, past = size.all() * size.block_rows,
              future = size.outputs * size.block_rows;
  const Eigen::MatrixXd l32 = scale.tail(future).asDiagonal() * l.block(first + past, first, future, past);
  const LeadingSvd svd = leading_svd(l32, n_max);
  return {svd.u, svd.values, svd.v, size.outputs};
}

const Pole* nearest(const std::vector<Pole>& candidates, const Pole& reference) {
  const auto at = std::ranges::min_element(candidates, [&](const Pole& p, const Pole& q) {
    return std::abs(p.eigenvalue - reference.eigenvalue) < std::abs(q.eigenvalue - reference.eigenvalue);
  });
  return at == candidates.end() ? nullptr : &*at;
}

/// A replicate of a mode: medians of its members' values, mean shape.
Eigen::VectorXd replicate(const std::vector<Pole>& members, const std::vector<int>& orders,
                          const std::vector<std::vector<Pole>>& found) {
  std::vector<double> frequency, damping;
  Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(members.front().shape.size());
  for (const Pole& member : members) {
    const auto at = static_cast<std::size_t>(std::lower_bound(orders.begin(), orders.end(), member.order) - orders.begin());
    const Pole* pole = nearest(found[at], member);
    if (pole == nullptr) continue;
    frequency.push_back(pole->frequency_Hz);
    damping.push_back(pole->damping_ratio);
    shape += pole->shape * std::polar(1.0, std::arg(pole->shape.dot(members.front().shape)));
  }
  TWINDECK_ASSERT(!frequency.empty());
  shape.normalize();
  Eigen::VectorXd x(2 + 2 * shape.size());
  x << median(frequency), median(damping), shape.real(), shape.imag();
  return x;
}

/// @throws InputError  if the record is too short for the block rows, or these too few for the orders
void check_size(const Sizes& size, Index samples, int n_blocks, long maximum_order) {
  // n samples have n - 2p + 1 columns: twice as many as the rows 2p of all channels, and more than 2p in each block.
  const Index carried = std::min((samples + 1) / (4 * size.all() + 2), (samples + 1 - n_blocks) / (2 * n_blocks + 2));
  if (size.block_rows > carried)
    throw InputError({"", 0, "block_rows"},
                     fmt::format("is {}, but a record of {} samples with {} inputs and {} outputs carries at most {}",
                                 size.block_rows, samples, size.inputs, size.outputs, std::max<Index>(carried, 0)),
                     "ask for fewer block rows, or give a longer record");
  if (maximum_order > (size.block_rows - 1) * size.outputs)
    throw InputError({"", 0, "maximum_order"},
                     fmt::format("is {}, but {} block rows of {} outputs carry at most {}", maximum_order, size.block_rows,
                                 size.outputs, (size.block_rows - 1) * size.outputs),
                     "raise block_rows or lower maximum_order");
}

/// Gram matrices of the data in consecutive blocks of columns. Their sum is that of the record.
std::vector<Eigen::MatrixXd> grams_of_blocks(const Eigen::MatrixXd& data, const Sizes& size, int n_blocks) {
  const Index columns = data.rows() - 2 * size.block_rows + 1;
  std::vector<Index> everything(static_cast<std::size_t>(size.all()));
  std::iota(everything.begin(), everything.end(), Index{0});
  std::vector<Eigen::MatrixXd> grams;
  for (int b = 0; b < n_blocks; ++b) {
    const Index begin = columns * b / n_blocks, end = columns * (b + 1) / n_blocks;
    grams.push_back(hankel_gram(data.middleRows(begin, end - begin + 2 * size.block_rows - 1), everything, size.block_rows));
  }
  return grams;
}

/// Deviations of a mode by the jackknife. @param x  (2 + 2 outputs × blocks) replicates, each without one block
ModeDeviation deviation_of(const Eigen::MatrixXd& x) {
  const auto n_blocks = static_cast<double>(x.cols());
  const double factor = std::sqrt((n_blocks - 1.0) / n_blocks);
  return deviation_of_factor((x.colwise() - x.rowwise().mean()) * factor);
}

}  // namespace

Identification identify_input_output(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs, double rate_Hz,
                                     const IdentifyOptions& options, int n_blocks) {
  TWINDECK_ASSERT(inputs.rows() == outputs.rows() && inputs.cols() > 0 && outputs.cols() > 0 && n_blocks >= 2);
  const Sizes size{inputs.cols(), outputs.cols(), options.block_rows};
  const std::vector<int> orders = options.orders();
  check_size(size, inputs.rows(), n_blocks, orders.back());
  Eigen::MatrixXd data(inputs.rows(), size.all());
  data << inputs, outputs;
  const std::vector<Eigen::MatrixXd> grams = grams_of_blocks(data, size, n_blocks);
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(grams[0].rows(), grams[0].cols());
  for (const Eigen::MatrixXd& gram : grams) total += gram;

  Identification result =
      modes_of_poles(poles_of_orders(observability_of(total, size, orders.back()), orders, rate_Hz), orders, options);
  if (result.modes.empty()) return result;

  std::vector<Eigen::MatrixXd> replicates(result.modes.size(), Eigen::MatrixXd(2 + 2 * size.outputs, n_blocks));
  for (int b = 0; b < n_blocks; ++b) {
    const auto found =
        poles_of_orders(observability_of(total - grams[static_cast<std::size_t>(b)], size, orders.back()), orders, rate_Hz);
    for (std::size_t m = 0; m < result.modes.size(); ++m) {
      std::vector<Pole> members;
      for (const std::size_t i : result.modes[m].members) members.push_back(result.diagram[i].pole);
      replicates[m].col(b) = replicate(members, orders, found);
    }
  }
  for (const Eigen::MatrixXd& x : replicates) result.deviations.push_back(deviation_of(x));
  drop_undetermined(result, options, static_cast<double>(inputs.rows()) / rate_Hz);
  return result;
}

}  // namespace twindeck::identification
