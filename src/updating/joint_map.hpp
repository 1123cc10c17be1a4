#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/error.hpp"
#include "updating/optimality.hpp"

namespace twindeck::updating {

/// Prediction of a model for the rows of a measurement at x. If the pointers are not null, also the derivatives J = dg/dx and
/// the directions S in which g may be scaled without cost (shapes). Returns false if there is no prediction; the step is then
/// refused.
using PredictionFunction =
    std::function<bool(const Eigen::VectorXd& x, Eigen::VectorXd& g, Eigen::MatrixXd* jacobian, Eigen::MatrixXd* scales)>;

/// Maximum a posteriori (MAP) estimate of x in  y = g(x) + e,  e ~ N(0, Sigma), x ~ N(0, I) inside a box.
struct JointMap {
  Eigen::VectorXd x, g;              ///< the free scales of rows are at their optimum in `g`
  Eigen::MatrixXd jacobian, scales;  ///< at x
  double chi_squared = 0.0;  ///< (y-g)' Sigma^-1 (y-g) + x'x: chi² with rows - scales degrees of freedom if the model is right
  double gradient = 0.0;     ///< norm of the projected gradient
  int iterations = 0;
  Status status;
};

struct JointMapOptions {
  int max_iterations = 40;
  double tolerance = 0.02;  ///< fall of chi² predicted by the linearised problem below which the search ends
};

/// Levenberg-Marquardt on the whitened rows, with the prior as further rows. Components on a bound stay there while the descent
/// direction points outwards. Global and fine-scale unknowns are fitted together: with the global ones alone, ordinary element
/// scatter would look like an error of the model.
/// @param y (n_rows) @param sigma_factor  lower Cholesky factor of Sigma (n_rows × n_rows)
/// Reference: Nocedal and Wright (2006), Numerical Optimization, sections 10.3 and 16.7.
[[nodiscard]] JointMap joint_map(const PredictionFunction& predict, const Eigen::VectorXd& y,
                                 const Eigen::MatrixXd& sigma_factor, const Eigen::VectorXd& start, const Box& box,
                                 const JointMapOptions& options = {});

}  // namespace twindeck::updating
