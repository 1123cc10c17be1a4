#include "updating/weighted_rows.hpp"

#include <Eigen/Dense>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "linalg/dense.hpp"

namespace twindeck::updating {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// [-] A computed shape whose part outside the span of the others is below this share of it adds nothing to that span.
constexpr double dependent_shape = 1e-8;

/// Orthonormal basis of the span of the scaled columns, with the factors that solve for their coefficients.
struct Span {
  VectorXd length;           // of the columns before they were scaled to unit length
  std::vector<Index> basic;  // independent columns
  MatrixXd q, r;             // of the independent columns: scaled columns = q r

  explicit Span(MatrixXd a) : length(a.colwise().norm().transpose()) {
    if (a.cols() == 0) return;
    length = (length.array() > 0.0).select(length, 1.0);
    a = (a * length.cwiseInverse().asDiagonal()).eval();
    Eigen::ColPivHouseholderQR<MatrixXd> qr(a.rows(), a.cols());
    qr.setThreshold(dependent_shape);
    qr.compute(a);
    const Index rank = qr.rank();
    for (Index k = 0; k < rank; ++k) basic.push_back(qr.colsPermutation().indices()[k]);
    q = qr.householderQ() * MatrixXd::Identity(a.rows(), rank);
    r = qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>();
  }
  [[nodiscard]] Index rank() const { return std::ssize(basic); }
  /// The independent ones of other columns of the same order, scaled by the same lengths.
  [[nodiscard]] MatrixXd scaled(const MatrixXd& a) const {
    return a(Eigen::all, basic) * length(basic).cwiseInverse().asDiagonal();
  }
  /// Part of x outside the span; the second pass removes the rounding of the first.
  [[nodiscard]] VectorXd outside(VectorXd x) const {
    if (rank() == 0) return x;
    for (int pass = 0; pass < 2; ++pass) x -= q * (q.transpose() * x).eval();
    return x;
  }
};

}  // namespace

WeightedRows::WeightedRows(std::shared_ptr<const MeasuredRows> measured, VectorXd frequency_Hz, std::vector<bool> fitted)
    : measured_(std::move(measured)), frequency_Hz_(std::move(frequency_Hz)), fitted_(std::move(fitted)) {
  const Index n_targets = frequency_Hz_.size();
  TWINDECK_ASSERT(measured_->covariance.rows() == n_targets + std::ssize(measured_->shape));
  TWINDECK_ASSERT(measured_->shape.empty() || std::ssize(measured_->span) == n_targets);
  std::map<std::pair<int, bool>, Index> scale;  // first column of a target's real or imaginary part
  std::vector<double> value;
  for (Index i = 0; i < measured_->covariance.rows(); ++i) {
    const ShapeRow* row = i < n_targets ? nullptr : &measured_->shape[static_cast<std::size_t>(i - n_targets)];
    const Index target = row == nullptr ? i : row->target;
    if (!fitted_[static_cast<std::size_t>(target)]) continue;
    kept_.push_back(i);
    value.push_back(row == nullptr ? frequency_Hz_[i] : row->value);
    Index first = -1;
    if (row != nullptr) {
      const auto [at, is_new] = scale.try_emplace({row->target, row->imaginary}, n_scales_);
      first = at->second;
      if (is_new) n_scales_ += std::ssize(measured_->span[static_cast<std::size_t>(row->target)]);
    }
    first_scale_.push_back(first);
  }
  value_ = Eigen::Map<const VectorXd>(value.data(), std::ssize(value));
  factor_ = linalg::cholesky_factor(measured_->covariance(kept_, kept_));
  TWINDECK_ASSERT(factor_.rows() == value_.size());
}

std::shared_ptr<const WeightedRows> WeightedRows::without(std::size_t target) const {
  std::vector<bool> fitted = fitted_;
  fitted.at(target) = false;
  return std::make_shared<const WeightedRows>(measured_, frequency_Hz_, std::move(fitted));
}

std::vector<std::vector<int>> WeightedRows::spans_at(const std::vector<int>& position) const {
  std::vector<std::vector<int>> spans = measured_->span;
  for (std::vector<int>& span : spans) {
    for (int& mode : span) {
      mode = position.at(static_cast<std::size_t>(mode));
      if (mode < 0) return {};
    }
  }
  return spans;
}

MatrixXd WeightedRows::scale_columns(const MatrixXd& shape, const std::vector<std::vector<int>>& span) const {
  MatrixXd columns = MatrixXd::Zero(value_.size(), n_scales_);
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (first_scale_[i] < 0) continue;
    const ShapeRow& row = measured_->shape[static_cast<std::size_t>(kept_[i] - frequency_Hz_.size())];
    const std::vector<int>& modes = span[static_cast<std::size_t>(row.target)];
    for (std::size_t k = 0; k < modes.size(); ++k)
      columns(static_cast<Index>(i), first_scale_[i] + static_cast<Index>(k)) = shape(row.channel, modes[k]);
  }
  return columns;
}

Linearised WeightedRows::evaluate(const ComputedRows& computed, bool with_jacobian) const {
  const auto n_active = with_jacobian ? computed.frequency_slope.cols() : Index{0};
  VectorXd given = VectorXd::Zero(value_.size());  // g, and its slopes below
  MatrixXd given_slope = MatrixXd::Zero(value_.size(), n_active);
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (first_scale_[i] >= 0) continue;
    given[static_cast<Index>(i)] = computed.frequency_Hz[kept_[i]];
    if (with_jacobian) given_slope.row(static_cast<Index>(i)) = computed.frequency_slope.row(kept_[i]);
  }
  const MatrixXd columns = scale_columns(computed.shape, computed.span);
  const Span span(columns.cols() > 0 ? linalg::lower_solve(factor_, columns) : columns);
  const VectorXd whitened = linalg::lower_solve(factor_, MatrixXd(value_ - given));

  Linearised out;
  out.scales = static_cast<int>(span.rank());
  out.residual = -span.outside(whitened);
  out.predicted = given;
  VectorXd factor;
  if (span.rank() > 0) {
    factor = span.r.triangularView<Eigen::Upper>().solve((span.q.transpose() * whitened).eval());
    out.predicted += span.scaled(columns) * factor;
  }
  if (!with_jacobian) return out;
  out.jacobian = linalg::lower_solve(factor_, given_slope);
  for (Index j = 0; j < n_active; ++j) {
    VectorXd change = out.jacobian.col(j);
    if (span.rank() == 0) continue;
    const MatrixXd turn = span.scaled(
        linalg::lower_solve(factor_, scale_columns(computed.shape_slope[static_cast<std::size_t>(j)], computed.span)));
    change = span.outside(change + turn * factor);
    const VectorXd along = span.r.transpose().triangularView<Eigen::Lower>().solve((turn.transpose() * out.residual).eval());
    out.jacobian.col(j) = change - span.q * along;
  }
  return out;
}

}  // namespace twindeck::updating
