#include "identification/efdd.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace twindeck::identification {

using Eigen::Index;
using std::numbers::pi;

SingularSpectra singular_spectra(const signal::CrossSpectra& spectra, Index n_values) {
  const Index n = spectra.frequency_Hz.size(), l = spectra.density.front().rows();
  SingularSpectra result{spectra.frequency_Hz, Eigen::MatrixXd(n, std::min(n_values, l)), Eigen::MatrixXcd(l, n)};
  for (Index f = 0; f < n; ++f) {
    // A cross spectral matrix is Hermitian and not negative: its eigenvalues are its singular values.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> eigen(spectra.density[static_cast<std::size_t>(f)]);
    for (Index k = 0; k < result.values.cols(); ++k) result.values(f, k) = std::max(0.0, eigen.eigenvalues()[l - 1 - k]);
    result.first_vectors.col(f) = eigen.eigenvectors().col(l - 1);
  }
  return result;
}

namespace {

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const Eigen::Map<const Eigen::ArrayXd> u(x.data(), static_cast<Index>(x.size())), v(y.data(), static_cast<Index>(y.size()));
  return ((u - u.mean()) * (v - v.mean())).sum() / (u - u.mean()).square().sum();
}

}  // namespace

EfddMode efdd(const SingularSpectra& spectra, double frequency_Hz, double search, double mac) {
  EfddMode mode;
  const Eigen::VectorXd& f = spectra.frequency_Hz;
  if (f.size() < 8) return mode;
  const double line = f[1] - f[0], reach = std::max(search * frequency_Hz, 1.5 * line);
  Index peak = -1;
  for (Index i = 1; i + 1 < f.size(); ++i)
    if (std::abs(f[i] - frequency_Hz) <= reach && (peak < 0 || spectra.values(i, 0) > spectra.values(peak, 0))) peak = i;
  if (peak < 0) return mode;
  const Eigen::VectorXcd reference = spectra.first_vectors.col(peak);
  const auto alike = [&](Index i) { return std::norm(reference.dot(spectra.first_vectors.col(i))) >= mac; };
  Index low = peak, high = peak;
  while (low > 1 && alike(low - 1)) --low;
  while (high + 1 < f.size() && alike(high + 1)) ++high;
  if (high - low < 4) return mode;
  // Analytic decay of the bell, r(t) = sum S exp(2 pi i (f - f_peak) t), slow enough to be read at a few hundred instants.
  std::vector<double> time, log_envelope, phase;
  const double duration = 1.0 / line, step = duration / 2000.0;
  double start = 0.0, before = 0.0, turns = 0.0;
  for (int k = 0; k < 1000; ++k) {
    std::complex<double> r = 0.0;
    for (Index i = low; i <= high; ++i) r += spectra.values(i, 0) * std::polar(1.0, 2.0 * pi * (f[i] - f[peak]) * k * step);
    if (k == 0) start = std::abs(r);
    const double angle = std::arg(r);
    turns += k == 0 ? 0.0 : std::remainder(angle - before, 2.0 * pi);
    before = angle;
    const double level = std::abs(r) / start;
    if (level < 0.3) break;
    if (level > 0.9) continue;
    time.push_back(k * step);
    log_envelope.push_back(std::log(level));
    phase.push_back(turns);
  }
  if (time.size() < 5) return mode;
  const double damped = 2.0 * pi * f[peak] + slope(time, phase), decay = slope(time, log_envelope),
               omega = std::hypot(damped, decay);
  mode.found = decay < 0.0;
  mode.frequency_Hz = omega / (2.0 * pi);
  mode.damping_ratio = -decay / omega;
  mode.shape = reference;
  return mode;
}

}  // namespace twindeck::identification
