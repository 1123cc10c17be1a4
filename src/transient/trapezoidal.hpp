#pragma once

#include <Eigen/Core>
#include <vector>

#include "transient/sliding_damper.hpp"

namespace twindeck::transient {

/// Oscillators in modal coordinates, q'' + 2 zeta omega q' + omega² q = p(t) - B' F, stepped by the trapezoidal rule (Newmark
/// with gamma = 1/2, beta = 1/4), with sliding dampers that act at u = B q.
///
/// The rule has no numerical damping and lengthens periods by (omega dt)²/12: 0.05 % at 2.4 Hz and 200 steps a second. The
/// damper forces at the end of each step are solved together with the step, by Newton's method on a piecewise linear, monotone
/// equation.
class TrapezoidalStepper {
 public:
  /// @param omega_rad_s, damping_ratio  (r) @param step_s  dt
  TrapezoidalStepper(const Eigen::VectorXd& omega_rad_s, const Eigen::VectorXd& damping_ratio, double step_s);
  /// @param at_dampers  B (n_dampers × r)
  void set_dampers(const Eigen::MatrixXd& at_dampers, const std::vector<SlidingDamper>& dampers);
  /// Starts with zero velocity and displacement q, which the load `p` holds. The dampers carry no force (the dashpots have
  /// crept).
  void start(const Eigen::VectorXd& displacement, const Eigen::VectorXd& load);
  /// One step to a time at which the modal loads are p. @param load p (r)
  void step(const Eigen::VectorXd& load);

  [[nodiscard]] const Eigen::VectorXd& displacement() const { return q_; }
  [[nodiscard]] const Eigen::VectorXd& velocity() const { return v_; }
  [[nodiscard]] const Eigen::VectorXd& acceleration() const { return a_; }
  [[nodiscard]] const Eigen::VectorXd& damper_force() const { return force_; }

 private:
  void find_forces(const Eigen::VectorXd& u_free);

  double dt_;
  Eigen::VectorXd omega_squared_, two_zeta_omega_, inverse_;  // 1 / (1 + zeta omega dt + omega² dt²/4)
  Eigen::VectorXd q_, v_, a_, predicted_;
  Eigen::MatrixXd at_dampers_, compliance_;  // dt²/4 B diag(inverse) B'
  std::vector<SlidingDamper> dampers_;
  Eigen::VectorXd u_, u_velocity_, slip_, force_, stiffness_, per_slip_;
  Eigen::MatrixXd stuck_;  // inverse of the equation's matrix when nothing slides
};

}  // namespace twindeck::transient
