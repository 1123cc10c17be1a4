#include "diagnosis/reduction/structure_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace twindeck::diagnosis {

std::complex<double> jenkins_stiffness(double stiffness, double threshold_N, double amplitude_m) {
  const double yield = threshold_N / stiffness;
  if (amplitude_m <= yield) return stiffness;
  const double t = std::acos(1.0 - 2.0 * yield / amplitude_m);
  return {stiffness / std::numbers::pi * (t - 0.5 * std::sin(2.0 * t)),
          4.0 * threshold_N / (std::numbers::pi * amplitude_m) * (1.0 - yield / amplitude_m)};
}

std::complex<double> sliding_stiffness(double stiffness, double threshold_N, double damping, double omega, double amplitude_m) {
  if (damping <= 0.0) return jenkins_stiffness(stiffness, threshold_N, amplitude_m);
  // Balance of the first harmonic at the slider, amplitude Y:  (k Y)² + (c omega Y + 4 F_c/pi)² = (k X)².
  const double held = 4.0 * threshold_N / std::numbers::pi;
  if (stiffness * amplitude_m <= held) return stiffness;
  const double a = stiffness * stiffness + std::pow(damping * omega, 2), b = damping * omega * held;
  const double c = held * held - std::pow(stiffness * amplitude_m, 2);
  const double slide = (-b + std::sqrt(b * b - a * c)) / a;
  const std::complex<double> dashpot(0.0, damping * omega + held / slide);
  return stiffness * dashpot / (stiffness + dashpot);
}

std::pair<std::complex<double>, std::complex<double>> dynamic_stiffness(const Attachment& a, std::complex<double> s,
                                                                        double amplitude_m) {
  switch (a.kind) {
    case Attachment::Kind::dashpot:
      return {a.damping * s, a.damping};
    case Attachment::Kind::maxwell: {
      const std::complex<double> below = a.stiffness + a.damping * s;
      return {a.stiffness * a.damping * s / below, a.stiffness * a.stiffness * a.damping / (below * below)};
    }
    case Attachment::Kind::jenkins:
      return {sliding_stiffness(a.stiffness, a.threshold_N, a.damping, std::abs(s), amplitude_m), 0.0};
  }
  return {0.0, 0.0};
}

std::complex<double> second_derivative(const Attachment& a, std::complex<double> s) {
  if (a.kind != Attachment::Kind::maxwell) return 0.0;
  const std::complex<double> below = a.stiffness + a.damping * s;
  return -2.0 * std::pow(a.stiffness * a.damping, 2) / (below * below * below);
}

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
