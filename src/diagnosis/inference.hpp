#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "diagnosis/prediction/feature_map.hpp"
#include "updating/joint_map.hpp"

namespace twindeck::diagnosis {

/// chi² of a fit that failed, above any real value.
inline constexpr double kNotFitted = 1e300;

/// Best fit of the training rows with given causes in the model, linearised there.
struct Fit {
  std::vector<Cause> causes;  ///< at their best magnitudes
  updating::JointMap map;     ///< of [x; coordinates of the causes], on the training rows
  FeatureMap::Base base;
  Prediction all;                   ///< at the fit, every row
  Eigen::MatrixXd total_factor;     ///< L, L L' = Sigma_id + J P J' + free scales, causes not included
  Eigen::VectorXd whitened;         ///< w = L^-1 (y - g + J x): N(0, I) where nothing is missing
  double chi_squared = kNotFitted;  ///< w'w
  double log_determinant = 0.0;     ///< of Sigma_tot
  Eigen::MatrixXd cause_jacobian;   ///< L^-1 dg/da (n_train × n_coordinates of causes)
  /// Whether the fit could be made: the model predicts the rows and their derivatives there.
  [[nodiscard]] bool made() const { return !(chi_squared >= kNotFitted); }
};

/// A candidate held against the rows.
struct Scored {
  const Candidate* candidate = nullptr;
  Eigen::VectorXd a;
  double screen = 0.0;        ///< 2 ln likelihood ratio against "nothing", summed over the magnitudes
  double log_odds = 0.0;      ///< ln posterior odds against "nothing"
  double remaining = 0.0;     ///< chi² of the best account with this cause
  bool fitted = false;        ///< true: fitted with the cause in the model; false: from the linearised base
  Eigen::VectorXd signature;  ///< L^-1 (g(x, a) - g(x)) (n_train)
};

/// Fits causes and computes their effects on the training rows of a feature map (docs/diagnosis.md).
class Inference {
 public:
  Inference(const FeatureMap& map, const std::vector<std::unique_ptr<Candidate>>& candidates);

  /// Joint MAP of x and the causes' magnitudes. `start`: x of a neighbouring fit; empty for zero.
  [[nodiscard]] Fit fit(const std::vector<Cause>& causes, const Eigen::VectorXd& start) const {
    return fitted(causes, start, true);
  }
  /// The same without causes and with `x` fixed.
  [[nodiscard]] Fit stand(const Eigen::VectorXd& x) const { return fitted({}, x, false); }
  /// A change dg of all rows, whitened for the training rows of a fit: L^-1 dg; empty if dg is empty.
  [[nodiscard]] Eigen::VectorXd whitened(const Fit& base, const Eigen::VectorXd& change) const;
  /// Whitened signature of a candidate at coordinates a; empty if it cannot be computed.
  [[nodiscard]] Eigen::VectorXd signature(const Fit& base, const Candidate& candidate, const Eigen::VectorXd& a) const;

  /// Change of all rows by a candidate at coordinates a; empty if it cannot be computed.
  [[nodiscard]] Eigen::VectorXd change(const Fit& base, const Candidate& candidate, const Eigen::VectorXd& a) const;
  /// Change of all rows by a candidate, at one of its trial magnitudes.
  struct Tried {
    Eigen::VectorXd a, change;  ///< coordinates; g(x, a) - g(x) (n_rows)
  };
  [[nodiscard]] std::vector<Tried> tried(const Fit& base, const Candidate& candidate) const;

  [[nodiscard]] const std::vector<int>& training() const { return training_; }
  [[nodiscard]] const std::vector<int>& held_out() const { return held_out_; }
  [[nodiscard]] int dof() const { return static_cast<int>(training_.size()) - training_scales_; }
  [[nodiscard]] const FeatureMap& map() const { return map_; }
  /// Covariance of the training rows' errors (n_train × n_train).
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return sigma_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Candidate>>& candidates() const { return candidates_; }

 private:
  /// @param moves  false: magnitudes and x of `start` are kept
  [[nodiscard]] Fit fitted(const std::vector<Cause>& causes, const Eigen::VectorXd& start, bool moves) const;
  /// Trial magnitudes; those tuned to modes follow the modes of the base.
  [[nodiscard]] std::vector<Eigen::VectorXd> starts_at(const Fit& base, const Candidate& candidate) const;
  /// Whitens the residuals of a joint fit; x and the causes count as scatter.
  /// @param width  scale of each cause coordinate in the Jacobian (n_coordinates)
  void marginalise(const Eigen::VectorXd& width, Fit& fit) const;
  [[nodiscard]] Eigen::MatrixXd slopes(const FeatureMap::Base& at, const std::vector<Cause>& causes, std::size_t which,
                                       const Prediction& here) const;

  const FeatureMap& map_;
  const std::vector<std::unique_ptr<Candidate>>& candidates_;
  std::vector<int> training_, held_out_;
  Eigen::VectorXd y_;
  Eigen::MatrixXd sigma_, sigma_factor_;
  int training_scales_ = 0;
};

}  // namespace twindeck::diagnosis
