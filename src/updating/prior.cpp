#include "updating/prior.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace twindeck::updating {

namespace {

constexpr double least_error = 1e-3, most_error = 1.0;  ///< [-] of a frequency
constexpr int grid_steps =
    400;  ///< of ln s between them: steps of 1.7 % of s change an estimate by less than its printed rounding

template <class Rows>
Rows all_but(const Rows& rows, Eigen::Index row) {
  Rows out(rows.rows() - 1, rows.cols());
  out.topRows(row) = rows.topRows(row);
  out.bottomRows(rows.rows() - 1 - row) = rows.bottomRows(rows.rows() - 1 - row);
  return out;
}

}  // namespace

void Prior::append(const Eigen::VectorXd& x, Eigen::VectorXd& rows, Eigen::MatrixXd* slope) const {
  const Eigen::Index n = rows.size(), added = mean.size();
  rows.conservativeResize(n + added);
  rows.tail(added) = model_error * (x - mean).cwiseQuotient(deviation);
  if (slope == nullptr) return;
  slope->conservativeResize(n + added, Eigen::NoChange);
  slope->bottomRows(added) = (model_error * deviation.cwiseInverse()).asDiagonal();
}

Prior Prior::without(Eigen::Index row) const {
  Prior out = *this;
  if (residual.size() == 0) return out;
  out.residual = all_but(residual, row);
  out.jacobian = all_but(jacobian, row);
  out.model_error = estimated_model_error(out.residual, out.jacobian, deviation);
  return out;
}

Prior prior_of_ranges(const Box& box, const Eigen::VectorXd& initial, const Eigen::VectorXd& residual,
                      const Eigen::MatrixXd& jacobian) {
  Prior out{initial, (box.upper - box.lower) / std::sqrt(12.0), 1.0, residual, jacobian};
  if (residual.size() > 0) out.model_error = estimated_model_error(residual, jacobian, out.deviation);
  return out;
}

double estimated_model_error(const Eigen::VectorXd& residual, const Eigen::MatrixXd& jacobian,
                             const Eigen::VectorXd& deviation) {
  const Eigen::MatrixXd scaled = jacobian * deviation.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of_parameters(scaled * scaled.transpose());
  const Eigen::ArrayXd variance = of_parameters.eigenvalues().array().max(0.0);
  const Eigen::ArrayXd square = (of_parameters.eigenvectors().transpose() * residual).array().square();
  double best = least_error, most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k <= grid_steps; ++k) {
    const double s = least_error * std::pow(most_error / least_error, static_cast<double>(k) / grid_steps);
    const Eigen::ArrayXd total = variance + s * s;
    const double likelihood = -0.5 * (square / total + total.log()).sum();
    if (likelihood <= most) continue;
    most = likelihood;
    best = s;
  }
  return best;
}

}  // namespace twindeck::updating
