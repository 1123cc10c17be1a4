#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

/// Residuals of an update that weighs frequencies and mode shapes by the covariance of the measurement. It takes measured rows
/// and what a model computes for them, and gives residuals in standard deviations with their exact derivatives.
namespace twindeck::updating {

/// One measured component of a mode shape.
struct ShapeRow {
  int target = 0;  ///< position of the target whose shape it is
  int channel = 0;
  bool imaginary = false;
  double value = 0.0;  ///< [-] in any norm, sign and phase that is common to the target's rows
};

/// Measured rows and their covariance: the frequencies of all targets in their order, then the components of shapes. A
/// component that was not measured has no row.
struct MeasuredRows {
  Eigen::MatrixXd channels;            ///< (n × n_channels) column c: channel c shows c' phi; empty without shapes
  std::vector<ShapeRow> shape;         ///< empty: frequencies alone
  std::vector<std::vector<int>> span;  ///< (n_targets) start modes in whose span the measured shape may lie: the target's own,
                                       ///< and those that are close to it
  Eigen::MatrixXd covariance;          ///< (n_rows × n_rows) [Hz², Hz, 1], positive definite; empty: no weighing, Eq. (5)
  [[nodiscard]] bool given() const { return covariance.size() > 0; }
};

/// What a model computes for measured rows at one point.
struct ComputedRows {
  Eigen::VectorXd frequency_Hz;              ///< (n_targets)
  Eigen::MatrixXd shape;                     ///< (n_channels × n_modes)
  std::vector<std::vector<int>> span;        ///< (n_targets) columns of `shape`
  Eigen::MatrixXd frequency_slope;           ///< [Hz] (n_targets × n_active) per normalised parameter; empty if not asked for
  std::vector<Eigen::MatrixXd> shape_slope;  ///< (n_active) of (n_channels × n_modes) per normalised parameter
};

/// Residuals at one point, all in standard deviations.
struct WeightedEvaluation {
  Eigen::VectorXd residual;   ///< (n_residuals)
  Eigen::MatrixXd jacobian;   ///< (n_residuals × n_active); empty if not asked for
  Eigen::VectorXd predicted;  ///< (n_residuals) computed value of each row, shapes with their best scales, in the rows' units
  int scales = 0;             ///< free scales that the shapes have used up
};

/// Residuals of measured rows d with covariance Sigma = L L':
///   r = -P L⁻¹ (d - g),   P = 1 - A A⁺,   A = L⁻¹ S,
/// where g holds the computed frequencies and S the computed shapes. P removes what any complex scale of each shape explains,
/// and within a cluster any combination of its shapes. For one shape ‖r‖² = (1 - MAC) ‖L⁻¹ d‖², the MAC in the metric of Sigma;
/// the vector is smooth where MAC = 1, which a square root of 1 - MAC is not. Of all scales ‖r‖² is the least, so that the sum
/// is minus twice the logarithm of the likelihood. The derivatives are those of Golub and Pereyra:
///   dr = P (dA s + L⁻¹ dg) - A⁺' dA' r,   s = A⁺ L⁻¹ (d - g).
/// A change of A within its own span, which turning modes of a cluster make, drops out.
/// Reference: Golub and Pereyra (1973), SIAM Journal on Numerical Analysis 10, 413-432 (variable projection).
class WeightedRows {
 public:
  /// @param frequency_Hz (n_targets) measured  @param fitted (n_targets) whether the target's rows take part
  WeightedRows(std::shared_ptr<const MeasuredRows> measured, Eigen::VectorXd frequency_Hz, std::vector<bool> fitted);

  [[nodiscard]] WeightedEvaluation evaluate(const ComputedRows& computed, bool with_jacobian) const;
  /// The same without the rows of a target.
  [[nodiscard]] std::shared_ptr<const WeightedRows> without(std::size_t target) const;
  /// Number of residuals: the rows that take part.
  [[nodiscard]] int size() const { return static_cast<int>(kept_.size()); }
  [[nodiscard]] const MeasuredRows& measured() const { return *measured_; }
  [[nodiscard]] bool has_shapes() const { return !measured_->shape.empty(); }
  /// Columns of the spans for reference modes at new positions. @param position (n_reference), -1 for a lost mode
  /// @return empty if a mode is lost
  [[nodiscard]] std::vector<std::vector<int>> spans_at(const std::vector<int>& position) const;

 private:
  [[nodiscard]] Eigen::MatrixXd scale_columns(const Eigen::MatrixXd& shape, const std::vector<std::vector<int>>& span) const;

  std::shared_ptr<const MeasuredRows> measured_;
  Eigen::VectorXd frequency_Hz_;
  std::vector<bool> fitted_;
  std::vector<Eigen::Index> kept_;         // rows that take part
  std::vector<Eigen::Index> first_scale_;  // (n_kept) first column of the row's scales, -1 for a frequency
  Eigen::Index n_scales_ = 0;
  Eigen::VectorXd value_;   // (n_kept)
  Eigen::MatrixXd factor_;  // L of the kept rows
};

}  // namespace twindeck::updating
