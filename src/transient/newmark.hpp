#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/error.hpp"

namespace twindeck::transient {

/// M q̈ + C q̇ + K q = f(t), small and dense; C and K need not be symmetric (wind), M may be singular (inner points of Maxwell
/// units).
struct LinearSystem {
  Eigen::MatrixXd mass, damping, stiffness;  ///< (r × r)
  [[nodiscard]] Eigen::Index size() const { return mass.rows(); }
};

/// Spring and dashpot in series between ground and a point with displacement x = d'q. The point between them is a further
/// coordinate without mass, appended to the system: k (x - s) = c ṡ.
void add_maxwell(LinearSystem& system, const Eigen::Ref<const Eigen::VectorXd>& direction, double stiffness_N_m,
                 double damping_N_s_m);

/// Coulomb friction with a threshold, on x = d'q: a spring that sticks and slips (Jenkins element),
///     F = k (x - x_p),  |F| <= F_c,   x_p moves only while |F| = F_c.
/// Below the threshold it is a stiff spring. This models the dampers of a bridge that stick at small amplitudes (paper 3.2).
struct FrictionUnit {
  Eigen::VectorXd direction;  ///< (r) or shorter; missing entries are zero
  double stiffness_N_m = 0.0;
  double threshold_N = 0.0;
};

struct State {
  Eigen::VectorXd displacement, velocity;  ///< (r); empty: at rest
};
/// A state with its acceleration: what a further step needs.
struct Motion {
  Eigen::VectorXd displacement, velocity, acceleration;  ///< (r)
};
struct History {
  Eigen::MatrixXd displacement, acceleration;  ///< (r × n_steps) at the times of the forces
  Eigen::MatrixXd friction_N;                  ///< (n_units × n_steps)
  Status status;                               ///< not converged: the step at which friction found no balance
};

/// Newmark's method with constant average acceleration (gamma = 1/2, beta = 1/4), unconditionally stable, without numerical
/// damping; period error (omega dt)²/12. Friction is solved within each step, exactly for its piecewise linear law. Reference:
/// Newmark (1959), J. Eng. Mech. Div. 85, 67-94.
class Newmark {
 public:
  /// @param step_s  > 0 @throws InputError for a step that is not positive, or a system that is singular with it
  Newmark(LinearSystem system, double step_s, std::vector<FrictionUnit> friction = {});
  /// @param force  (r × n_steps) at t = 0, dt, …; rows that are missing at its end (Maxwell's points) are zero
  [[nodiscard]] History run(const Eigen::Ref<const Eigen::MatrixXd>& force, const State& initial = {}) const;

  /// For forces R w(t) with few inputs w: their contribution to the acceleration within a step, (M + dt/2 C +
  /// dt²/4 K)⁻¹ R.
  /// @param load  R (r × n_inputs), rows at its end missing as above @return (r × n_inputs)
  [[nodiscard]] Eigen::MatrixXd within_a_step(const Eigen::Ref<const Eigen::MatrixXd>& load) const;
  /// Goes on through some steps of a structure without friction units. A history in pieces needs no memory for all of it.
  /// @param motion  in: before these steps; out: at the last of them. At rest where it is empty
  /// @param acceleration  (r × n_steps) in: within_a_step(R) w(t), what the forces alone would do; out: what happens
  void advance(Motion& motion, Eigen::Ref<Eigen::MatrixXd> acceleration) const;

 private:
  void integrate(History& out, Eigen::VectorXd q, Eigen::VectorXd v, Eigen::VectorXd a) const;

  LinearSystem system_;
  double step_s_;
  std::vector<FrictionUnit> friction_;
  Eigen::MatrixXd inverse_;                  ///< (M + dt/2 C + dt²/4 K)⁻¹
  Eigen::MatrixXd velocity_, displacement_;  ///< inverse_ times C, times K
  Eigen::MatrixXd panels_;                   ///< both, side by side, in panels of rows
  Eigen::MatrixXd direction_;                ///< (r × n_units)
  Eigen::MatrixXd flexibility_;              ///< (n_units × n_units) dt²/4 D' inverse_ D
};

/// Finds the forces of friction units that are coupled by a flexibility: x = x_free - G F and F = clip(k (x - x_p), ±F_c).
/// Newton's method on the set of stuck units. If its sets come in a circle (springs stiff beside the flexibility, k G > 1), the
/// strictly convex problem of the same forces is solved by active sets, which ends in finitely many steps.
/// @param force  in: a guess; out: the forces @return false if no balance was found
[[nodiscard]] bool balance_friction(const Eigen::Ref<const Eigen::VectorXd>& free_m,
                                    const Eigen::Ref<const Eigen::MatrixXd>& flexibility,
                                    const Eigen::Ref<const Eigen::VectorXd>& stiffness_N_m,
                                    const Eigen::Ref<const Eigen::VectorXd>& threshold_N,
                                    const Eigen::Ref<const Eigen::VectorXd>& plastic_m, Eigen::VectorXd& force_N);

}  // namespace twindeck::transient
