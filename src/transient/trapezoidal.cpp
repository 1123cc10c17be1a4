#include "transient/trapezoidal.hpp"

#include <Eigen/Dense>

#include "core/error.hpp"

namespace twindeck::transient {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TrapezoidalStepper::TrapezoidalStepper(const VectorXd& omega_rad_s, const VectorXd& damping_ratio, double step_s)
    : dt_(step_s), omega_squared_(omega_rad_s.cwiseAbs2()), two_zeta_omega_(2.0 * omega_rad_s.cwiseProduct(damping_ratio)) {
  TWINDECK_ASSERT(step_s > 0.0 && omega_rad_s.size() == damping_ratio.size());
  inverse_ = (1.0 + 0.5 * dt_ * two_zeta_omega_.array() + 0.25 * dt_ * dt_ * omega_squared_.array()).inverse();
  q_ = v_ = a_ = predicted_ = VectorXd::Zero(omega_rad_s.size());
}

void TrapezoidalStepper::set_dampers(const MatrixXd& at_dampers, const std::vector<SlidingDamper>& dampers) {
  at_dampers_ = at_dampers;
  dampers_ = dampers;
  const Index d = at_dampers.rows();
  TWINDECK_ASSERT(std::ssize(dampers) == d && at_dampers.cols() == q_.size());
  compliance_ = 0.25 * dt_ * dt_ * at_dampers * inverse_.asDiagonal() * at_dampers.transpose();
  u_ = u_velocity_ = slip_ = force_ = VectorXd::Zero(d);
  stiffness_.resize(d);
  per_slip_.resize(d);
  for (Index j = 0; j < d; ++j) {
    const SlidingDamper& damper = dampers[static_cast<std::size_t>(j)];
    TWINDECK_ASSERT(damper.damping_N_s_m > 0.0);
    stiffness_[j] = damper.stiffness_N_m + 2.0 * damper.mount_damping_N_s_m / dt_;
    per_slip_[j] = damper.stiffness_N_m * dt_ + damper.mount_damping_N_s_m;
  }
  stuck_ = (MatrixXd::Identity(d, d) + stiffness_.asDiagonal() * compliance_).inverse();
}

void TrapezoidalStepper::start(const VectorXd& displacement, const VectorXd& load) {
  q_ = displacement;
  v_.setZero();
  a_ = load - omega_squared_.cwiseProduct(q_);
  if (!dampers_.empty()) {
    u_ = slip_ = at_dampers_ * q_;
    u_velocity_.setZero();
    force_.setZero();
  }
}

/// F + (k dt + c_m) g(F) + (k + 2 c_m/dt) C F = k (u_free - x) + c_m (2 (u_free - u)/dt - u'), the left side growing with F:
/// the pieces of g that hold are found in a few rounds.
void TrapezoidalStepper::find_forces(const VectorXd& u_free) {
  const Index d = u_free.size();
  VectorXd right(d);
  for (Index j = 0; j < d; ++j) {
    const SlidingDamper& damper = dampers_[static_cast<std::size_t>(j)];
    right[j] = damper.stiffness_N_m * (u_free[j] - slip_[j]) +
               damper.mount_damping_N_s_m * (2.0 * (u_free[j] - u_[j]) / dt_ - u_velocity_[j]);
  }
  const auto piece = [&](Index j, double force) {
    const double limit = dampers_[static_cast<std::size_t>(j)].friction_N;
    return force > limit ? 1 : force < -limit ? -1 : 0;
  };
  std::vector<int> pieces(static_cast<std::size_t>(d));
  for (Index j = 0; j < d; ++j) pieces[static_cast<std::size_t>(j)] = piece(j, force_[j]);
  constexpr int kRounds = 50;
  for (int round = 0; round < kRounds; ++round) {
    MatrixXd matrix = stiffness_.asDiagonal() * compliance_;
    VectorXd b = right;
    bool slides = false;
    for (Index j = 0; j < d; ++j) {
      const SlidingDamper& damper = dampers_[static_cast<std::size_t>(j)];
      const int p = pieces[static_cast<std::size_t>(j)];
      slides |= p != 0;
      matrix(j, j) += 1.0 + (p != 0 ? per_slip_[j] / damper.damping_N_s_m : 0.0);
      b[j] += p * per_slip_[j] * damper.friction_N / damper.damping_N_s_m;
    }
    force_ = slides ? VectorXd(matrix.partialPivLu().solve(b)) : VectorXd(stuck_ * b);
    bool same = true;
    for (Index j = 0; j < d; ++j) {
      const int now = piece(j, force_[j]);
      same &= now == pieces[static_cast<std::size_t>(j)];
      pieces[static_cast<std::size_t>(j)] = now;
    }
    if (same) return;
  }
  // Rounds that go in a circle end with a force on the edge between two pieces, where both give the same slip.
}

void TrapezoidalStepper::step(const VectorXd& load) {
  // Accelerations without the dampers; what they add is linear in their forces.
  predicted_ = v_ + 0.5 * dt_ * a_;
  a_ = (load - two_zeta_omega_.cwiseProduct(predicted_) - omega_squared_.cwiseProduct(q_ + dt_ * v_ + 0.25 * dt_ * dt_ * a_))
           .cwiseProduct(inverse_)
           .eval();
  // Displacement of the last step's acceleration goes into the prediction before it is lost.
  const VectorXd q_from_before = q_ + 0.5 * dt_ * (v_ + predicted_);
  if (!dampers_.empty()) {
    const VectorXd u_free = at_dampers_ * (q_from_before + 0.25 * dt_ * dt_ * a_);
    find_forces(u_free);
    a_ -= inverse_.cwiseProduct(at_dampers_.transpose() * force_);
    const VectorXd u_new = u_free - compliance_ * force_;
    u_velocity_ = 2.0 * (u_new - u_) / dt_ - u_velocity_;
    u_ = u_new;
    for (Index j = 0; j < force_.size(); ++j) slip_[j] += dt_ * dampers_[static_cast<std::size_t>(j)].slip_rate(force_[j]);
  }
  q_ = q_from_before + 0.25 * dt_ * dt_ * a_;
  v_ = predicted_ + 0.5 * dt_ * a_;
}

}  // namespace twindeck::transient
