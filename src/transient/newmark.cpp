#include "transient/newmark.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

namespace twindeck::transient {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void add_maxwell(LinearSystem& system, const Eigen::Ref<const VectorXd>& direction, double stiffness_N_m,
                 double damping_N_s_m) {
  TWINDECK_ASSERT(direction.size() <= system.size());
  const Index n = system.size();
  for (MatrixXd* matrix : {&system.mass, &system.damping, &system.stiffness}) {
    matrix->conservativeResize(n + 1, n + 1);
    matrix->row(n).setZero();
    matrix->col(n).setZero();
  }
  VectorXd elongation = VectorXd::Zero(n + 1);
  elongation.head(direction.size()) = direction;
  elongation[n] = -1.0;
  system.stiffness += stiffness_N_m * elongation * elongation.transpose();
  system.damping(n, n) += damping_N_s_m;
}

namespace {

constexpr Index kPanelRows = 16;  ///< sums of a panel stay in registers

/// The same forces as the minimum of 1/2 F' (G + 1/k) F - F' (x_free - x_p) within ±F_c, by active sets. It is strictly convex
/// and each step lowers it, so that no set of sliding units comes twice. @param force  in: any; out: the forces
bool minimise_within_thresholds(const Eigen::VectorXd& shift_N, const Eigen::MatrixXd& stiff_flexibility,
                                const Eigen::VectorXd& limit_N, Eigen::VectorXd& force_N) {
  const Index n = shift_N.size();
  force_N = force_N.cwiseMin(limit_N).cwiseMax(-limit_N);
  std::vector<double> side(static_cast<std::size_t>(n), 0.0);  // +1, -1 where the unit slides
  for (Index i = 0; i < n; ++i)
    if (std::abs(force_N[i]) >= limit_N[i]) side[static_cast<std::size_t>(i)] = std::copysign(1.0, force_N[i]);
  for (Index iteration = 0; iteration < 100 + 20 * n; ++iteration) {
    std::vector<Index> stuck;
    for (Index i = 0; i < n; ++i)
      if (side[static_cast<std::size_t>(i)] == 0.0) stuck.push_back(i);
    // 1. The forces of the stuck units move towards balance, until the first of them reaches its threshold.
    if (!stuck.empty()) {
      const auto size = static_cast<Index>(stuck.size());
      Eigen::VectorXd sliding = force_N;
      sliding(stuck).setZero();
      const Eigen::VectorXd right = (shift_N - stiff_flexibility * sliding)(stuck), from = force_N(stuck);
      const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(size, size) + stiff_flexibility(stuck, stuck);
      const Eigen::VectorXd to = left.partialPivLu().solve(right);
      double step = 1.0;
      Index first = -1;
      for (Index i = 0; i < size; ++i) {
        const double limit = limit_N[stuck[static_cast<std::size_t>(i)]];
        if (std::abs(to[i]) <= limit) continue;
        const double part = (std::copysign(limit, to[i]) - from[i]) / (to[i] - from[i]);
        if (first < 0 || part < step) step = part, first = i;
      }
      force_N(stuck) = Eigen::VectorXd(from + step * (to - from));
      if (first >= 0) {
        const Index at = stuck[static_cast<std::size_t>(first)];
        side[static_cast<std::size_t>(at)] = std::copysign(1.0, to[first]);
        force_N[at] = side[static_cast<std::size_t>(at)] * limit_N[at];
        continue;
      }
    }
    // 2. The sliding unit whose spring asks for least beyond its threshold sticks again.
    const Eigen::VectorXd flexible = stiff_flexibility * force_N, excess = shift_N - flexible - force_N;
    Index release = -1;
    double worst = 0.0;
    for (Index i = 0; i < n; ++i) {
      const double back = -side[static_cast<std::size_t>(i)] * excess[i];
      const double rounding = 1e-12 * (std::abs(shift_N[i]) + std::abs(flexible[i]) + std::abs(force_N[i]));
      if (limit_N[i] > 0.0 && back > rounding && back > worst) worst = back, release = i;
    }
    if (release < 0) return true;
    side[static_cast<std::size_t>(release)] = 0.0;
  }
  return false;
}

}  // namespace

// y -= A x, with A in panels of rows, each by columns. It is compiled for two SIMD widths. Neither fuses products with sums, so
// both give the same bytes. The width is chosen before ThreadSanitizer starts, which would crash: its builds have one width.
#ifndef __SANITIZE_THREAD__
[[gnu::target_clones("avx2", "default")]]
#endif
static void
subtract_product(const double* panels, Index n_panels, Index columns, const double* x, double* y) {
  using Four = double __attribute__((vector_size(32)));
  typedef Four Numbers __attribute__((aligned(8), may_alias));
  const Numbers* a = reinterpret_cast<const Numbers*>(panels);
  for (Index p = 0; p < n_panels; ++p) {
    Four sum0{}, sum1{}, sum2{}, sum3{};
    for (Index c = 0; c < columns; ++c, a += 4) {
      sum0 += x[c] * a[0];
      sum1 += x[c] * a[1];
      sum2 += x[c] * a[2];
      sum3 += x[c] * a[3];
    }
    Numbers* own = reinterpret_cast<Numbers*>(y + kPanelRows * p);
    own[0] -= sum0;
    own[1] -= sum1;
    own[2] -= sum2;
    own[3] -= sum3;
  }
}

Newmark::Newmark(LinearSystem system, double step_s, std::vector<FrictionUnit> friction)
    : system_(std::move(system)), step_s_(step_s), friction_(std::move(friction)) {
  if (!(step_s > 0.0)) throw InputError({"", 0, "time step"}, fmt::format("is {} s, expected a positive number", step_s));
  const Eigen::PartialPivLU<MatrixXd> factor(system_.mass + 0.5 * step_s * system_.damping +
                                             0.25 * step_s * step_s * system_.stiffness);
  if (!(factor.rcond() > 1e-15))
    throw InputError({"", 0, "equations of motion"}, "are singular: a coordinate has neither mass nor damping nor stiffness");
  inverse_ = factor.inverse();
  velocity_ = inverse_ * system_.damping;
  displacement_ = inverse_ * system_.stiffness;
  const Index r = system_.size(), n_panels = (r + kPanelRows - 1) / kPanelRows;
  panels_ = MatrixXd::Zero(kPanelRows, 2 * r * n_panels);
  for (Index p = 0; p < n_panels; ++p) {
    const Index first = p * kPanelRows, rows = std::min(kPanelRows, r - first);
    panels_.block(0, 2 * r * p, rows, r) = velocity_.middleRows(first, rows);
    panels_.block(0, 2 * r * p + r, rows, r) = displacement_.middleRows(first, rows);
  }
  direction_ = MatrixXd::Zero(system_.size(), static_cast<Index>(friction_.size()));
  for (std::size_t i = 0; i < friction_.size(); ++i)
    direction_.col(static_cast<Index>(i)).head(friction_[i].direction.size()) = friction_[i].direction;
  flexibility_ = 0.25 * step_s * step_s * direction_.transpose() * inverse_ * direction_;
}

MatrixXd Newmark::within_a_step(const Eigen::Ref<const MatrixXd>& load) const { return inverse_.leftCols(load.rows()) * load; }

History Newmark::run(const Eigen::Ref<const MatrixXd>& force, const State& initial) const {
  const Index r = system_.size();
  History out;
  out.acceleration = within_a_step(force);  // what the forces alone would do; the rest is added step by step
  const VectorXd q = initial.displacement.size() > 0 ? initial.displacement : VectorXd::Zero(r);
  const VectorXd v = initial.velocity.size() > 0 ? initial.velocity : VectorXd::Zero(r);
  VectorXd first = -system_.damping * v - system_.stiffness * q;
  first.head(force.rows()) += force.col(0);
  integrate(out, q, v, system_.mass.completeOrthogonalDecomposition().solve(first));  // coordinates without mass: none
  return out;
}

void Newmark::advance(Motion& motion, Eigen::Ref<MatrixXd> acceleration) const {
  TWINDECK_ASSERT(friction_.empty() && acceleration.rows() == system_.size());
  const Index r = system_.size();
  const double dt = step_s_;
  if (motion.displacement.size() == 0) motion.displacement = motion.velocity = motion.acceleration = VectorXd::Zero(r);
  auto& [q, v, a] = motion;
  const Index n_panels = panels_.cols() / (2 * r);
  VectorXd predicted(2 * r), found = VectorXd::Zero(kPanelRows * n_panels);  // velocity and displacement; acceleration
  for (Index i = 0; i < acceleration.cols(); ++i) {
    q += dt * v + 0.25 * dt * dt * a;
    v += 0.5 * dt * a;
    predicted << v, q;
    found.head(r) = acceleration.col(i);
    subtract_product(panels_.data(), n_panels, 2 * r, predicted.data(), found.data());
    a = found.head(r);
    acceleration.col(i) = a;
    q += 0.25 * dt * dt * a;
    v += 0.5 * dt * a;
  }
}

void Newmark::integrate(History& out, VectorXd q, VectorXd v, VectorXd a) const {
  const Index r = system_.size(), n = out.acceleration.cols(), units = direction_.cols();
  const double dt = step_s_;
  out.displacement.resize(r, n);
  out.friction_N = MatrixXd::Zero(units, n);
  out.displacement.col(0) = q;
  out.acceleration.col(0) = a;

  VectorXd stiffness(units), threshold(units), plastic = direction_.transpose() * q, friction = VectorXd::Zero(units);
  for (Index i = 0; i < units; ++i) {
    stiffness[i] = friction_[static_cast<std::size_t>(i)].stiffness_N_m;
    threshold[i] = friction_[static_cast<std::size_t>(i)].threshold_N;
  }
  const MatrixXd push = inverse_ * direction_;
  for (Index i = 1; i < n; ++i) {
    q += dt * v + 0.25 * dt * dt * a;  // predictors
    v += 0.5 * dt * a;
    a = out.acceleration.col(i);
    a.noalias() -= velocity_ * v;
    a.noalias() -= displacement_ * q;
    if (units > 0) {
      const VectorXd free = direction_.transpose() * (q + 0.25 * dt * dt * a);
      if (!balance_friction(free, flexibility_, stiffness, threshold, plastic, friction) && out.status.converged)
        out.status = {false, fmt::format("friction found no balance at step {} ({} s)", i, dt * static_cast<double>(i))};
      a.noalias() -= push * friction;
      // where a unit slips, its point of rest follows
      const VectorXd x = free - flexibility_ * friction;
      for (Index u = 0; u < units; ++u)
        if (stiffness[u] > 0.0) plastic[u] = x[u] - friction[u] / stiffness[u];
      out.friction_N.col(i) = friction;
    }
    q += 0.25 * dt * dt * a;
    v += 0.5 * dt * a;
    out.displacement.col(i) = q;
    out.acceleration.col(i) = a;
  }
}

bool balance_friction(const Eigen::Ref<const Eigen::VectorXd>& free_m, const Eigen::Ref<const Eigen::MatrixXd>& flexibility,
                      const Eigen::Ref<const Eigen::VectorXd>& stiffness_N_m,
                      const Eigen::Ref<const Eigen::VectorXd>& threshold_N, const Eigen::Ref<const Eigen::VectorXd>& plastic_m,
                      Eigen::VectorXd& force_N) {
  const Index n = free_m.size();
  std::vector<Index> stuck;
  for (int iteration = 0; iteration < 100; ++iteration) {
    // Which units the trial force of the present guess leaves stuck; the others carry their threshold.
    const Eigen::VectorXd trial = stiffness_N_m.cwiseProduct(free_m - flexibility * force_N - plastic_m);
    Eigen::VectorXd next(n);
    stuck.clear();
    for (Index i = 0; i < n; ++i) {
      if (std::abs(trial[i]) <= threshold_N[i]) {
        stuck.push_back(i);
        next[i] = 0.0;
      } else {
        next[i] = std::copysign(threshold_N[i], trial[i]);
      }
    }
    if (!stuck.empty()) {
      const auto size = static_cast<Index>(stuck.size());
      const Eigen::VectorXd k = stiffness_N_m(stuck);
      const Eigen::VectorXd right = k.cwiseProduct((free_m - plastic_m - flexibility * next)(stuck));
      const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(size, size) + k.asDiagonal() * flexibility(stuck, stuck);
      next(stuck) = Eigen::VectorXd(left.partialPivLu().solve(right));
    }
    const double change = (next - force_N).cwiseAbs().maxCoeff();
    force_N = next;
    if (change <= 1e-10 * std::max(1.0, threshold_N.maxCoeff())) return true;
  }
  // Where springs are stiff beside the structure's own flexibility, k G > 1, the sets may come in a circle.
  const Eigen::VectorXd limit = (stiffness_N_m.array() > 0.0).select(threshold_N, 0.0);
  return minimise_within_thresholds(stiffness_N_m.cwiseProduct(free_m - plastic_m), stiffness_N_m.asDiagonal() * flexibility,
                                    limit, force_N);
}

}  // namespace twindeck::transient
