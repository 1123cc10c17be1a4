#include "identification/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/statistics.hpp"
#include "identification/ssi_cov.hpp"
#include "linalg/dense.hpp"

namespace twindeck::identification {

using Eigen::Index;

PoleFactors pole_factors(const Observability& observability, const ShiftModels& models, const Changes& changes) {
  const Index l = observability.n_outputs;
  PoleFactors factors;
  for (const OrderModel& model : models.orders)
    factors.of.emplace_back(model.poles.size(), Eigen::MatrixXd(2 + 2 * l, static_cast<Index>(changes.size())));
  for (std::size_t b = 0; b < changes.size(); ++b) {
    for (std::size_t order = 0; order < models.orders.size(); ++order) {
      const auto poles = pole_changes(observability, models, order, changes[b]);
      for (std::size_t i = 0; i < poles.size(); ++i)
        factors.of[order][i].col(static_cast<Index>(b)) << poles[i].frequency_Hz, poles[i].damping_ratio, poles[i].shape.real(),
            poles[i].shape.imag();
    }
  }
  return factors;
}

namespace {

const Eigen::MatrixXd& factor_of(const ShiftModels& models, const PoleFactors& factors, const Pole& pole) {
  const auto model = std::ranges::find_if(models.orders, [&](const OrderModel& m) { return m.order == pole.order; });
  TWINDECK_ASSERT(model != models.orders.end());
  const auto at = std::ranges::find_if(model->poles, [&](const Pole& p) { return p.eigenvalue == pole.eigenvalue; });
  TWINDECK_ASSERT(at != model->poles.end());
  return factors
      .of[static_cast<std::size_t>(model - models.orders.begin())][static_cast<std::size_t>(at - model->poles.begin())];
}

/// The factor of a pole, with its shape rotated to the phase of the reference.
Eigen::MatrixXd turned_factor(const ShiftModels& models, const PoleFactors& factors, const Pole& pole,
                              const Eigen::VectorXcd& reference) {
  Eigen::MatrixXd factor = factor_of(models, factors, pole);
  const Index l = pole.shape.size();
  const double angle = std::arg(pole.shape.dot(reference)), c = std::cos(angle), s = std::sin(angle);
  const Eigen::MatrixXd real = factor.middleRows(2, l), imag = factor.bottomRows(l);
  factor.middleRows(2, l) = c * real - s * imag;
  factor.bottomRows(l) = s * real + c * imag;
  return factor;
}

}  // namespace

double frequency_deviation(const ShiftModels& models, const PoleFactors& factors, const Pole& pole) {
  return factor_of(models, factors, pole).row(0).norm();
}

double difference_deviation(const ShiftModels& models, const PoleFactors& factors, const Pole& pole, const Pole& other) {
  return (factor_of(models, factors, pole).row(0) - factor_of(models, factors, other).row(0)).norm();
}

ModeDeviation deviation_of_factor(Eigen::MatrixXd factor) {
  const Eigen::VectorXd sigma = factor.rowwise().norm();
  const Index l = (sigma.size() - 2) / 2;
  return {sigma[0], sigma[1], sigma.segment(2, l), sigma.tail(l), std::move(factor)};
}

std::vector<ModeDeviation> mode_deviations(const ShiftModels& models, const PoleFactors& factors,
                                           const std::vector<std::vector<Pole>>& modes) {
  std::vector<ModeDeviation> deviations;
  for (const std::vector<Pole>& mode : modes) {
    const auto members =
        each_of(mode, [&](const Pole& pole) { return turned_factor(models, factors, pole, mode.front().shape); });
    Eigen::MatrixXd factor(members.front().rows(), members.front().cols());
    for (Index b = 0; b < factor.cols(); ++b)
      for (Index row = 0; row < factor.rows(); ++row)
        factor(row, b) = median(each_of(members, [&](const Eigen::MatrixXd& member) { return member(row, b); }));
    deviations.push_back(deviation_of_factor(std::move(factor)));
  }
  return deviations;
}

std::vector<Eigen::MatrixXd> lag_change(const signal::BlockCorrelations& blocks, const std::vector<Eigen::MatrixXd>& mean,
                                        Index block) {
  const Index l = blocks.n_outputs, r = blocks.n_references;
  const auto n_b = static_cast<double>(blocks.n_blocks());
  std::vector<Eigen::MatrixXd> change;
  for (Index k = 0; k < blocks.n_lags; ++k) {
    const double count = blocks.counts(k, block), total = blocks.counts.row(k).sum();
    const Eigen::Map<const Eigen::MatrixXd> sums(blocks.sums.col(block).data() + k * l * r, l, r);
    change.emplace_back((sums - count * mean[static_cast<std::size_t>(k)]) / total * std::sqrt(n_b / (n_b - 1.0)));
  }
  return change;
}

Changes covariance_changes(const signal::BlockCorrelations& blocks, Index block_rows, const Observability& observability,
                           const ShiftModels& models) {
  TWINDECK_ASSERT(blocks.n_blocks() >= 2);
  const std::vector<Eigen::MatrixXd> mean = blocks.mean();
  Changes changes;
  for (Index b = 0; b < blocks.n_blocks(); ++b) {
    const Eigen::MatrixXd change = block_toeplitz(lag_change(blocks, mean, b), block_rows);
    changes.push_back(subspace_change(observability, models, linalg::product(change, observability.right)));
  }
  return changes;
}

}  // namespace twindeck::identification
