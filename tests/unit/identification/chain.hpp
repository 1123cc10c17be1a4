#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "../signal/noise.hpp"

namespace twindeck::identification::test {

using signal::test::Noise;

/// n equal masses between two walls, n + 1 equal springs, the same damping ratio in each mode. Closed form:
///   omega_r = 2 omega_0 sin(r pi / (2 (n + 1))),   phi_r(j) = sin(r j pi / (n + 1)).
/// Displacements are measured; white forces act on every mass.
class Chain {
 public:
  Chain(int n, double omega_0, double zeta, double rate_Hz) : n_(n), rate_(rate_Hz), omega_(n), shapes_(n, n), zeta_(zeta) {
    for (int r = 1; r <= n; ++r) {
      omega_[r - 1] = 2.0 * omega_0 * std::sin(r * std::numbers::pi / (2.0 * (n + 1)));
      for (int j = 1; j <= n; ++j)
        shapes_(j - 1, r - 1) = std::sqrt(2.0 / (n + 1)) * std::sin(r * j * std::numbers::pi / (n + 1));
    }
  }
  double frequency_Hz(int r) const { return omega_[r] / (2.0 * std::numbers::pi); }
  Eigen::VectorXd shape(int r) const { return shapes_.col(r); }
  int size() const { return n_; }

  /// Exact discrete state space, mode by mode: continuous white modal force of intensity 1 gives the state noise covariance Q
  /// by Van Loan's formula. @return (n_samples × n) displacements scaled to unit mean deviation, with noise of the share
  /// `noise`
  Eigen::MatrixXd simulate(Eigen::Index n_samples, std::uint64_t seed, double noise) const {
    Noise random(seed);
    Eigen::MatrixXd modal(n_samples, n_);
    for (int r = 0; r < n_; ++r) {
      const auto [a, chol] = discrete(r);
      Eigen::Vector2d x = Eigen::Vector2d::Zero();
      for (Eigen::Index t = -2000; t < n_samples; ++t) {
        Eigen::Vector2d w;
        w << random(), random();
        x = a * x + chol * w;
        if (t >= 0) modal(t, r) = x[0];
      }
    }
    Eigen::MatrixXd y = modal * shapes_.transpose();
    y /= std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
    for (double& value : y.reshaped()) value += noise * random();
    return y;
  }

  /// Exact correlations R_0 … R_{n_lags-1} of the noise-free displacements.
  std::vector<Eigen::MatrixXd> exact_correlations(int n_lags) const {
    std::vector<Eigen::MatrixXd> lags;
    for (int k = 0; k < n_lags; ++k) {
      Eigen::VectorXd modal(n_);
      for (int r = 0; r < n_; ++r) {
        const double w = omega_[r], wd = w * std::sqrt(1.0 - zeta_ * zeta_), t = k / rate_;
        // Autocorrelation of an oscillator under unit white noise: 1/(4 zeta w³) e^(-zeta w t)(cos wd t + zeta w/wd sin wd t).
        modal[r] =
            std::exp(-zeta_ * w * t) * (std::cos(wd * t) + zeta_ * w / wd * std::sin(wd * t)) / (4.0 * zeta_ * w * w * w);
      }
      lags.emplace_back(shapes_ * modal.asDiagonal() * shapes_.transpose());
    }
    return lags;
  }

 private:
  std::pair<Eigen::Matrix2d, Eigen::Matrix2d> discrete(int r) const {
    const double w = omega_[r];
    Eigen::Matrix2d a;
    a << 0.0, 1.0, -w * w, -2.0 * zeta_ * w;
    Eigen::Matrix4d van_loan = Eigen::Matrix4d::Zero();
    van_loan.topLeftCorner<2, 2>() = -a;
    van_loan(1, 3) = 1.0;
    van_loan.bottomRightCorner<2, 2>() = a.transpose();
    const Eigen::Matrix4d exponential = (van_loan / rate_).exp();
    const Eigen::Matrix2d discrete_a = exponential.bottomRightCorner<2, 2>().transpose();
    const Eigen::Matrix2d q = discrete_a * exponential.topRightCorner<2, 2>();
    return {discrete_a, Eigen::Matrix2d(q.llt().matrixL())};
  }
  int n_;
  double rate_;
  Eigen::VectorXd omega_;
  Eigen::MatrixXd shapes_;
  double zeta_;
};

}  // namespace twindeck::identification::test
