#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "diagnosis/inference/law_coordinates.hpp"

namespace twindeck::diagnosis {

/// A class of errors of unit scale.
struct ErrorColumns {
  Eigen::MatrixXd covariance;  ///< P = D D' (n_rows × n_rows); empty for a class without errors
  Eigen::MatrixXd columns;     ///< D (n_rows × n_columns), no more columns than rows

  /// @param covariance  positive semidefinite, or empty
  static ErrorColumns of_covariance(Eigen::MatrixXd covariance);
  /// @param columns (n_rows × n_columns), or none
  static ErrorColumns of_columns(Eigen::MatrixXd columns);
  [[nodiscard]] bool empty() const { return covariance.size() == 0; }
};

/// The law of a residual. Under a hypothesis h
///   r - s_h(a) ~ N(0, Sigma(tau)),   Sigma(tau) = Sigma_0 + sum_c tau_c² D_c D_c'.
/// Sigma_0 is the known covariance. Each class c of errors has columns D_c of unit scale and an unknown scale tau_c, with a
/// half-t prior of three degrees of freedom. A hypothesis states which classes are active.
struct LawSystem {
  Eigen::MatrixXd sigma;              ///< Sigma_0 (n_rows × n_rows)
  std::vector<ErrorColumns> classes;  ///< D_c and P_c
  Eigen::VectorXd residual;           ///< r (n_rows)
  Eigen::MatrixXd signatures;         ///< (n_rows × n_signatures) change of the rows by each cause
  double log_prior = 0.0;             ///< ln prior of the modes that the system holds for none of the model's
};

/// Sigma(tau) (n × n). @param sigma  Sigma_0 @param tau  (n_classes) 0 where a class is absent
[[nodiscard]] Eigen::MatrixXd covariance_at(Eigen::MatrixXd sigma, const std::vector<ErrorColumns>& classes,
                                            const Eigen::VectorXd& tau);
[[nodiscard]] Eigen::MatrixXd covariance_at(const LawSystem& system, const Eigen::VectorXd& tau);

/// A class that is active under a hypothesis, and the scale of its half-t law.
struct ActiveClass {
  int index = 0;        ///< position among the classes
  double scale = 1.0;   ///< of a half-t law of three degrees of freedom; with a spread the median of a log-normal law
  double spread = 0.0;  ///< deviation of ln tau; 0: half-t
};

/// Hypothesis on the rows of a system: effects at the magnitudes of a grid, or effects linear in k magnitudes about one point.
struct LawHypothesis {
  Eigen::MatrixXd left;             ///< r - s (n_rows × n_magnitudes); one column if the magnitudes are linear
  Eigen::VectorXd log_weight;       ///< ln prior of each magnitude (n_magnitudes)
  Eigen::MatrixXd slopes;           ///< of linear magnitudes (n_rows × k), or no column
  Eigen::VectorXd low, high;        ///< (k) bounds of their shifts from the point; the prior between is uniform
  std::vector<ActiveClass> active;  ///< classes with a scale; the other classes are absent
};

/// Laplace's approximation of a hypothesis' evidence about the mode of its scales in ln tau.
struct LawEvidence {
  double log_evidence = -1e300;  ///< without the constant -n/2 ln 2 pi
  double chi_squared = 0.0;      ///< e' Sigma^-1 e at the mode, at the best magnitude
  Eigen::VectorXd tau;           ///< (n_classes) at the mode; 0 where absent
  Eigen::VectorXd deviation;     ///< (n_classes) of ln tau
  Eigen::VectorXd shift;         ///< of linear magnitudes at the mode (k)
  Eigen::VectorXd weight;        ///< posterior of the grid's magnitudes at the mode (n_magnitudes)
  bool converged = false;
};

/// Prior of a scale in ln tau.
struct ScalePrior {
  double log_density = 0.0;
  double slope = 0.0;      ///< of the log density
  double curvature = 0.0;  ///< minus the second derivative
};
/// Half-t: ln p = ln(4 / (pi sqrt(3) s)) + ln tau - 2 ln(1 + q), q = tau² / (3 s²), slope 1 - 4 q / (1 + q), curvature
/// 8 q / (1 + q)².
[[nodiscard]] ScalePrior prior_of_scale(const ActiveClass& active, double log_tau);

/// ln of posterior over prior width of k unknowns with a uniform prior of given ranges, never a gain.
/// @param precision  in the likelihood (k × k)
[[nodiscard]] double log_width(const Eigen::MatrixXd& precision, const Eigen::VectorXd& range);

/// The law of a system. Each hypothesis' scales are found by scoring in ln tau: with alpha = Sigma^-1 e and the prior's slope
/// g_c and curvature k_c
///   gradient  tau_c² (alpha' P_c alpha - tr Sigma^-1 P_c) + g_c,
///   steps     H_cd = 2 tau_c² tau_d² alpha' P_c Sigma^-1 P_d alpha + delta_cd k_c,
///   volume    H_cd = 2 tau_c² tau_d² tr Sigma^-1 P_c Sigma^-1 P_d + delta_cd k_c at the mode. The trace is the sum of squares
/// of D_c' Sigma^-1 D_d.
/// References: Harville (1977), J. Am. Stat. Assoc. 72, 320-338 (scoring of variance components); Gilmour, Thompson and Cullis
/// (1995), Biometrics 51, 1440-1450 (steps by the average information).
class OneLaw {
 public:
  /// @param system  must outlive the law
  explicit OneLaw(const LawSystem& system) : system_(system), coordinates_(system) {}
  OneLaw(LawSystem&&) = delete;
  [[nodiscard]] Eigen::Index classes() const { return static_cast<Eigen::Index>(system_.classes.size()); }
  [[nodiscard]] const LawCoordinates& coordinates() const { return coordinates_; }

  /// Sigma at given scales.
  struct Point {
    Eigen::VectorXd tau;
    bool exists = false;           ///< false: Sigma is not positive definite
    Eigen::MatrixXd lower;         ///< L, L L' = Sigma in the coordinates that a class reaches
    double log_determinant = 0.0;  ///< of Sigma in the rows
    /// z' z is the chi² of rows. @param z  coordinates of rows (n_rows × n)
    [[nodiscard]] Eigen::MatrixXd whitened(Eigen::MatrixXd z) const;
  };
  [[nodiscard]] Point at(const Eigen::VectorXd& tau) const;

  /// Finds the mode of the scales and the evidence there; no `weight` if Sigma is not positive definite. @param start
  /// (n_classes) scales; an active class with 0 starts at its half-t scale
  [[nodiscard]] LawEvidence scored(const LawHypothesis& hypothesis, const Eigen::VectorXd& start) const;
  /// ln (likelihood × prior of ln tau) at given scales, summed over the magnitudes.
  [[nodiscard]] double log_posterior(const LawHypothesis& hypothesis, const Eigen::VectorXd& tau) const;

 private:
  struct Look;
  [[nodiscard]] Look look(const LawHypothesis& hypothesis, const Eigen::VectorXd& log_tau) const;
  /// Gradient, and a curvature for steps: the average information, the mean of observed and expected information. It needs only
  /// products with vectors. The expected (Fisher) information of Laplace's approximation needs products of matrices.
  void slope_of(const LawHypothesis& hypothesis, Look& look) const;
  [[nodiscard]] Eigen::MatrixXd expected_curvature(const LawHypothesis& hypothesis, const Look& look) const;
  /// Curvature in ln tau: information of the rows on each pair of classes, plus the prior's curvature.
  static Eigen::MatrixXd with_prior(const LawHypothesis& hypothesis, const Look& look,
                                    const std::function<double(std::size_t, std::size_t)>& information);

  /// A hypothesis with `left` and `slopes` in coordinates.
  [[nodiscard]] LawHypothesis in_coordinates(LawHypothesis hypothesis) const;

  const LawSystem& system_;
  LawCoordinates coordinates_;
};

}  // namespace twindeck::diagnosis
