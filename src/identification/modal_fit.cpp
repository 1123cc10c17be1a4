#include "identification/modal_fit.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "identification/state_space.hpp"

namespace twindeck::identification {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;
using Poles = std::vector<std::complex<double>>;

namespace {

constexpr int kMostIterations = 40;
constexpr double kConverged = 1e-10;     ///< [-] change of a pole, relative to its magnitude
constexpr double kLargestStep = 0.5;     ///< [-] change of a pole in one iteration, as a share of its decay rate
constexpr double kLeastResidual = 1e-9;  ///< [-] of a function's RMS; functions without noise get no larger weight
/// Powers of omega of the residual terms, the inner two first.
constexpr std::array<double, 4> kResidualPowers = {-2.0, 0.0, -4.0, 2.0};

/// Real parts above imaginary parts.
MatrixXd stacked(const MatrixXcd& values) {
  MatrixXd both(2 * values.rows(), values.cols());
  both << values.real(), values.imag();
  return both;
}

/// (2 × 2) matrix of the multiplication with a complex number.
Eigen::Matrix2d product_with(std::complex<double> c) {
  Eigen::Matrix2d m;
  m << c.real(), -c.imag(), c.imag(), c.real();
  return m;
}

/// The model at given poles: linear parameters, residuals, and what the derivatives by the poles are made of.
struct LinearFit {
  MatrixXd q;          ///< (2 n_lines × n_linear) orthonormal basis of the linear model
  MatrixXd inverse;    ///< (n_linear × 2 n_lines) its least-squares inverse, columns as in `linear`
  MatrixXd linear;     ///< (n_linear × n_functions) real and imaginary part of each mode's residue, then the residual terms
  MatrixXd residuals;  ///< (2 n_lines × n_functions)
  MatrixXd slopes;     ///< (2 n_lines × 2 n_modes) derivatives by the real and imaginary part of residue times pole
  VectorXd weights;    ///< (n_functions)
  [[nodiscard]] std::complex<double> residue(Index mode, Index function) const {
    return {linear(2 * mode, function), linear(2 * mode + 1, function)};
  }
};

LinearFit linear_fit(const ResponseData& data, const MatrixXd& measured, const Poles& poles, std::size_t n_terms) {
  const Index lines = data.frequency_Hz.size(), n = std::ssize(poles);
  const Eigen::VectorXcd s = std::complex<double>(0.0, 2.0 * pi) * data.frequency_Hz;
  const double middle_Hz = std::sqrt(data.frequency_Hz[0] * data.frequency_Hz[lines - 1]);
  const std::complex<double> i(0.0, 1.0);
  MatrixXcd basis(lines, 2 * n + static_cast<Index>(n_terms)), slopes(lines, 2 * n);
  for (Index m = 0; m < n; ++m) {
    const Eigen::ArrayXcd own = (s.array() - poles[static_cast<std::size_t>(m)]).inverse(),
                          mirror = (s.array() - std::conj(poles[static_cast<std::size_t>(m)])).inverse();
    basis.col(2 * m) = own + mirror;
    basis.col(2 * m + 1) = i * (own - mirror);
    slopes.col(2 * m) = own.square() + mirror.square();
    slopes.col(2 * m + 1) = i * (own.square() - mirror.square());
  }
  for (std::size_t t = 0; t < n_terms; ++t)
    basis.col(2 * n + static_cast<Index>(t)) =
        (data.frequency_Hz.array() / middle_Hz).pow(kResidualPowers[t]).cast<std::complex<double>>();
  for (Index k = 0; k < lines; ++k) {
    const std::complex<double> factor = std::pow(s[k], data.derivative);
    basis.row(k) *= factor;
    slopes.row(k) *= factor;
  }
  MatrixXd a = stacked(basis);
  const VectorXd size = a.colwise().norm();
  a *= size.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  LinearFit fit;
  fit.q = qr.householderQ() * MatrixXd::Identity(a.rows(), qr.rank());
  fit.inverse = size.cwiseInverse().asDiagonal() * qr.solve(MatrixXd(fit.q)) * fit.q.transpose();
  fit.linear = fit.inverse * measured;
  fit.residuals = measured - fit.q * (fit.q.transpose() * measured);
  fit.slopes = stacked(slopes);
  const VectorXd rms = (measured.colwise().squaredNorm() / static_cast<double>(measured.rows())).cwiseSqrt();
  fit.weights = (fit.residuals.colwise().squaredNorm() / static_cast<double>(measured.rows()))
                    .cwiseSqrt()
                    .transpose()
                    .cwiseMax(kLeastResidual * rms)
                    .cwiseInverse();
  return fit;
}

/// Derivatives of one function by the poles from those by residue times pole: block diagonal, applied from the right.
MatrixXd times_residues(const MatrixXd& columns, const LinearFit& fit, Index function) {
  MatrixXd result(columns.rows(), columns.cols());
  for (Index m = 0; m < columns.cols() / 2; ++m)
    result.middleCols(2 * m, 2).noalias() = columns.middleCols(2 * m, 2) * product_with(fit.residue(m, function));
  return result;
}

/// Normal matrix and right side of the poles, summed over the functions. @param projected  slopes outside the linear model
std::pair<MatrixXd, VectorXd> normal_equations(const LinearFit& fit, const MatrixXd& projected) {
  const MatrixXd gram = projected.transpose() * projected, moments = projected.transpose() * fit.residuals;
  MatrixXd normal = MatrixXd::Zero(gram.rows(), gram.cols());
  VectorXd right = VectorXd::Zero(gram.rows());
  for (Index j = 0; j < fit.residuals.cols(); ++j) {
    const double w = fit.weights[j] * fit.weights[j];
    const MatrixXd half = times_residues(gram, fit, j).transpose();
    normal += w * times_residues(half, fit, j).transpose();
    right += w * times_residues(moments.col(j).transpose(), fit, j).transpose();
  }
  return {std::move(normal), std::move(right)};
}

/// Least squares by eigenvectors: directions that the functions do not determine get no step and a large deviation.
MatrixXd inverse_of(const MatrixXd& normal) {
  const VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.asDiagonal() * normal * scale.asDiagonal());
  constexpr double least = 1e-12;  // [-] eigenvalue of the normal matrix with a diagonal of ones
  const VectorXd values = eigen.eigenvalues().cwiseMax(least).cwiseInverse();
  return scale.asDiagonal() * eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose() *
         scale.asDiagonal();
}

MatrixXd outside(const LinearFit& fit) { return fit.slopes - fit.q * (fit.q.transpose() * fit.slopes); }

/// Gauss-Newton of the poles; the linear parameters follow.
LinearFit converge(const ResponseData& data, const MatrixXd& measured, Poles& poles, std::size_t n_terms) {
  for (int iteration = 0;; ++iteration) {
    LinearFit fit = linear_fit(data, measured, poles, n_terms);
    if (iteration == kMostIterations) return fit;
    const auto [normal, right] = normal_equations(fit, outside(fit));
    const VectorXd step = inverse_of(normal) * right;
    double largest = 0.0;
    for (std::size_t m = 0; m < poles.size(); ++m) {
      std::complex<double> change(step[static_cast<Index>(2 * m)], step[static_cast<Index>(2 * m) + 1]);
      const double most = kLargestStep * std::abs(poles[m].real());
      if (std::abs(change) > most) change *= most / std::abs(change);
      poles[m] += change;
      largest = std::max(largest, std::abs(change) / std::abs(poles[m]));
    }
    if (largest < kConverged) return linear_fit(data, measured, poles, n_terms);
  }
}

/// Square root F of a covariance, F Fᵀ. @param covariance  symmetric, not negative
MatrixXd root_of(const MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

/// Residuals as noise would have them: those of a line are smaller the more the linear parameters follow that line (HC3).
MatrixXd noise_of(const LinearFit& fit) {
  constexpr double least = 1e-3;  // [-] of a line that the model follows exactly
  const VectorXd free = (1.0 - fit.q.rowwise().squaredNorm().array()).max(least);
  return free.cwiseInverse().asDiagonal() * fit.residuals;
}

/// Covariance of the poles [(rad/s)²], real and imaginary part of each in turn.
MatrixXd pole_covariance(const LinearFit& fit, const MatrixXd& noise) {
  const MatrixXd projected = outside(fit), inverse = inverse_of(normal_equations(fit, projected).first);
  MatrixXd middle = MatrixXd::Zero(inverse.rows(), inverse.cols());
  for (Index j = 0; j < noise.cols(); ++j) {
    const double w = fit.weights[j] * fit.weights[j];
    const MatrixXd scores = (w * noise.col(j)).asDiagonal() * times_residues(projected, fit, j);
    middle.noalias() += scores.transpose() * scores;
  }
  return inverse * middle * inverse;
}

/// The shape of a mode and the map from a change of its residues at input i to that of the shape: a product with to_shape[i].
struct ModeShape {
  Eigen::VectorXcd shape, to_shape;
};

ModeShape shape_of(const LinearFit& fit, Index mode, Index n_inputs) {
  MatrixXcd residues(fit.linear.cols() / n_inputs, n_inputs);
  for (Index j = 0; j < fit.linear.cols(); ++j) residues(j / n_inputs, j % n_inputs) = fit.residue(mode, j);
  const Eigen::JacobiSVD<MatrixXcd> svd(residues, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXcd left = svd.matrixU().col(0), turned = normalised_shape(left);
  const std::complex<double> turn = left.dot(turned);
  return {turned, svd.matrixV().col(0) * (turn / std::max(svd.singularValues()[0], 1e-300))};
}

/// The deviation of a mode. @param roots  of the poles' covariance
ModeDeviation deviation_in(const LinearFit& fit, const MatrixXd& noise, const MatrixXd& roots, const ModeShape& shape,
                           std::complex<double> pole, Index mode) {
  const Index n_outputs = shape.shape.size(), n_inputs = shape.to_shape.size(), n_poles = roots.rows();
  MatrixXd factor = MatrixXd::Zero(2 + 2 * n_outputs, n_poles + 2 * n_outputs);
  const double size = std::abs(pole), re = pole.real(), im = pole.imag();
  Eigen::Matrix2d gradient;  // of frequency and damping ratio by real and imaginary part
  gradient << re / (2.0 * pi * size), im / (2.0 * pi * size), -im * im / (size * size * size), re * im / (size * size * size);
  factor.topLeftCorner(2, n_poles) = gradient * roots.middleRows(2 * mode, 2);
  const MatrixXd follow = fit.inverse.middleRows(2 * mode, 2);
  const MatrixXd by_slopes = follow * fit.slopes;
  for (Index o = 0; o < n_outputs; ++o) {
    MatrixXd by_poles = MatrixXd::Zero(2, n_poles), covariance = MatrixXd::Zero(2, 2);
    for (Index i = 0; i < n_inputs; ++i) {
      const Eigen::Matrix2d turn = product_with(shape.to_shape[i]);
      by_poles -= turn * times_residues(by_slopes, fit, o * n_inputs + i);
      const MatrixXd own = turn * follow * noise.col(o * n_inputs + i).asDiagonal();
      covariance += own * own.transpose();
    }
    MatrixXd rows(2, factor.cols());
    rows << by_poles * roots, MatrixXd::Zero(2, 2 * n_outputs);
    rows.middleCols(n_poles + 2 * o, 2) = root_of(covariance);
    factor.row(2 + o) = rows.row(0);
    factor.row(2 + n_outputs + o) = rows.row(1);
  }
  return deviation_of_factor(std::move(factor));
}

/// Adds the change of a mode that other residual terms bring.
void add_change(FittedMode& mode, std::complex<double> pole, const Eigen::VectorXcd& shape) {
  const auto damping = [](std::complex<double> p) { return -p.real() / std::abs(p); };
  ModeDeviation& deviation = mode.deviation;
  deviation.frequency_Hz = std::hypot(deviation.frequency_Hz, (std::abs(pole) - std::abs(mode.eigenvalue)) / (2.0 * pi));
  deviation.damping_ratio = std::hypot(deviation.damping_ratio, damping(pole) - damping(mode.eigenvalue));
  const std::complex<double> along = shape.dot(mode.shape);
  const Eigen::VectorXcd off = mode.shape - shape * (along / std::max(std::abs(along), 1e-300));
  deviation.shape_real = (deviation.shape_real.array().square() + off.real().array().square()).sqrt();
  deviation.shape_imag = (deviation.shape_imag.array().square() + off.imag().array().square()).sqrt();
}

}  // namespace

std::vector<FittedMode> fit_modes(const ResponseData& data, Poles start) {
  TWINDECK_ASSERT(!start.empty() && data.values.rows() == data.frequency_Hz.size());
  const MatrixXd measured = stacked(data.values);
  const LinearFit fit = converge(data, measured, start, kResidualPowers.size());
  const MatrixXd noise = noise_of(fit), roots = root_of(pole_covariance(fit, noise));
  Poles simpler = start;
  const LinearFit simple_fit = converge(data, measured, simpler, kResidualPowers.size() / 2);
  std::vector<FittedMode> modes;
  for (std::size_t m = 0; m < start.size(); ++m) {
    const auto at = static_cast<Index>(m);
    const ModeShape shape = shape_of(fit, at, data.n_inputs);
    modes.push_back({start[m], shape.shape, deviation_in(fit, noise, roots, shape, start[m], at)});
    add_change(modes.back(), simpler[m], shape_of(simple_fit, at, data.n_inputs).shape);
  }
  return modes;
}

}  // namespace twindeck::identification
