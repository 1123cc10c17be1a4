#include "diagnosis/state_modes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace twindeck::diagnosis {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

struct RealModes {
  VectorXd eigenvalue;
  MatrixXd shapes;  // mass-normalised
};

/// K phi = lambda M phi through M phi = (1/lambda) K phi, so that M may be singular.
RealModes real_modes(const MatrixXd& stiffness, const MatrixXd& mass, double highest) {
  MatrixXd k = stiffness;
  double shift = 0.0;
  Eigen::LLT<MatrixXd> factor(k);
  if (factor.info() != Eigen::Success) {  // free as a rigid body
    shift = 1e-7 * k.trace() / mass.trace();
    k += shift * mass;
    factor.compute(k);
  }
  const MatrixXd half = factor.matrixL().solve(mass);
  MatrixXd a = factor.matrixL().solve(half.transpose());
  a = (0.5 * (a + a.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(a);
  RealModes modes;
  const Index n = a.rows();
  Index count = 0;
  const double least = 1.0 / (highest + shift);
  while (count < n && eigen.eigenvalues()[n - 1 - count] > least) ++count;
  modes.eigenvalue.resize(count);
  modes.shapes.resize(n, count);
  for (Index i = 0; i < count; ++i) {
    const double mu = eigen.eigenvalues()[n - 1 - i];
    modes.eigenvalue[i] = std::max(1.0 / mu - shift, 0.0);
    modes.shapes.col(i) = factor.matrixU().solve(eigen.eigenvectors().col(n - 1 - i)) / std::sqrt(mu);
  }
  return modes;
}

/// d(s, X) and its derivative in s.
std::pair<Complex, Complex> dynamic_stiffness(const Attachment& a, Complex s, double amplitude) {
  switch (a.kind) {
    case Attachment::Kind::dashpot:
      return {a.damping * s, a.damping};
    case Attachment::Kind::maxwell: {
      const Complex below = a.stiffness + a.damping * s;
      return {a.stiffness * a.damping * s / below, a.stiffness * a.stiffness * a.damping / (below * below)};
    }
    case Attachment::Kind::jenkins:
      return {sliding_stiffness(a.stiffness, a.threshold_N, a.damping, std::abs(s), amplitude), 0.0};
  }
  return {0.0, 0.0};
}

/// Peak amplitude of b'u in a mode whose RMS at the amplitude's channel is known.
double peak(const StructureState& state, const VectorXcd& phi, const VectorXd& b) {
  if (state.amplitude_row.size() == 0 || !(state.amplitude_m > 0.0)) return 0.0;
  const double there = std::abs((state.amplitude_row.cast<Complex>() * phi)(0));
  const double largest = phi.cwiseAbs().maxCoeff();
  // A mode that hardly moves the channel cannot be scaled by it: at most 50 times the channel's amplitude.
  const double here = std::abs((b.cast<Complex>().transpose() * phi)(0));
  return std::sqrt(2.0) * state.amplitude_m * std::min(here / std::max(there, 1e-12 * largest), 50.0);
}

/// T(s) and T'(s) with attachments at the amplitudes of phi.
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

/// Eigenvalues and shapes of the linear part in modal coordinates (dashpots, Maxwell; friction as given spring and dashpot).
StateModes state_space(const StructureState& state, const RealModes& modes, const std::vector<Complex>& friction,
                       double omega) {
  const Index m = modes.eigenvalue.size();
  Index extra = 0;
  for (const Attachment& a : state.attachments)
    if (a.kind == Attachment::Kind::maxwell) ++extra;
  MatrixXd system = MatrixXd::Zero(2 * m + extra, 2 * m + extra);
  system.topRightCorner(m, m + extra).leftCols(m).setIdentity();
  system.block(m, 0, m, m).diagonal() = -modes.eigenvalue;
  Index z = 2 * m;
  std::size_t slider = 0;
  for (const Attachment& a : state.attachments) {
    const VectorXd b = modes.shapes.transpose() * a.direction;
    if (a.kind == Attachment::Kind::dashpot) {
      system.block(m, m, m, m) -= a.damping * b * b.transpose();
    } else if (a.kind == Attachment::Kind::maxwell) {  // force k (b'u - z), c dz/dt = k (b'u - z)
      system.block(m, 0, m, m) -= a.stiffness * b * b.transpose();
      system.block(m, z, m, 1) += a.stiffness * b;
      system.block(z, 0, 1, m) = a.stiffness / a.damping * b.transpose();
      system(z, z) = -a.stiffness / a.damping;
      ++z;
    } else {
      const Complex d = friction[slider++];
      system.block(m, 0, m, m) -= d.real() * b * b.transpose();
      system.block(m, m, m, m) -= d.imag() / omega * b * b.transpose();
    }
  }
  const Eigen::EigenSolver<MatrixXd> eigen(system);
  std::vector<Index> kept;
  for (Index i = 0; i < system.rows(); ++i) {
    const Complex s = eigen.eigenvalues()[i];
    if (s.imag() > 1e-6 && -s.real() < 0.6 * std::abs(s)) kept.push_back(i);
  }
  std::sort(kept.begin(), kept.end(),
            [&](Index a, Index b) { return std::abs(eigen.eigenvalues()[a]) < std::abs(eigen.eigenvalues()[b]); });
  StateModes out;
  out.s.resize(static_cast<Index>(kept.size()));
  out.shapes.resize(modes.shapes.rows(), out.s.size());
  for (Index i = 0; i < out.s.size(); ++i) {
    const Index k = kept[static_cast<std::size_t>(i)];
    out.s[i] = eigen.eigenvalues()[k];
    out.shapes.col(i) = modes.shapes.cast<Complex>() * eigen.eigenvectors().col(k).head(m);
  }
  return out;
}

void refine(const StructureState& state, Complex& s, VectorXcd& phi) {
  MatrixXcd t;
  VectorXcd t_prime_phi;
  for (int iteration = 0; iteration < 8; ++iteration) {
    dynamic_matrices(state, s, phi, t, t_prime_phi);
    const Complex step = (phi.transpose() * (t * phi))(0) / (phi.transpose() * t_prime_phi)(0);
    s -= step;
    if (iteration > 1 && std::abs(step) < 1e-9 * std::abs(s)) break;
    const VectorXcd y = t.partialPivLu().solve(t_prime_phi);
    if (y.allFinite()) phi = y / y.norm();
  }
}

bool oscillates(Complex s) {
  return std::isfinite(s.real()) && std::isfinite(s.imag()) && s.imag() > 0.0 && -s.real() <= 0.6 * std::abs(s);
}

bool same_mode(const std::pair<Complex, VectorXcd>& other, Complex s, const VectorXcd& phi) {
  return std::abs(other.first - s) < 1e-6 * std::abs(s) &&
         std::abs(other.second.dot(phi)) > 0.999 * other.second.norm() * phi.norm();
}

/// In ascending frequency, scaled to phi' T'(s) phi = 2 s.
StateModes normalised(const StructureState& state, std::vector<std::pair<Complex, VectorXcd>> found) {
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return std::abs(a.first) < std::abs(b.first); });
  StateModes modes;
  modes.s.resize(static_cast<Index>(found.size()));
  modes.shapes.resize(state.stiffness.rows(), modes.s.size());
  MatrixXcd t;
  VectorXcd t_prime_phi;
  for (Index i = 0; i < modes.s.size(); ++i) {
    const auto& [s, phi] = found[static_cast<std::size_t>(i)];
    dynamic_matrices(state, s, phi, t, t_prime_phi);
    modes.s[i] = s;
    modes.shapes.col(i) = phi / std::sqrt((phi.transpose() * t_prime_phi)(0) / (2.0 * s));
  }
  return modes;
}

}  // namespace

double StateModes::frequency_Hz(Index i) const { return std::abs(s[i]) / (2.0 * std::numbers::pi); }
double StateModes::damping(Index i) const { return -s[i].real() / std::abs(s[i]); }

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

StateModes solve_state(const StructureState& state, double highest_Hz) {
  const double highest = std::pow(2.0 * std::numbers::pi * highest_Hz, 2);
  if (!state.damped()) {
    const RealModes real = real_modes(state.stiffness, state.mass, highest);
    StateModes modes;
    modes.s.resize(real.eigenvalue.size());
    for (Index i = 0; i < modes.s.size(); ++i) modes.s[i] = Complex(0.0, std::sqrt(real.eigenvalue[i]));
    modes.shapes = real.shapes.cast<Complex>();
    return modes;
  }
  // Friction elements stick in the undamped start, as far as the lowest mode lets them.
  const bool sliders = std::any_of(state.attachments.begin(), state.attachments.end(),
                                   [](const Attachment& a) { return a.kind == Attachment::Kind::jenkins; });
  const RealModes real = real_modes(state.stiffness, state.mass, 6.0 * highest);
  std::vector<Complex> friction;
  double omega = 2.0 * std::numbers::pi * highest_Hz / 3.0;
  for (const Attachment& a : state.attachments)
    if (a.kind == Attachment::Kind::jenkins) friction.push_back(a.stiffness);
  StateModes modes = state_space(state, real, friction, omega);
  if (sliders && modes.s.size() > 0) {
    for (int pass = 0; pass < 2; ++pass) {
      std::size_t k = 0;
      for (const Attachment& a : state.attachments)
        if (a.kind == Attachment::Kind::jenkins)
          friction[k++] = dynamic_stiffness(a, modes.s[0], peak(state, modes.shapes.col(0), a.direction)).first;
      omega = std::abs(modes.s[0]);
      modes = state_space(state, real, friction, omega);
      if (modes.s.size() == 0) return modes;
    }
  }
  std::vector<std::pair<Complex, VectorXcd>> found;
  for (Index i = 0; i < modes.s.size() && modes.frequency_Hz(i) <= 1.1 * highest_Hz; ++i) {
    Complex s = modes.s[i];
    VectorXcd phi = modes.shapes.col(i).normalized();
    refine(state, s, phi);
    if (!oscillates(s)) continue;
    if (std::none_of(found.begin(), found.end(), [&](const auto& other) { return same_mode(other, s, phi); }))
      found.emplace_back(s, phi);
  }
  return normalised(state, found);
}

bool follow_state(const StructureState& state, const StateModes& neighbour, StateModes& modes) {
  const Index n = state.stiffness.rows();
  if (neighbour.shapes.rows() > n) return false;
  std::vector<std::pair<Complex, VectorXcd>> found;
  for (Index i = 0; i < neighbour.s.size(); ++i) {
    Complex s = neighbour.s[i];
    VectorXcd phi = VectorXcd::Zero(n);
    phi.head(neighbour.shapes.rows()) = neighbour.shapes.col(i);
    phi.normalize();
    refine(state, s, phi);
    if (!oscillates(s)) return false;
    if (std::any_of(found.begin(), found.end(), [&](const auto& other) { return same_mode(other, s, phi); })) return false;
    found.emplace_back(s, phi);
  }
  modes = normalised(state, found);
  return true;
}

ModeDerivative differentiate(const StructureState& state, const StateModes& modes, Index mode,
                             const std::vector<MatrixXd>& stiffness, const std::vector<MatrixXd>& mass) {
  const Complex s = modes.s[mode];
  const VectorXcd phi = modes.shapes.col(mode);
  const Index n = phi.size();
  const auto changes = static_cast<Index>(stiffness.size());
  MatrixXcd force = MatrixXcd::Zero(n + 1, changes);
  const VectorXd re = phi.real(), im = phi.imag();
  const bool real = !state.damped();
  for (Index j = 0; j < changes; ++j) {
    const MatrixXd& dk = stiffness[static_cast<std::size_t>(j)];
    const MatrixXd& dm = mass[static_cast<std::size_t>(j)];
    if (dk.size() > 0) {
      force.col(j).head(n).real() -= dk * re;
      if (!real) force.col(j).head(n).imag() -= dk * im;
    }
    if (dm.size() > 0) {
      VectorXcd v(n);
      v.real() = dm * re;
      v.imag() = real ? VectorXd::Zero(n) : VectorXd(dm * im);
      force.col(j).head(n) -= (s * s) * v;
    }
  }
  MatrixXcd t;
  VectorXcd t_prime_phi;
  dynamic_matrices(state, s, phi, t, t_prime_phi);
  ModeDerivative out;
  if (real) {  // everything is real in lambda = -s²: (K - lambda M) dphi - dlambda M phi = -(dK - lambda dM) phi
    MatrixXd bordered(n + 1, n + 1);
    bordered << t.real(), -(state.mass * re), -(state.mass * re).transpose(), 0.0;
    const MatrixXd solution = bordered.partialPivLu().solve(MatrixXd(force.real()));
    out.shapes = solution.topRows(n).cast<Complex>();
    const double omega = s.imag();
    out.s.resize(changes);
    for (Index j = 0; j < changes; ++j) out.s[j] = Complex(0.0, omega > 0.0 ? solution(n, j) / (2.0 * omega) : 0.0);
    return out;
  }
  MatrixXcd bordered(n + 1, n + 1);
  bordered.topLeftCorner(n, n) = t;
  bordered.topRightCorner(n, 1) = t_prime_phi;
  bordered.bottomLeftCorner(1, n) = t_prime_phi.transpose();
  bordered(n, n) = 0.0;
  const MatrixXcd solution = bordered.partialPivLu().solve(force);
  out.shapes = solution.topRows(n);
  out.s = solution.row(n).transpose();
  return out;
}

}  // namespace twindeck::diagnosis
