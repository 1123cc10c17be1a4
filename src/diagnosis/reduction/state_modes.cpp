#include "diagnosis/reduction/state_modes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "linalg/dense.hpp"

namespace twindeck::diagnosis {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

Index count_below(const UndampedModes& modes, double highest) {
  Index count = 0;
  while (count < modes.size() && modes.eigenvalue(count) < highest) ++count;
  return count;
}

MatrixXd mass_normalised(const UndampedModes& modes, Index count) {
  return modes.shapes.leftCols(count) * modes.mu.head(count).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Eigenvalues and shapes of the linear part in modal coordinates (dashpots, Maxwell; friction as a given spring and dashpot).
StateModes state_space(const StructureState& state, const UndampedModes& undamped, double highest,
                       const std::vector<Complex>& friction, double omega) {
  const Index m = count_below(undamped, highest);
  if (m == 0) return {};  // no mode below the limit; the eigensolver takes no empty matrix
  const MatrixXd shapes = mass_normalised(undamped, m);
  Index extra = 0;
  for (const Attachment& a : state.attachments)
    if (a.kind == Attachment::Kind::maxwell) ++extra;
  MatrixXd system = MatrixXd::Zero(2 * m + extra, 2 * m + extra);
  system.topRightCorner(m, m + extra).leftCols(m).setIdentity();
  for (Index i = 0; i < m; ++i) system(m + i, i) = -undamped.eigenvalue(i);
  Index z = 2 * m;
  std::size_t slider = 0;
  for (const Attachment& a : state.attachments) {
    const VectorXd b = shapes.transpose() * a.direction;
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
  const linalg::UnsymmetricEigen eigen = linalg::unsymmetric_eigen(std::move(system));
  std::vector<Index> kept;
  for (Index i = 0; i < eigen.values.size(); ++i) {
    const Complex s = eigen.values[i];
    if (s.imag() > 1e-6 && -s.real() < 0.6 * std::abs(s)) kept.push_back(i);
  }
  std::ranges::sort(kept, [&](Index a, Index b) { return std::abs(eigen.values[a]) < std::abs(eigen.values[b]); });
  StateModes out;
  out.s.resize(static_cast<Index>(kept.size()));
  out.shapes.resize(shapes.rows(), out.s.size());
  for (Index i = 0; i < out.s.size(); ++i) {
    const Index k = kept[static_cast<std::size_t>(i)];
    out.s[i] = eigen.values[k];
    out.shapes.col(i) = shapes.cast<Complex>() * eigen.vectors.col(k).head(m);
  }
  return out;
}

/// [-] Part of a slider's change of stiffness that one step takes, in successive attempts. With full steps, strokes near the
/// slip oscillate.
constexpr double kRelaxed[] = {1.0, 0.25, 0.06};
/// [-] Relative last step of a root: the aim of the search, and the largest for a valid mode. Strokes near the slip may
/// oscillate without end; a thousandth is below the accuracy of measurements. Two roots of one shape count as one if they are
/// nearer than this.
constexpr double kRefined = 1e-9, kStillAMode = 1e-3;
constexpr double kRefinements = 40.0;  ///< steps of an attempt with full steps; more in proportion for smaller steps

/// Inverse iteration from s and phi, with the part `relax` of each change. @return [-] last relative step of s
double attempt(const StructureState& state, Complex& s, VectorXcd& phi, double relax) {
  MatrixXcd t, now;
  VectorXcd t_prime_phi;
  double last = 1.0;
  for (int iteration = 0; iteration < kRefinements / relax; ++iteration) {
    dynamic_matrices(state, s, phi, now, t_prime_phi);
    const Complex step = (phi.transpose() * (now * phi))(0) / (phi.transpose() * t_prime_phi)(0);
    if (iteration == 0 || relax == 1.0)
      t = now;
    else
      t = relax * now + (1.0 - relax) * t;
    s -= relax * step;
    last = std::abs(step) / std::abs(s);
    if (iteration > 1 && last < kRefined) break;
    const VectorXcd y = linalg::solve(t, t_prime_phi);
    if (y.allFinite()) phi = y / y.norm();
  }
  return last;
}

/// Tries the parts of kRelaxed until an attempt ends at a mode. Later attempts take up to seventeen times as many steps.
/// @return whether an attempt succeeded
bool refine(const StructureState& state, Complex& s, VectorXcd& phi) {
  const Complex start = s;
  const VectorXcd start_shape = phi;
  for (const double relax : kRelaxed) {
    s = start;
    phi = start_shape;
    if (attempt(state, s, phi, relax) < kStillAMode) return true;
  }
  return false;
}

bool oscillates(Complex s) {
  return std::isfinite(s.real()) && std::isfinite(s.imag()) && s.imag() > 0.0 && -s.real() <= 0.6 * std::abs(s);
}

bool same_mode(const std::pair<Complex, VectorXcd>& other, Complex s, const VectorXcd& phi) {
  return std::abs(other.first - s) < kStillAMode * std::abs(s) &&
         std::abs(other.second.dot(phi)) > 0.999 * other.second.norm() * phi.norm();
}

/// Sorts by frequency and scales to phi' T'(s) phi = 2 s.
StateModes normalised(const StructureState& state, std::vector<std::pair<Complex, VectorXcd>> found) {
  std::ranges::sort(found, [](const auto& a, const auto& b) { return std::abs(a.first) < std::abs(b.first); });
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

/// Finds all roots at once from the state space of the undamped modes, then refines each. Slow; used if the roots cannot be
/// followed.
StateModes solve_by_state_space(const StructureState& state, double highest_Hz, const UndampedModes& undamped) {
  // Friction elements stick at first; then they slide as far as the lowest mode makes them.
  const bool sliders =
      std::ranges::any_of(state.attachments, [](const Attachment& a) { return a.kind == Attachment::Kind::jenkins; });
  const double highest = 6.0 * std::pow(2.0 * std::numbers::pi * highest_Hz, 2);
  std::vector<Complex> friction;
  double omega = 2.0 * std::numbers::pi * highest_Hz / 3.0;
  for (const Attachment& a : state.attachments)
    if (a.kind == Attachment::Kind::jenkins) friction.push_back(a.stiffness);
  StateModes modes = state_space(state, undamped, highest, friction, omega);
  if (sliders && modes.s.size() > 0) {
    for (int pass = 0; pass < 2; ++pass) {
      std::size_t k = 0;
      for (const Attachment& a : state.attachments)
        if (a.kind == Attachment::Kind::jenkins)
          friction[k++] = dynamic_stiffness(a, modes.s[0], peak(state, modes.shapes.col(0), a.direction)).first;
      omega = std::abs(modes.s[0]);
      modes = state_space(state, undamped, highest, friction, omega);
      if (modes.s.size() == 0) return modes;
    }
  }
  std::vector<std::pair<Complex, VectorXcd>> found;
  for (Index i = 0; i < modes.s.size() && modes.frequency_Hz(i) <= 1.1 * highest_Hz; ++i) {
    Complex s = modes.s[i];
    VectorXcd phi = modes.shapes.col(i).normalized();
    if (!refine(state, s, phi) || !oscillates(s)) continue;
    if (std::ranges::none_of(found, [&](const auto& other) { return same_mode(other, s, phi); })) found.emplace_back(s, phi);
  }
  return normalised(state, found);
}

/// [-] Relative last step at which the search for a root ends. With sliders, a step is only the part `relax` of the remaining
/// change.
constexpr double kSettled = 1e-10, kSettledStrokes = 1e-8;

/// [-] Least dashpot in the start values, over the dashpot that resists at the lowest frequency as much as the structure does.
/// With weaker ones, their large rate constants would hide the frequencies in rounding.
constexpr double kWeakestStart = 1e-4;
/// [-] of the highest frequency; lower modes are motions as a rigid body.
constexpr double kRigidMotion = 1e-4;

/// Damped modes in the coordinates of the undamped ones, phi = Psi z: T(s) = diag(1 + s² mu) + B D(s) B' for the p directions B
/// of few attachments. A step of residual inverse iteration costs n p² operations, a factorisation of T would cost n³. All
/// modes are used, so that the roots are those of T. Reference: Neumaier (1985), SIAM Journal on Numerical Analysis 22,
/// 914-923.
class ModalRoots {
 public:
  ModalRoots(const StructureState& state, const UndampedModes& modes) : state_(state), modes_(modes) {
    b_.resize(state.stiffness.rows(), static_cast<Index>(state.attachments.size()));
    for (Index k = 0; k < b_.cols(); ++k) {
      const Attachment& a = state.attachments[static_cast<std::size_t>(k)];
      b_.col(k) = a.direction;
      sliders_ = sliders_ || a.kind == Attachment::Kind::jenkins;
    }
    bm_ = linalg::product(modes_.shapes, b_, true);
    if (sliders_ && state.amplitude_row.size() > 0 && state.amplitude_m > 0.0)
      amplitude_ = modes_.shapes.transpose() * state.amplitude_row.transpose();
  }

  /// Follows the roots of a state with the same attachments and other matrices. @return false if a root is lost, or if two end
  /// in one
  bool follow(const StateModes& neighbour, StateModes& out) const {
    // K-orthonormal modes: z = Psi' (K + shift M) phi. Real parts first, then imaginary ones.
    const Index count = neighbour.s.size(), rows = neighbour.shapes.rows();
    MatrixXd phi = MatrixXd::Zero(modes_.size(), 2 * count);
    phi.topLeftCorner(rows, count) = neighbour.shapes.real();
    phi.topRightCorner(rows, count) = neighbour.shapes.imag();
    MatrixXd stiff = linalg::product(state_.stiffness, phi);
    if (modes_.shift != 0.0) stiff += modes_.shift * linalg::product(state_.mass, phi);
    const MatrixXd parts = linalg::product(modes_.shapes, stiff, true);
    Found found;
    for (Index i = 0; i < count; ++i) {
      VectorXcd z(modes_.size());
      z.real() = parts.col(i);
      z.imag() = parts.col(count + i);
      if (!add(neighbour.s[i], z, {}, found, true)) return false;
    }
    gather(found, out);
    return true;
  }

  /// Starts from the eigenvalues of a smaller linear problem: low modes, and the static part of all others. @return false if a
  /// root is lost
  bool solve(double highest_Hz, StateModes& out) const {
    VectorXcd forces = VectorXcd::Zero(b_.cols());
    if (sliders_) {  // friction holds at first; then it slides as the lowest mode makes it
      for (Index k = 0; k < b_.cols(); ++k) forces[k] = state_.attachments[static_cast<std::size_t>(k)].stiffness;
      Found first;
      for (const auto& [s, none] : starts(forces, 2.0 * std::numbers::pi * highest_Hz, false)) {
        if (!add(s, {}, forces, first, false) || first.empty()) continue;
        for (Index k = 0; k < b_.cols(); ++k) {
          const Attachment& a = state_.attachments[static_cast<std::size_t>(k)];
          if (a.kind == Attachment::Kind::jenkins)
            forces[k] = dynamic_stiffness(a, first[0].first, stroke(along(bm_.col(k), first[0].second), first[0].second)).first;
        }
        break;
      }
    }
    // If two modes have nearly one frequency, as equal stays have, starts from the values alone may end at one root. The second
    // pass starts from shapes too. Strokes of sliders depend on the shape, so these start from the values only.
    for (const bool with_shapes : {false, true}) {
      if (with_shapes && sliders_) break;
      Found found;
      const Found all = starts(forces, 2.0 * std::numbers::pi * 1.1 * highest_Hz, with_shapes);
      if (!std::ranges::all_of(all, [&](const auto& start) { return add(start.first, start.second, forces, found, false); }))
        continue;
      gather(found, out);
      return out.s.size() > 0;
    }
    return false;
  }

 private:
  using Found = std::vector<std::pair<Complex, VectorXcd>>;  // roots, and shapes in the modes, scaled like `StateModes`

  /// Refines a root and adds it; roots that no longer vibrate are left out. @return false if a root does not converge, or
  /// appears twice: two modes may have one frequency, and then the state space must separate them. With sliding dampers each
  /// mode has its own stiffnesses. Then two starts may end in the lowest mode, also with the state space, and this is accepted.
  /// @param z       shape in the modes, empty if unknown
  /// @param forces  of sliders [N/m], if the shape is unknown: those for which s is an eigenvalue
  bool add(Complex s, VectorXcd z, const VectorXcd& forces, Found& found, bool must_oscillate) const {
    const Complex start = s;
    bool converged = root(s, z, forces, kRelaxed[0]);
    for (std::size_t i = 1; !converged && i < std::size(kRelaxed); ++i) {
      if (!sliders_ || must_oscillate) return false;
      s = start;
      z.resize(0);
      converged = root(s, z, forces, kRelaxed[i]);
    }
    if (!converged) return false;
    if (!oscillates(s)) return !must_oscillate;
    for (const auto& other : found)
      if (same_mode(other, s, z)) return sliders_ && !must_oscillate;
    found.emplace_back(s, std::move(z));
    return true;
  }

  void gather(Found& found, StateModes& out) const {
    std::ranges::sort(found, [](const auto& a, const auto& c) { return std::abs(a.first) < std::abs(c.first); });
    const Index count = std::ssize(found);
    out.s.resize(count);
    MatrixXd parts(modes_.size(), 2 * count);
    for (Index j = 0; j < count; ++j) {
      const auto& [s, z] = found[static_cast<std::size_t>(j)];
      out.s[j] = s;
      parts.col(j) = z.real();
      parts.col(count + j) = z.imag();
    }
    const MatrixXd shapes = linalg::product(modes_.shapes, parts);
    out.shapes.resize(modes_.size(), count);
    out.shapes.real() = shapes.leftCols(count);
    out.shapes.imag() = shapes.rightCols(count);
  }

  /// Peak amplitude of an element that moves by `here` in a mode of shape z; 0 if no amplitude is known.
  [[nodiscard]] double stroke(Complex here, const VectorXcd& z) const {
    return amplitude_.size() > 0 ? peak(state_, here, along(amplitude_, z)) : 0.0;
  }

  /// Eigenvalues that vibrate, |s| below `highest`, with sliders as springs and dashpots `forces` [N/m]. In the low modes y:
  /// y'' = -Lambda y - B f; each attachment follows the residual flexibility R of the other modes and its own spring: f = (R +
  /// 1/k)^-1 (B'y - z) with z the stroke of its dashpot, c dz/dt = f.
  /// @param with_shapes  also returns the shapes in the low modes; otherwise they are empty
  [[nodiscard]] Found starts(const VectorXcd& forces, double highest, bool with_shapes) const {
    const Index p = b_.cols(), m = count_below(modes_, 1.5 * highest * highest);
    if (m == 0) return {};  // no mode below the limit; the eigensolver takes no empty matrix
    const MatrixXd low = modes_.mu.head(m).cwiseSqrt().cwiseInverse().asDiagonal() * bm_.topRows(m);
    MatrixXd flexibility = bm_.bottomRows(bm_.rows() - m).transpose() * bm_.bottomRows(bm_.rows() - m);
    VectorXd rate = VectorXd::Zero(p), back = VectorXd::Zero(p);  // dz/dt = rate f - back z
    double lowest = highest;
    for (Index i = m - 1; i >= 0 && modes_.eigenvalue(i) > std::pow(kRigidMotion * highest, 2); --i)
      lowest = std::sqrt(modes_.eigenvalue(i));
    for (Index k = 0; k < p; ++k) {
      const Attachment& a = state_.attachments[static_cast<std::size_t>(k)];
      flexibility(k, k) += 1e-6 * bm_.col(k).squaredNorm();
      if (a.kind == Attachment::Kind::jenkins) {
        const double spring = forces[k].real(), dashpot = forces[k].imag();
        if (dashpot > 1e-3 * spring) {  // z is the stroke of spring and dashpot in parallel
          rate[k] = highest / (3.0 * dashpot);
          back[k] = rate[k] * spring;
        } else {
          flexibility(k, k) += 1.0 / spring;
          back[k] = highest;  // z decays to zero: a spring alone
        }
      } else {
        if (a.kind == Attachment::Kind::maxwell) flexibility(k, k) += 1.0 / a.stiffness;
        const double own = bm_.col(k).squaredNorm();
        rate[k] = 1.0 / std::max({a.damping, 1e-9, own > 0.0 ? kWeakestStart / (own * lowest) : 0.0});
      }
    }
    const MatrixXd stiff = flexibility.llt().solve(MatrixXd::Identity(p, p));
    Found roots;
    if (rate.cwiseAbs().maxCoeff() == 0.0) {  // all held: springs
      MatrixXd held = low * stiff * low.transpose();
      for (Index i = 0; i < m; ++i) held(i, i) += modes_.eigenvalue(i);
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(held, Eigen::EigenvaluesOnly);
      for (const double square : eigen.eigenvalues())
        if (square > 1e-12 && square <= highest * highest) roots.emplace_back(Complex(0.0, std::sqrt(square)), VectorXcd());
      return roots;
    }
    MatrixXd system = MatrixXd::Zero(2 * m + p, 2 * m + p);
    system.block(0, m, m, m).setIdentity();
    system.block(m, 0, m, m) = -low * stiff * low.transpose();
    for (Index i = 0; i < m; ++i) system(m + i, i) -= modes_.eigenvalue(i);
    system.block(m, 2 * m, m, p) = low * stiff;
    system.block(2 * m, 0, p, m) = rate.asDiagonal() * stiff * low.transpose();
    system.block(2 * m, 2 * m, p, p) = -(rate.asDiagonal() * stiff);
    system.block(2 * m, 2 * m, p, p).diagonal() -= back;
    const linalg::UnsymmetricEigen eigen = linalg::unsymmetric_eigen(std::move(system), with_shapes);
    for (Index i = 0; i < eigen.values.size(); ++i) {
      const Complex s = eigen.values[i];
      if (!(s.imag() > 1e-6) || !oscillates(s) || std::abs(s) > highest) continue;
      VectorXcd z;
      if (with_shapes) {  // converts from mass-normalised modes to modes of unit stiffness
        z = VectorXcd::Zero(modes_.size());
        z.head(m) = eigen.vectors.col(i).head(m).cwiseQuotient(modes_.mu.head(m).cwiseSqrt().cast<Complex>());
        z.normalize();
      }
      roots.emplace_back(s, std::move(z));
    }
    std::ranges::sort(roots, [](const auto& a, const auto& c) { return std::abs(a.first) < std::abs(c.first); });
    return roots;
  }

  /// T(s)^-1 v in the modes' coordinates: diagonal but for p directions (Woodbury's identity).
  [[nodiscard]] VectorXcd inverse(Complex s, const VectorXcd& d, const VectorXcd& v) const {
    const Index n = modes_.size(), p = b_.cols();
    const Complex square = s * s - modes_.shift;
    VectorXcd receptance(n);
    for (Index i = 0; i < n; ++i) {
      const Complex own = 1.0 + square * modes_.mu[i];
      const double square_of_own = own.real() * own.real() + own.imag() * own.imag();  // faster than std::norm
      receptance[i] = square_of_own > 1e-26 ? std::conj(own) / square_of_own : Complex(1e13);
    }
    MatrixXcd h(p, p);
    MatrixXd scaled = receptance.real().asDiagonal() * bm_;
    h.real() = bm_.transpose() * scaled;
    scaled = receptance.imag().asDiagonal() * bm_;
    h.imag() = bm_.transpose() * scaled;
    h = (h * d.asDiagonal()).eval();
    h.diagonal().array() += 1.0;
    VectorXcd y = receptance.cwiseProduct(v), q(p);
    q.real() = bm_.transpose() * y.real();
    q.imag() = bm_.transpose() * y.imag();
    const VectorXcd f = d.cwiseProduct(VectorXcd(h.partialPivLu().solve(q)));
    VectorXcd back(n);
    back.real() = bm_ * f.real();
    back.imag() = bm_ * f.imag();
    return y - receptance.cwiseProduct(back);
  }

  /// Residual inverse iteration from s, and from z if given, until s is constant.
  /// @param relax  part of the change of the sliders' forces in a step. Strokes and forces may oscillate; if a damper begins to
  ///         slide they do so without end, by about 1e-5
  bool root(Complex& s, VectorXcd& z, const VectorXcd& held, double relax) const {
    const Index p = b_.cols();
    VectorXcd d(p), d_prime(p), q = VectorXcd::Zero(p);
    const auto forces = [&](bool first, double part) {
      for (Index k = 0; k < p; ++k) {
        const Attachment& a = state_.attachments[static_cast<std::size_t>(k)];
        const bool slides = a.kind == Attachment::Kind::jenkins;
        const auto [now, slope] = dynamic_stiffness(a, s, slides && z.size() > 0 ? stroke(q[k], z) : 0.0);
        d[k] = slides && !first ? part * now + (1.0 - part) * d[k] : now;
        d_prime[k] = slope;
      }
    };
    const auto motion = [&] {
      q.real() = bm_.transpose() * z.real();
      q.imag() = bm_.transpose() * z.imag();
    };
    if (z.size() == 0) {
      forces(true, 1.0);
      for (Index k = 0; k < p; ++k)
        if (state_.attachments[static_cast<std::size_t>(k)].kind == Attachment::Kind::jenkins) d[k] = held[k];
      z = VectorXcd::Ones(modes_.size());
      for (int i = 0; i < 2; ++i) z = inverse(s, d, z).normalized();
    } else {
      motion();
      forces(true, 1.0);
    }
    for (int iteration = 0; iteration < (sliders_ ? 60 / relax : 15); ++iteration) {
      motion();
      if (sliders_ || iteration > 0) forces(iteration == 0, iteration > 8 ? std::min(0.4, relax) : relax);
      const Complex mass = (z.array().square() * modes_.mu.array()).sum();
      const Complex value = (z.array().square()).sum() + (s * s - modes_.shift) * mass + (d.array() * q.array().square()).sum();
      const Complex slope = 2.0 * s * mass + (d_prime.array() * q.array().square()).sum();
      Complex step = value / slope;
      if (!std::isfinite(std::abs(step))) return false;
      if (std::abs(step) > 0.5 * std::abs(s)) {
        if (!sliders_) return false;
        step *= 0.1 * std::abs(s / step);  // strokes belong to the start's shape and change with it
      }
      s -= step;
      const bool small = std::abs(step) < (sliders_ ? kSettledStrokes * relax : kSettled) * std::abs(s);
      VectorXcd v = 2.0 * s * z.cwiseProduct(modes_.mu);
      const VectorXcd force = d_prime.cwiseProduct(q);
      v.real() += bm_ * force.real();
      v.imag() += bm_ * force.imag();
      z = inverse(s, d, v).normalized();
      if (!z.allFinite()) return false;
      if (small && iteration > 0) {
        motion();
        const Complex scale =
            2.0 * s * (z.array().square() * modes_.mu.array()).sum() + (d_prime.array() * q.array().square()).sum();
        z /= std::sqrt(scale / (2.0 * s));
        return true;
      }
    }
    return false;
  }

  const StructureState& state_;
  const UndampedModes& modes_;
  MatrixXd b_, bm_;     // directions (n × p) over the coordinates and in the modes
  VectorXd amplitude_;  // motion of the amplitude's channel (n) in the modes; empty if nothing slides or no amplitude is known
  bool sliders_ = false;
};

}  // namespace

double StateModes::frequency_Hz(Index i) const { return std::abs(s[i]) / (2.0 * std::numbers::pi); }
double StateModes::damping(Index i) const { return -s[i].real() / std::abs(s[i]); }

StateModes solve_state(const StructureState& state, double highest_Hz, UndampedStore& store, const StateModes* neighbour) {
  const double highest = std::pow(2.0 * std::numbers::pi * highest_Hz, 2);
  StateModes modes;
  if (!state.damped()) {
    const UndampedModes& undamped = store.of(state.stiffness, state.mass, highest);
    const Index count = count_below(undamped, highest);
    modes.s.resize(count);
    for (Index i = 0; i < count; ++i) modes.s[i] = Complex(0.0, std::sqrt(undamped.eigenvalue(i)));
    modes.shapes = mass_normalised(undamped, count).cast<Complex>();
    return modes;
  }
  const UndampedModes& undamped = store.of(state.stiffness, state.mass);
  const ModalRoots roots(state, undamped);
  if ((neighbour != nullptr && roots.follow(*neighbour, modes)) || roots.solve(highest_Hz, modes)) return modes;
  return solve_by_state_space(state, highest_Hz, undamped);
}

}  // namespace twindeck::diagnosis
