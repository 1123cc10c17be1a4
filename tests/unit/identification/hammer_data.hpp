#pragma once

#include <Eigen/QR>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "../signal/noise.hpp"
#include "identification/modal_fit.hpp"
#include "universal_responses.hpp"

/// A hammer test in closed form: a structure of six modes at eight points, and its functions with noise.
namespace twindeck::test {

/// Two close modes (4 % apart, 1.0 % and 1.2 % of damping), damping ratios from 0.2 % to 5 %. Shapes: orthonormal columns of
/// a matrix of sines with unequal arguments.
inline ModalModel six_modes() {
  ModalModel model;
  model.frequency_Hz.resize(6);
  model.damping_ratio.resize(6);
  model.frequency_Hz << 8.0, 8.35, 14.0, 22.0, 31.0, 40.0;
  model.damping_ratio << 0.010, 0.012, 0.002, 0.050, 0.005, 0.020;
  Eigen::MatrixXd raw(8, 6);
  for (Eigen::Index i = 0; i < 8; ++i)
    for (Eigen::Index j = 0; j < 6; ++j)
      raw(i, j) =
          std::sin(1.0 + 1.7 * static_cast<double>(i) + 2.3 * static_cast<double>(j) + 0.9 * static_cast<double>(i * j));
  model.shapes = Eigen::HouseholderQR<Eigen::MatrixXd>(raw).householderQ() * Eigen::MatrixXd::Identity(8, 6);
  return model;
}

inline Eigen::VectorXd lines_of(double first_Hz, double last_Hz, Eigen::Index n) {
  return Eigen::VectorXd::LinSpaced(n, first_Hz, last_Hz);
}

/// Accelerances of all points to the hammer at the given ones, with complex normal noise of a share of each function's RMS.
inline identification::ResponseData hammer_data(const ModalModel& model, const std::vector<Eigen::Index>& hammer,
                                                const Eigen::VectorXd& f, double noise, std::uint64_t seed) {
  identification::ResponseData data;
  data.frequency_Hz = f;
  data.n_inputs = static_cast<Eigen::Index>(hammer.size());
  data.values.resize(f.size(), model.shapes.rows() * data.n_inputs);
  signal::test::Noise random(seed);
  for (Eigen::Index o = 0; o < model.shapes.rows(); ++o)
    for (Eigen::Index i = 0; i < data.n_inputs; ++i) {
      auto column = data.values.col(o * data.n_inputs + i);
      column = model.accelerance(o, hammer[static_cast<std::size_t>(i)], f);
      const double each = noise * column.norm() / std::sqrt(2.0 * static_cast<double>(f.size()));
      for (std::complex<double>& value : column) {
        const double real = random(), imag = random();
        value += each * std::complex<double>(real, imag);
      }
    }
  return data;
}

inline double mac_with(const ModalModel& model, Eigen::Index mode, const Eigen::VectorXcd& shape) {
  return std::norm(model.shapes.col(mode).cast<std::complex<double>>().dot(shape)) /
         (model.shapes.col(mode).squaredNorm() * shape.squaredNorm());
}

}  // namespace twindeck::test
