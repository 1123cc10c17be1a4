#include "identification/plscf.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::identification {

using Eigen::Index;
using Eigen::MatrixXcd;
using std::numbers::pi;

namespace {

constexpr double kShareOfCircle = 0.9;  ///< [-] of the circle that the band takes; the rest keeps its two ends apart

/// Sums over the lines of z^d, z^d H_o and z^d H^H H for d = -p … p, from which all normal equations are made.
struct Moments {
  Index most = 0, n_inputs = 0;
  Eigen::VectorXcd one = {};            ///< (2 most + 1)
  std::vector<MatrixXcd> outputs = {};  ///< one an output, (2 most + 1 × n_inputs)
  std::vector<MatrixXcd> squares = {};  ///< [d + most] (n_inputs × n_inputs)

  [[nodiscard]] std::complex<double> power(Index d) const { return one[d + most]; }
};

Moments moments_of(const Eigen::VectorXcd& z, const MatrixXcd& values, Index n_inputs, Index most) {
  Moments m{.most = most, .n_inputs = n_inputs};
  m.squares.assign(static_cast<std::size_t>(2 * most + 1), MatrixXcd::Zero(n_inputs, n_inputs));
  MatrixXcd powers(z.size(), 2 * most + 1);
  powers.col(most).setOnes();
  for (Index d = 1; d <= most; ++d) {
    powers.col(most + d) = powers.col(most + d - 1).cwiseProduct(z);
    powers.col(most - d) = powers.col(most + d).conjugate();
  }
  m.one = powers.colwise().sum();
  const Index n_outputs = values.cols() / n_inputs;
  for (Index o = 0; o < n_outputs; ++o) m.outputs.emplace_back(powers.transpose() * values.middleCols(o * n_inputs, n_inputs));
  for (Index i = 0; i < n_inputs; ++i)
    for (Index j = 0; j < n_inputs; ++j) {
      Eigen::VectorXcd products = Eigen::VectorXcd::Zero(z.size());
      for (Index o = 0; o < n_outputs; ++o)
        products += values.col(o * n_inputs + i).conjugate().cwiseProduct(values.col(o * n_inputs + j));
      const Eigen::VectorXcd sums = powers.transpose() * products;
      for (Index d = 0; d <= 2 * most; ++d) m.squares[static_cast<std::size_t>(d)](i, j) = sums[d];
    }
  return m;
}

/// Sum over the lines of conj(z^a) z^b H_o: block row a, block column b.
MatrixXcd cross_of(const Moments& m, const MatrixXcd& output, Index p) {
  MatrixXcd s(p + 1, (p + 1) * m.n_inputs);
  for (Index a = 0; a <= p; ++a)
    for (Index b = 0; b <= p; ++b) s.block(a, b * m.n_inputs, 1, m.n_inputs) = output.row(b - a + m.most);
  return s;
}

/// The model of one order: A's coefficients one below the other, and the inverse of the basis' Gram matrix.
struct Fraction {
  MatrixXcd a;     ///< ((p + 1) n_inputs × n_inputs), A_0 = I first
  MatrixXcd gram;  ///< (p + 1 × p + 1) inverse
};

Fraction fraction_of(const Moments& m, Index p) {
  const Index n = m.n_inputs;
  MatrixXcd gram(p + 1, p + 1), normal((p + 1) * n, (p + 1) * n);
  for (Index a = 0; a <= p; ++a)
    for (Index b = 0; b <= p; ++b) {
      gram(a, b) = m.power(b - a);
      normal.block(a * n, b * n, n, n) = m.squares[static_cast<std::size_t>(b - a + m.most)];
    }
  const Eigen::LLT<MatrixXcd> factor(gram);
  for (const MatrixXcd& output : m.outputs) {
    const MatrixXcd half = factor.matrixL().solve(cross_of(m, output, p));
    normal.noalias() -= half.adjoint() * half;
  }
  Fraction fraction{MatrixXcd((p + 1) * n, n), factor.solve(MatrixXcd::Identity(p + 1, p + 1))};
  fraction.a.topRows(n).setIdentity();
  fraction.a.bottomRows(p * n) =
      -normal.bottomRightCorner(p * n, p * n).partialPivLu().solve(normal.bottomLeftCorner(p * n, n));
  return fraction;
}

/// Shapes B(z) v, with B = gram^-1 S A from the least squares of each output.
Eigen::VectorXcd shape_at(const Moments& m, const Fraction& fraction, std::complex<double> z, const Eigen::VectorXcd& v) {
  const Index p = fraction.gram.rows() - 1;
  Eigen::RowVectorXcd powers(p + 1);
  for (Index k = 0; k <= p; ++k) powers[k] = std::pow(z, static_cast<double>(k));
  const Eigen::RowVectorXcd left = powers * fraction.gram;
  const Eigen::VectorXcd right = fraction.a * v;  // the vectors A_k v, one below the other
  const MatrixXcd blocks = Eigen::Map<const MatrixXcd>(right.data(), m.n_inputs, p + 1);
  MatrixXcd weights = MatrixXcd::Zero(2 * m.most + 1, m.n_inputs);  // of the sums of each output
  for (Index a = 0; a <= p; ++a)
    for (Index b = 0; b <= p; ++b) weights.row(b - a + m.most) += left[a] * blocks.col(b).transpose();
  Eigen::VectorXcd shape(std::ssize(m.outputs));
  for (Index o = 0; o < shape.size(); ++o) shape[o] = m.outputs[static_cast<std::size_t>(o)].cwiseProduct(weights).sum();
  return shape;
}

std::vector<Pole> poles_of_order(const Moments& m, int order, double first_rad_s, double step_s) {
  const Index p = order / 2, n = m.n_inputs;
  const Fraction fraction = fraction_of(m, p);
  // With mu = 1/z the polynomial is monic: mu^p + A_1 mu^(p-1) + … + A_p.
  MatrixXcd companion = MatrixXcd::Zero(p * n, p * n);
  for (Index k = 0; k < p; ++k) companion.block(0, k * n, n, n) = -fraction.a.middleRows((k + 1) * n, n);
  companion.bottomLeftCorner((p - 1) * n, (p - 1) * n).setIdentity();
  const Eigen::ComplexEigenSolver<MatrixXcd> eigen(companion);
  std::vector<Pole> poles;
  if (eigen.info() != Eigen::Success) return poles;
  for (Index r = 0; r < p * n; ++r) {
    const std::complex<double> mu = eigen.eigenvalues()[r];
    if (!(std::abs(mu) > 1.0)) continue;  // unstable
    const double angle = std::arg(1.0 / mu);
    Pole pole;
    pole.order = order;
    pole.eigenvalue = {-std::log(std::abs(mu)) / step_s, first_rad_s + (angle < 0.0 ? angle + 2.0 * pi : angle) / step_s};
    pole.frequency_Hz = std::abs(pole.eigenvalue) / (2.0 * pi);
    pole.damping_ratio = -pole.eigenvalue.real() / std::abs(pole.eigenvalue);
    const Eigen::VectorXcd shape = shape_at(m, fraction, 1.0 / mu, eigen.eigenvectors().col(r).tail(n));
    if (!(shape.norm() > 0.0) || !std::isfinite(shape.norm())) continue;
    pole.shape = normalised_shape(shape);
    poles.push_back(std::move(pole));
  }
  std::ranges::sort(poles, {}, &Pole::frequency_Hz);
  return poles;
}

}  // namespace

std::vector<std::vector<Pole>> plscf_poles(const Eigen::VectorXd& frequency_Hz, const MatrixXcd& values, Index n_inputs,
                                           const std::vector<int>& orders) {
  TWINDECK_ASSERT(frequency_Hz.size() == values.rows() && values.cols() % n_inputs == 0 && !orders.empty());
  TWINDECK_ASSERT(orders.back() / 2 < frequency_Hz.size());
  const double first = 2.0 * pi * frequency_Hz[0];
  const double step = kShareOfCircle / (frequency_Hz[frequency_Hz.size() - 1] - frequency_Hz[0]);
  Eigen::VectorXcd z(frequency_Hz.size());
  for (Index k = 0; k < z.size(); ++k) z[k] = std::polar(1.0, (2.0 * pi * frequency_Hz[k] - first) * step);
  const Moments moments = moments_of(z, values, n_inputs, orders.back() / 2);
  return each_of(orders, [&](int order) { return poles_of_order(moments, order, first, step); });
}

}  // namespace twindeck::identification
