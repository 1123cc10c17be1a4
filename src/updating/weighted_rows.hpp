#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

/// Residuals of an updating that weights frequencies and mode shapes by the covariance of the measurement. The input is the
/// measured rows and the values that a model computes for them. The output is residuals in standard deviations, with their
/// exact derivatives.
namespace twindeck::updating {

/// One measured component of a mode shape.
struct ShapeRow {
  int target = 0;  ///< position of the target to whose shape it belongs
  int channel = 0;
  bool imaginary = false;
  double value = 0.0;  ///< [-] norm, sign and phase are free, but the same in all rows of the target
};

/// Measured rows and their covariance: the frequencies of all targets in their order, then the components of shapes. A
/// component that was not measured has no row.
struct MeasuredRows {
  Eigen::MatrixXd channels;            ///< (n × n_channels) channel k reads column(k)' phi; empty without shapes
  std::vector<ShapeRow> shape;         ///< empty if only frequencies were measured
  std::vector<std::vector<int>> span;  ///< (n_targets) modes of the start model in whose span the measured shape may lie: the
                                       ///< mode of the target and the modes close to it
  Eigen::MatrixXd covariance;          ///< (n_rows × n_rows) [Hz², Hz, 1], positive definite; empty: no weighting, Eq. (5)
  [[nodiscard]] bool given() const { return covariance.size() > 0; }
};

/// Values that a model computes for the measured rows at one point.
struct ComputedRows {
  Eigen::VectorXd frequency_Hz;              ///< (n_targets)
  Eigen::MatrixXd shape;                     ///< (n_channels × n_modes)
  std::vector<std::vector<int>> span;        ///< (n_targets) columns of `shape`
  Eigen::MatrixXd frequency_slope;           ///< [Hz] (n_targets × n_active) per normalised parameter; empty if not asked for
  std::vector<Eigen::MatrixXd> shape_slope;  ///< (n_active) of (n_channels × n_modes) per normalised parameter
};

/// Residuals and their Jacobian at one point. Those of weighed rows are in standard deviations.
struct Linearised {
  Eigen::VectorXd residual;   ///< (n_residuals); empty where the modes were not found
  Eigen::MatrixXd jacobian;   ///< (n_residuals × n_active) per normalised parameter; empty if not asked for
  Eigen::VectorXd predicted;  ///< (n_residuals) computed value of each weighed row, shapes with their best scales, in the rows'
                              ///< units; else empty
  int scales = 0;             ///< number of free scales that were fitted to the weighed shapes
};

/// Residuals of measured rows d with covariance Sigma = L L':
///   r = -P L⁻¹ (d - g),   P = 1 - A A⁺,   A = L⁻¹ S,
/// where g holds the computed frequencies and S the computed shapes. P removes the part of L⁻¹ d that a complex scale of each
/// computed shape explains. Within a cluster of close modes it removes any linear combination of their shapes. For one shape
/// ‖r‖² = (1 - MAC) ‖L⁻¹ d‖², with the MAC in the metric of Sigma. The vector r is smooth at MAC = 1, but the square root of
/// 1 - MAC is not. ‖r‖² is the minimum over all scales, so the sum is minus twice the logarithm of the likelihood. The
/// derivatives are those of Golub and Pereyra:
///   dr = P (dA s + L⁻¹ dg) - A⁺' dA' r,   s = A⁺ L⁻¹ (d - g).
/// A change of A within its own span does not change r. Modes of a cluster that rotate into each other cause such a change.
/// Reference: Golub and Pereyra (1973), SIAM Journal on Numerical Analysis 10, 413-432 (variable projection).
class WeightedRows {
 public:
  /// @param frequency_Hz (n_targets) measured  @param fitted (n_targets) whether the target's rows take part
  WeightedRows(std::shared_ptr<const MeasuredRows> measured, Eigen::VectorXd frequency_Hz, std::vector<bool> fitted);

  [[nodiscard]] Linearised evaluate(const ComputedRows& computed, bool with_jacobian) const;
  /// The same without the rows of a target.
  [[nodiscard]] std::shared_ptr<const WeightedRows> without(std::size_t target) const;
  /// Number of residuals: the rows that take part.
  [[nodiscard]] int size() const { return static_cast<int>(kept_.size()); }
  [[nodiscard]] const MeasuredRows& measured() const { return *measured_; }
  [[nodiscard]] bool has_shapes() const { return !measured_->shape.empty(); }
  /// The spans, with each reference mode replaced by its new position. @param position (n_reference), -1 for a lost mode
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
