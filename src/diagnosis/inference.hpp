#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/prediction/feature_map.hpp"
#include "updating/joint_map.hpp"

namespace twindeck::diagnosis {

/// Stands for chi² of a fit that could not be made: beyond any that data give.
inline constexpr double kNotFitted = 1e300;

/// Best account of the training rows with given causes in the model, linearised there.
struct Fit {
  std::vector<Cause> causes;  ///< at their best magnitudes
  updating::JointMap map;     ///< of [x; coordinates of the causes], on the training rows
  FeatureMap::Base base;
  Prediction all;                  ///< at the fit, every row
  Eigen::MatrixXd total_factor;    ///< L, L L' = Sigma_id + J P J' + free scales, causes not included
  Eigen::VectorXd whitened;        ///< w = L^-1 (y - g + J x): N(0, I) where nothing is missing
  double chi_squared = 0.0;        ///< w'w
  double log_determinant = 0.0;    ///< of Sigma_tot
  Eigen::MatrixXd cause_jacobian;  ///< L^-1 dg/da (n_train × n_coordinates of causes)
  /// Whether the fit could be made: the model predicts the rows and their derivatives there.
  [[nodiscard]] bool made() const { return !(chi_squared >= kNotFitted); }
};

/// A candidate held against the rows.
struct Scored {
  const Candidate* candidate = nullptr;
  Eigen::VectorXd a;
  double screen = 0.0;        ///< 2 ln likelihood ratio against nothing missing, magnitudes summed over
  double log_odds = 0.0;      ///< ln posterior odds against nothing missing
  double remaining = 0.0;     ///< chi² that the best account with this cause leaves
  bool fitted = false;        ///< with the cause in the model; false: on the base linearised
  Eigen::VectorXd signature;  ///< L^-1 (g(x, a) - g(x)) (n_train)
};

/// Fits causes and tells their effects on the training rows of a feature map (docs/diagnosis.md).
class Inference {
 public:
  Inference(const FeatureMap& map, const std::vector<std::unique_ptr<Candidate>>& candidates);

  /// Joint MAP of x and the causes' magnitudes. `start`: x of a neighbouring fit; empty for zero.
  [[nodiscard]] Fit fit(const std::vector<Cause>& causes, const Eigen::VectorXd& start) const {
    return fitted(causes, start, true);
  }
  /// The same where it stands: `x` is not moved (the causes are none).
  [[nodiscard]] Fit stand(const Eigen::VectorXd& x) const { return fitted({}, x, false); }
  /// A change of all rows as the training rows of a fit see it, L^-1 dg; empty for an empty one.
  [[nodiscard]] Eigen::VectorXd whitened(const Fit& base, const Eigen::VectorXd& change) const;
  /// Signature of a candidate at coordinates a, whitened; empty where it cannot be computed.
  [[nodiscard]] Eigen::VectorXd signature(const Fit& base, const Candidate& candidate, const Eigen::VectorXd& a) const;

  /// What a candidate at coordinates a does to all rows; empty where it cannot be computed.
  [[nodiscard]] Eigen::VectorXd change(const Fit& base, const Candidate& candidate, const Eigen::VectorXd& a) const;
  /// What a candidate does to all rows at the magnitudes that the screen tries.
  struct Tried {
    Eigen::VectorXd a, change;  ///< coordinates; g(x, a) - g(x) (n_rows)
  };
  [[nodiscard]] std::vector<Tried> tried(const Fit& base, const Candidate& candidate) const;

  [[nodiscard]] const std::vector<int>& training() const { return training_; }
  [[nodiscard]] const std::vector<int>& held_out() const { return held_out_; }
  [[nodiscard]] int dof() const { return static_cast<int>(training_.size()) - training_scales_; }
  [[nodiscard]] const FeatureMap& map() const { return map_; }
  /// Of the training rows' errors (n_train × n_train).
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return sigma_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Candidate>>& candidates() const { return candidates_; }

 private:
  /// @param moves  false: at most the magnitudes and x of the start
  [[nodiscard]] Fit fitted(const std::vector<Cause>& causes, const Eigen::VectorXd& start, bool moves) const;
  /// Magnitudes that the screen tries, those tuned to modes where the base has the modes.
  [[nodiscard]] std::vector<Eigen::VectorXd> starts_at(const Fit& base, const Candidate& candidate) const;
  /// Whitens what a joint fit leaves, with x and the causes as scatter. @param width  of the causes' coordinates, by which
  /// their columns were scaled (n_coordinates)
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
