#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnosis/inference/scale_grid.hpp"

namespace twindeck::diagnosis {

/// Unknowns of a generic change with one contrast, and the signatures that are compared with it.
struct ChangeColumns {
  Eigen::MatrixXd columns;      ///< G (n_rows × n)
  std::vector<int> signatures;  ///< positions in FormSystem::signatures
};

/// The linear model of the residual,
///   r = fixed · z + w scatter · eps + tau_f frequency · d + tau_s (shape · u + kinks · v) + s + kappa G · c + e,
/// unknowns standard normal, e of covariance Sigma_0.
struct FormSystem {
  Eigen::MatrixXd sigma_factor;                             ///< lower L, L L' = Sigma_0 (n_rows × n_rows)
  Eigen::MatrixXd fixed, scatter, frequency, shape, kinks;  ///< (n_rows × n each)
  std::vector<ChangeColumns> change;
  Eigen::VectorXd residual;    ///< r (n_rows)
  Eigen::MatrixXd signatures;  ///< s (n_rows × n_signatures)
  bool all_products = false;   ///< true: products of all pairs of signatures; false: of each with itself only
};

/// Whether 16 digits suffice: products of columns in deviations of their rows stay far below what swallows the unknowns'
/// own variance of one. An extended model whose derivatives mean nothing fails it, and so do rows that are measured to a part
/// in a million.
[[nodiscard]] bool can_be_weighed(const FormSystem& system);

/// Quadratic forms of the residual and the signatures under one covariance Sigma.
struct Quadratic {
  double log_determinant = 0.0;   ///< of Sigma
  double chi_squared = 0.0;       ///< r' Sigma^-1 r
  Eigen::VectorXd along, square;  ///< s' Sigma^-1 r, s' Sigma^-1 s (n_signatures, or those of a ChangeColumns)
  Eigen::MatrixXd products;       ///< S' Sigma^-1 S if requested
  /// ln N(r - t s; 0, Sigma), the constant -n/2 ln 2 pi left out. @param s -1: without a signature
  [[nodiscard]] double log_density(Eigen::Index s = -1, double t = 1.0) const;
  [[nodiscard]] double remaining(Eigen::Index s = -1, double t = 1.0) const;  ///< (r - t s)' Sigma^-1 (r - t s)
};

/// One point of the scales: without a change, and by contrast and kappa.
struct AtScales {
  Quadratic without;
  std::vector<std::vector<Quadratic>> change;  ///< (n_contrasts × n_kappa)
};

/// Whitens all columns and computes all products once. A point of the scales then costs one Cholesky factor over the unknowns
/// for all signatures. Each kappa costs one over the unknowns of its contrast (Schur complement). Kinks are eliminated
/// beforehand, once for each tau_s, in the blocks of Sigma_0 (one mode each, or modes with correlated errors of shapes).
class FormEvidence {
 public:
  FormEvidence(const FormSystem& system, const ScaleGrid& grid);
  /// @param contrast  the one whose kappas are computed, the others stay empty; kAll or kNone
  [[nodiscard]] AtScales at(const ScalePoint& point, int contrast = kAll) const;
  static constexpr int kNone = -1, kAll = -2;
  [[nodiscard]] const ScaleGrid& grid() const { return grid_; }

 private:
  struct Eliminated {
    Eigen::MatrixXd gram;   ///< (m × m) of all columns after the kinks, m columns of every kind
    Eigen::MatrixXd right;  ///< (m × 1 + n_signatures) columns' products with residual and signatures
    Eigen::MatrixXd
        removed;  ///< (n_kinks × 1 + n_signatures): part of the products of residual and signatures that the kinks remove
    double log_determinant = 0.0;
  };
  [[nodiscard]] Quadratic quadratic(double log_determinant, const Eigen::MatrixXd& removed_here,
                                    const Eigen::MatrixXd& removed_by_change, const Eigen::MatrixXd& removed_by_kinks,
                                    const std::vector<int>& signatures) const;

  ScaleGrid grid_;
  Eigen::Index fixed_, scatter_, frequency_, shape_;  // numbers of columns
  std::vector<Eigen::Index> change_first_, change_count_;
  std::vector<std::vector<int>> asked_;
  std::vector<int> every_;
  Eigen::MatrixXd whitened_;  // L^-1 [r, signatures]
  double log_determinant_ = 0.0;
  bool all_products_;
  std::vector<Eliminated> eliminated_;  // (n_shape scales)
};

/// Term of a sum over scales (and magnitudes).
struct EvidenceTerm {
  double log_weight = 0.0;  ///< ln (prior × likelihood)
  int point = 0, kappa = -1;
  double chi_squared = 0.0;
};

/// Evidence of a hypothesis and its posterior of the scales.
struct HypothesisEvidence {
  double log_evidence = -1e300;
  EvidenceTerm best;                 ///< the point of the largest weight
  Eigen::VectorXd frequency, shape;  ///< posterior probabilities of the grid's tau_f, tau_s
  double kappa = 0.0;                ///< posterior geometric mean; 0 if there is none
};

[[nodiscard]] HypothesisEvidence summed(const std::vector<EvidenceTerm>& terms, const ScaleGrid& grid);

/// Posterior of a scale: geometric mean, and the 5 and 95 % quantiles with each point's probability spread evenly, in
/// logarithms, over its cell.
struct ScaleEstimate {
  double level = 0.0, low = 0.0, high = 0.0;
  bool at_end = false;  ///< the last point of the grid is the most probable
};
[[nodiscard]] ScaleEstimate estimate(const Eigen::VectorXd& points, const Eigen::VectorXd& probability);

/// ln (sum exp v).
[[nodiscard]] double log_sum(const std::vector<double>& v);

}  // namespace twindeck::diagnosis
