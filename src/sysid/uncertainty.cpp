#include "sysid/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/error.hpp"

namespace twindeck::sysid {

using Eigen::Index;

namespace {

double median(Eigen::VectorXd values) {
  std::sort(values.begin(), values.end());
  const Index n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

const Pole& nearest(const std::vector<Pole>& candidates, const Pole& reference) {
  TWINDECK_ASSERT(!candidates.empty());
  return *std::min_element(candidates.begin(), candidates.end(), [&](const Pole& p, const Pole& q) {
    return std::abs(p.eigenvalue - reference.eigenvalue) < std::abs(q.eigenvalue - reference.eigenvalue);
  });
}

/// What a replicate says of a mode: frequency, damping, real and imaginary parts of the shape turned towards the reference.
Eigen::VectorXd features(const std::vector<Pole>& mode, const std::vector<int>& orders, const std::vector<std::vector<Pole>>& found) {
  const auto n = static_cast<Index>(mode.size());
  const Eigen::VectorXcd& reference = mode.front().shape;
  Eigen::VectorXd frequency(n), damping(n);
  Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(reference.size());
  for (Index i = 0; i < n; ++i) {
    const Pole& member = mode[static_cast<std::size_t>(i)];
    const auto at = static_cast<std::size_t>(std::lower_bound(orders.begin(), orders.end(), member.order) - orders.begin());
    const Pole& pole = nearest(found[at], member);
    frequency[i] = pole.frequency_Hz;
    damping[i] = pole.damping_ratio;
    shape += pole.shape * std::polar(1.0, std::arg(pole.shape.dot(reference)));
  }
  shape.normalize();
  Eigen::VectorXd x(2 + 2 * shape.size());
  x << median(frequency), median(damping), shape.real(), shape.imag();
  return x;
}

}  // namespace

std::vector<ModeDeviation> jackknife(const signal::BlockCorrelations& blocks, Index block_rows, const Observability& full,
                                     const std::vector<std::vector<Pole>>& modes, double rate_Hz) {
  const Index n_blocks = blocks.n_blocks();
  TWINDECK_ASSERT(n_blocks >= 2);
  if (modes.empty()) return {};
  std::vector<int> orders;
  for (const std::vector<Pole>& mode : modes) {
    for (const Pole& pole : mode) orders.push_back(pole.order);
  }
  std::sort(orders.begin(), orders.end());
  orders.erase(std::unique(orders.begin(), orders.end()), orders.end());

  std::vector<Eigen::MatrixXd> replicates(modes.size(), Eigen::MatrixXd(2 + 2 * full.n_outputs, n_blocks));
  for (Index b = 0; b < n_blocks; ++b) {
    const Observability without = ssi_cov_nearby(blocks.mean(b), block_rows, full);
    const auto found = poles_of_orders(without, orders, rate_Hz);
    for (std::size_t m = 0; m < modes.size(); ++m) replicates[m].col(b) = features(modes[m], orders, found);
  }
  std::vector<ModeDeviation> deviations;
  for (const Eigen::MatrixXd& x : replicates) {
    const Eigen::VectorXd mean = x.rowwise().mean();
    const double factor = static_cast<double>(n_blocks - 1) / static_cast<double>(n_blocks);
    const Eigen::VectorXd deviation = ((x.colwise() - mean).rowwise().squaredNorm() * factor).cwiseSqrt();
    deviations.push_back({deviation[0], deviation[1], deviation.segment(2, full.n_outputs), deviation.tail(full.n_outputs)});
  }
  return deviations;
}

}  // namespace twindeck::sysid
