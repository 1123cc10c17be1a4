#pragma once

#include <Eigen/Core>
#include <Eigen/QR>
#include <optional>
#include <vector>

namespace twindeck::diagnosis {

struct LawSystem;
struct ErrorColumns;

/// Turns the rows of a system into coordinates z. The classes of errors reach the first coordinates only:
///   Sigma(tau) = diag(S_0 + sum_c tau_c² D_c D_c', I).
/// The steps of a search for the scales then work on these alone. Imaginary parts and dampings, half of the rows where they are
/// measured, have errors of gains only.
class LawCoordinates {
 public:
  explicit LawCoordinates(const LawSystem& system);

  [[nodiscard]] bool exist() const { return exist_; }                        ///< false: Sigma_0 is not positive definite
  [[nodiscard]] double log_determinant() const { return log_determinant_; }  ///< of Sigma in the rows, less that in z
  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& rows) const;       ///< z (n_rows × n), the reached ones first
  [[nodiscard]] const Eigen::MatrixXd& sigma() const { return sigma_; }      ///< S_0 (n_reached × n_reached)
  [[nodiscard]] const std::vector<ErrorColumns>& classes() const { return classes_; }  ///< in the reached coordinates

 private:
  std::vector<int> reached_, apart_;  ///< rows that a class reaches by many columns, and the others
  Eigen::MatrixXd lower_;             ///< L L' = Sigma_0 of the rows apart
  Eigen::MatrixXd across_;            ///< Sigma_0 of the reached rows with those apart, times L'^-1 (n_reached × n_apart)
  /// Of the columns of classes with few, in the whitened rows apart (n_apart × n_few).
  std::optional<Eigen::HouseholderQR<Eigen::MatrixXd>> few_;
  bool exist_ = false;
  double log_determinant_ = 0.0;
  Eigen::MatrixXd sigma_;
  std::vector<ErrorColumns> classes_;
};

}  // namespace twindeck::diagnosis
