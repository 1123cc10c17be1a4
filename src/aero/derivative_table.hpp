#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "aero/derivatives.hpp"

namespace twindeck::aero {

/// What a table does for a reduced velocity outside its range.
enum class OutOfRange {
  refuse,  ///< InputError that names the range
  hold     ///< the values of its nearest end, in the convention of the table
};

/// One derivative over reduced velocity (columns) and angle of attack (rows): bilinear between the points.
struct DerivativeCurve {
  std::vector<double> v_over_omegaB;  ///< ascending
  Eigen::MatrixXd value;              ///< (n_alpha × n_v) in the table's convention
};

/// Measured derivatives: eighteen curves over common angles of attack. A single angle holds at every angle.
/// Interpolation is linear in the table's own convention (Zasso's values stay of order one, Scanlan's grow with V* and V*²).
class DerivativeTable : public FlutterDerivatives {
 public:
  /// @throws InputError  for axes that do not ascend or sizes that do not fit
  DerivativeTable(Convention convention, std::vector<double> alpha_rad, std::array<DerivativeCurve, 18> curves,
                  std::string source, OutOfRange below = OutOfRange::refuse, OutOfRange above = OutOfRange::refuse);
  /// @throws InputError  outside the table, with derivative, range and requested value
  [[nodiscard]] DerivativeBlock at(double alpha_rad, double v_over_omegaB) const override;
  [[nodiscard]] bool covers(double alpha_rad, double v_over_omegaB) const override;
  /// The same table with all eighteen derivatives multiplied: self-excited forces of another magnitude, as for another ratio of
  /// air to deck mass. Signs and shapes over the reduced velocity are kept.
  [[nodiscard]] DerivativeTable scaled(double factor) const;
  [[nodiscard]] const std::vector<double>& alpha_rad() const { return alpha_rad_; }
  /// Lowest and highest reduced velocity that all eighteen curves cover.
  [[nodiscard]] std::pair<double, double> range_v_over_omegaB() const;
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  [[nodiscard]] bool covers_angle(double alpha_rad) const;
  [[nodiscard]] bool covers_velocity(const DerivativeCurve& curve, double v_over_omegaB) const;

  Convention convention_;
  std::vector<double> alpha_rad_;
  std::array<DerivativeCurve, 18> curves_;
  std::string source_;
  OutOfRange below_, above_;
};

}  // namespace twindeck::aero
