#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/error.hpp"
#include "updating/optimality.hpp"

namespace twindeck::updating {

/// What a model predicts for the rows of a measurement at x, with derivatives when asked for (not null): J = dg/dx and the
/// directions S in which g may be scaled free of cost (shapes). Returns false where there is no prediction: the step is refused.
using PredictionFunction =
    std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& g, Eigen::MatrixXd* jacobian, Eigen::MatrixXd* scales)>;

/// Most probable unknowns of  y = g(x) + e,  e ~ N(0, Sigma), x ~ N(0, I) inside a box.
struct JointMap {
  Eigen::VectorXd x, g;                 ///< g without the rows' own scales: those are at their best inside `g`
  Eigen::MatrixXd jacobian, scales;     ///< at x
  double chi_squared = 0.0;             ///< (y-g)' Sigma^-1 (y-g) + x'x: distributed as chi² with rows - scales where all holds
  double gradient = 0.0;                ///< norm of the projected gradient
  int iterations = 0;
  Status status;
};

struct JointMapOptions {
  int max_iterations = 40;
  double tolerance = 0.02;  ///< fall of chi² predicted by the linearised problem below which the search ends
};

/// Levenberg-Marquardt on the whitened rows with the prior as rows of their own; components on a bound with the descent direction
/// pointing outwards rest. Global and fine-scale unknowns move together: with the global ones alone, ordinary scatter of
/// workmanship looks like an error of the model.
/// @param y (n_rows) @param sigma_factor  lower Cholesky factor of Sigma (n_rows × n_rows)
/// Reference: Nocedal and Wright (2006), Numerical Optimization, sections 10.3 and 16.7.
[[nodiscard]] JointMap joint_map(const PredictionFunction& predict, const Eigen::VectorXd& y, const Eigen::MatrixXd& sigma_factor,
                                 const Eigen::VectorXd& start, const Box& box, const JointMapOptions& options = {});

}  // namespace twindeck::updating
