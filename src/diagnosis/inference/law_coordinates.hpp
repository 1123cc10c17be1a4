#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <optional>
#include <vector>

namespace twindeck::diagnosis {

struct LawSystem;
struct ErrorColumns;

/// Coordinates z of a system's rows of which the classes of errors reach only the first ones:
///   Sigma(tau) = diag(S_0 + sum_c tau_c² D_c D_c', I).
/// Half of the rows of a measurement with imaginary parts and dampings are in no class but that of gains, which has few
/// columns.
class LawCoordinates {
 public:
  explicit LawCoordinates(const LawSystem& system);

  [[nodiscard]] bool exist() const { return exist_; }                        ///< false: Sigma_0 is not positive definite
  [[nodiscard]] double log_determinant() const { return log_determinant_; }  ///< of the rows' Sigma without that of the reached
  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& rows) const;       ///< z (n_rows × n), the reached ones first
  [[nodiscard]] const Eigen::MatrixXd& sigma() const { return sigma_; }      ///< S_0 (n_reached × n_reached)
  [[nodiscard]] const std::vector<ErrorColumns>& classes() const { return classes_; }  ///< in the reached coordinates

 private:
  std::vector<int> reached_, apart_;  ///< rows that a class reaches by many columns, and the others
  Eigen::MatrixXd lower_;             ///< L L' = Sigma_0 of the rows apart
  Eigen::MatrixXd across_;            ///< Sigma_0 of the reached rows with those apart, times L'^-1 (n_reached × n_apart)
  std::optional<Eigen::HouseholderQR<Eigen::MatrixXd>>
      few_;  ///< of the few columns in the whitened rows apart (n_apart × n_few)
  bool exist_ = false;
  double log_determinant_ = 0.0;
  Eigen::MatrixXd sigma_;
  std::vector<ErrorColumns> classes_;
};

}  // namespace twindeck::diagnosis
