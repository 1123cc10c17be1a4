#include "diagnosis/reduction/structure_state.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace twindeck::diagnosis {

namespace {

using Complex = std::complex<double>;

}  // namespace

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

double peak(const StructureState& state, Complex here, Complex there) {
  return std::sqrt(2.0) * state.amplitude_m * std::min(std::abs(here) / std::max(std::abs(there), 1e-300), 50.0);
}

Complex along(const Eigen::Ref<const VectorXd>& b, const VectorXcd& phi) { return {b.dot(phi.real()), b.dot(phi.imag())}; }

double peak(const StructureState& state, const VectorXcd& phi, const VectorXd& b) {
  if (state.amplitude_row.size() == 0 || !(state.amplitude_m > 0.0)) return 0.0;
  return peak(state, along(b, phi), along(state.amplitude_row.transpose(), phi));
}

void dynamic_matrices(const StructureState& state, Complex s, const VectorXcd& phi, MatrixXcd& t, VectorXcd& t_prime_phi) {
  const Complex square = s * s;
  const Index n = state.mass.rows();
  t.resize(n, n);
  MatrixXd re = square.real() * state.mass + state.stiffness, im = square.imag() * state.mass;
  t_prime_phi.resize(n);
  t_prime_phi.real() = state.mass * phi.real();
  t_prime_phi.imag() = state.mass * phi.imag();
  t_prime_phi *= 2.0 * s;
  const auto count = static_cast<Index>(state.attachments.size());
  if (count > 0) {
    MatrixXd b(n, count);
    VectorXcd d(count), d_prime(count);
    for (Index k = 0; k < count; ++k) {
      const Attachment& a = state.attachments[static_cast<std::size_t>(k)];
      b.col(k) = a.direction;
      std::tie(d[k], d_prime[k]) =
          dynamic_stiffness(a, s, a.kind == Attachment::Kind::jenkins ? peak(state, phi, a.direction) : 0.0);
    }
    re.noalias() += (b * d.real().asDiagonal()) * b.transpose();
    im.noalias() += (b * d.imag().asDiagonal()) * b.transpose();
    VectorXcd there(count);
    there.real() = b.transpose() * phi.real();
    there.imag() = b.transpose() * phi.imag();
    there = there.cwiseProduct(d_prime).eval();
    t_prime_phi.real() += b * there.real();
    t_prime_phi.imag() += b * there.imag();
  }
  t.real() = re;
  t.imag() = im;
}

}  // namespace twindeck::diagnosis
