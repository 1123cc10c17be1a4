#pragma once

#include <memory>
#include <random>

#include "chain.hpp"
#include "dynamics/eigenmodes.hpp"
#include "updating/residuals.hpp"
#include "updating/weighted_rows.hpp"

namespace twindeck::updating {

/// A chain of masses between walls, symmetric about its middle: `left` and `right` scale the springs of its halves.
inline SmallSystem twin_chain(int n, double lower, double upper) {
  SmallSystem small(n);
  const int left = small.parameter("left", 1.0, lower, upper), right = small.parameter("right", 1.0, lower, upper);
  for (int i = 0; i <= n; ++i)
    small.stiffness(400.0 * spring(n, i < n ? i : -1, i - 1), 2 * i < n ? left : (2 * i > n ? right : -1));
  return small.mass(Eigen::MatrixXd::Identity(n, n));
}

/// Modes of dense matrices. Oracle: Eigen's dense solver.
inline Eigen::MatrixXd dense_shapes(const fe::ParametricSystem& system, const Eigen::VectorXd& theta) {
  const Eigen::MatrixXd k = Eigen::MatrixXd(system.stiffness(theta)).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd m = Eigen::MatrixXd(system.mass(theta)).selfadjointView<Eigen::Lower>();
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(k, m).eigenvectors();
}

/// What would be measured at some masses with given standard deviations, and the targets.
struct ShapedMeasurement {
  std::vector<FrequencyTarget> targets;
  MeasuredRows rows;
};
inline ShapedMeasurement measure_chain(const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                                       const std::vector<int>& masses, int n_modes, double frequency_std, double shape_std,
                                       std::mt19937_64* noise) {
  std::normal_distribution<double> normal;
  const auto error = [&](double std) { return noise == nullptr ? 0.0 : std * normal(*noise); };
  const Eigen::VectorXd frequency = dense_frequencies(system, theta);
  const Eigen::MatrixXd shapes = dense_shapes(system, theta);
  ShapedMeasurement out;
  out.rows.channels = Eigen::MatrixXd::Zero(system.size(), std::ssize(masses));
  for (std::size_t c = 0; c < masses.size(); ++c) out.rows.channels(masses[c], static_cast<Eigen::Index>(c)) = 1.0;
  std::vector<double> variance;
  for (int i = 0; i < n_modes; ++i) {
    const double std = frequency_std * frequency(i);
    out.targets.push_back({std::to_string(i + 1), i, frequency(i) + error(std)});
    out.rows.span.push_back({i});
    variance.push_back(std * std);
  }
  for (int i = 0; i < n_modes; ++i) {
    const Eigen::VectorXd seen = out.rows.channels.transpose() * shapes.col(i);
    const double scale = (i % 2 == 0 ? 1.0 : -1.0) / seen.cwiseAbs().maxCoeff();  // any norm and sign
    for (int c = 0; c < seen.size(); ++c) {
      out.rows.shape.push_back({i, c, false, scale * seen(c) + error(shape_std)});
      variance.push_back(shape_std * shape_std);
    }
  }
  out.rows.covariance = Eigen::Map<Eigen::VectorXd>(variance.data(), std::ssize(variance)).asDiagonal();
  return out;
}

}  // namespace twindeck::updating
