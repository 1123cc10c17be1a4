#include "identification/merge_preger.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "identification/ssi_cov.hpp"
#include "identification/state_space.hpp"
#include "linalg/dense.hpp"
#include "matching/pairing.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

/// Rows of a block matrix (l p × columns) that belong to the given outputs, block by block.
Eigen::MatrixXd rows_of(const Eigen::MatrixXd& block_matrix, Index n_outputs, const std::vector<Index>& outputs) {
  const Index p = block_matrix.rows() / n_outputs, n = static_cast<Index>(outputs.size());
  Eigen::MatrixXd rows(p * n, block_matrix.cols());
  for (Index i = 0; i < p; ++i)
    for (Index k = 0; k < n; ++k) rows.row(i * n + k) = block_matrix.row(i * n_outputs + outputs[static_cast<std::size_t>(k)]);
  return rows;
}

/// Rows of the moving sensors of a setup, in the units of its references.
struct Moving {
  Eigen::MatrixXd rows;  ///< of the Toeplitz matrix (moving outputs p × columns)
  std::vector<Index> channels;
};

/// All setups, with their references scaled to one norm.
struct JointSetups {
  Index references, block_rows;
  Eigen::MatrixXd joint;  ///< rows of the references, setups side by side
  std::vector<Moving> moving;
  std::vector<Index> row_channel;  ///< channel of each row in a block of the merged observability matrix

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
      if (contains(setup.references, i)) continue;
      outputs.push_back(i);
      moving.channels.push_back(setup.channels[static_cast<std::size_t>(i)]);
    }
    moving.rows = rows_of(toeplitz, l, outputs) / norm;
    all.row_channel.insert(all.row_channel.end(), moving.channels.begin(), moving.channels.end());
    all.moving.push_back(std::move(moving));
  }
  return all;
}

/// Observability matrix of one order with the rows of all setups, block by block, including the scale of the decomposition.
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

constexpr double kSameMode = 0.02;        ///< [-] of the frequency; two mergings of the same records differ by far less
constexpr double kSamePole = 0.005;       ///< [-] of the frequency; for poles of single orders that were not selected
constexpr std::size_t kFewestOrders = 3;  ///< [-] a pole found at fewer orders does not count

void set(MergingCheck& check, double frequency_Hz, double damping_ratio, const Eigen::VectorXcd& shape) {
  check.found = true;
  check.frequency_Hz = frequency_Hz;
  check.damping_ratio = damping_ratio;
  check.shape = shape;
}

/// Uses the poles near the mode's frequency if PreGER's own selection lacks the mode.
void set_nearest_poles(MergingCheck& check, const Identification& preger, const MergedMode& mode) {
  std::map<int, const Pole*> nearest;
  const auto off = [&](const Pole& pole) { return std::abs(pole.frequency_Hz - mode.frequency_Hz); };
  for (const DiagramPole& p : preger.diagram) {
    if (off(p.pole) > kSamePole * mode.frequency_Hz) continue;
    const auto [at, is_new] = nearest.try_emplace(p.pole.order, &p.pole);
    if (!is_new && off(p.pole) < off(*at->second)) at->second = &p.pole;
  }
  if (nearest.size() < kFewestOrders) return;
  std::vector<double> frequencies, dampings;
  const Pole* reference = nearest.rbegin()->second;
  Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(reference->shape.size());
  for (const auto& [order, pole] : nearest) {
    frequencies.push_back(pole->frequency_Hz);
    dampings.push_back(pole->damping_ratio);
    shape += pole->shape * std::polar(1.0, std::arg(pole->shape.dot(reference->shape)));
  }
  std::ranges::sort(frequencies);
  std::ranges::sort(dampings);
  set(check, frequencies[frequencies.size() / 2], dampings[dampings.size() / 2], shape);
}

}  // namespace

std::vector<std::vector<Pole>> merge_preger(const std::vector<SetupCorrelations>& setups, Index n_channels, Index block_rows,
                                            const std::vector<int>& orders, double rate_Hz) {
  TWINDECK_ASSERT(!setups.empty() && !orders.empty());
  const Index r = static_cast<Index>(setups.front().references.size()), n_max = orders.back();
  if (n_max > (block_rows - 1) * r)
    throw InputError({"", 0, "maximum_order"},
                     fmt::format("is {}, but {} block rows of {} references carry at most {} when setups are merged before "
                                 "identification",
                                 n_max, block_rows, r, (block_rows - 1) * r),
                     "raise block_rows or lower maximum_order");
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

double known_mac(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  std::complex<double> product = 0.0;
  double aa = 0.0, bb = 0.0;
  for (Index i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i].real()) || std::isnan(b[i].real())) continue;
    product += std::conj(a[i]) * b[i];
    aa += std::norm(a[i]);
    bb += std::norm(b[i]);
  }
  return aa > 0.0 && bb > 0.0 ? std::norm(product) / (aa * bb) : 0.0;
}

std::vector<MergingCheck> merging_checks(const std::vector<MergedMode>& modes, const Identification& preger,
                                         const std::vector<records::CampaignChannel>& channels, const Eigen::VectorXd& scale) {
  Eigen::MatrixXd mac = Eigen::MatrixXd::Zero(std::ssize(modes), std::ssize(preger.modes));  // of pairs within kSameMode
  for (Index i = 0; i < mac.rows(); ++i) {
    for (Index j = 0; j < mac.cols(); ++j) {
      const MergedMode& mode = modes[static_cast<std::size_t>(i)];
      const Cluster& other = preger.modes[static_cast<std::size_t>(j)];
      if (std::abs(other.frequency_Hz - mode.frequency_Hz) <= kSameMode * mode.frequency_Hz)
        mac(i, j) = known_mac(mode.shape, other.shape);
    }
  }
  const std::vector<int> partner = matching::follow_modes(mac);
  std::vector<MergingCheck> checks(modes.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto row = static_cast<Index>(i);
    MergingCheck& check = checks[i];
    check.poser_frequency_Hz = modes[i].frequency_Hz;
    check.poser_damping_ratio = modes[i].damping_ratio;
    if (partner[i] >= 0 && mac(row, partner[i]) > 0.0) {
      const Cluster& other = preger.modes[static_cast<std::size_t>(partner[i])];
      set(check, other.frequency_Hz, other.damping_ratio, other.shape);
      check.mac = mac(row, partner[i]);
    } else if (mac.row(row).isZero(0.0)) {
      set_nearest_poles(check, preger, modes[i]);
      if (!check.found) continue;
      check.shape = physical_shape(check.shape, channels, scale, check.frequency_Hz, check.damping_ratio);
      check.mac = known_mac(modes[i].shape, check.shape);
    }
  }
  return checks;
}

void take_preger(MergedMode& mode, const MergingCheck& check) {
  if (!check.found) return;
  const Eigen::Array<bool, Eigen::Dynamic, 1> unknown = mode.shape.real().array().isNaN();
  const Eigen::VectorXcd zero = Eigen::VectorXcd::Zero(mode.shape.size());
  const Eigen::VectorXcd before = unknown.select(zero.array(), mode.shape.array());
  const Eigen::VectorXcd after = normalised_shape(unknown.select(zero.array(), check.shape.array()));
  // Both shapes have their phase normalised, but their signs may differ.
  const Eigen::VectorXcd shift = after - before * std::polar(1.0, std::arg(before.dot(after)));
  ModeDeviation& deviation = mode.deviation;
  deviation.frequency_Hz = std::hypot(deviation.frequency_Hz, check.frequency_Hz - mode.frequency_Hz);
  deviation.damping_ratio = std::hypot(deviation.damping_ratio, check.damping_ratio - mode.damping_ratio);
  for (Index i = 0; i < shift.size(); ++i) {
    if (unknown[i]) continue;
    deviation.shape_real[i] = std::hypot(deviation.shape_real[i], shift[i].real());
    deviation.shape_imag[i] = std::hypot(deviation.shape_imag[i], shift[i].imag());
    mode.shape[i] = after[i];
  }
  mode.frequency_Hz = check.frequency_Hz;
  mode.damping_ratio = check.damping_ratio;
}

}  // namespace twindeck::identification
