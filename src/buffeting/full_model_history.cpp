#include "buffeting/full_model_history.hpp"

#include "aero/wind_model.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/dense.hpp"

namespace twindeck::buffeting {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RayleighDamping RayleighDamping::with_ratio(double ratio, double omega1, double omega2) {
  return {2.0 * ratio * omega1 * omega2 / (omega1 + omega2), 2.0 * ratio / (omega1 + omega2)};
}

namespace {

/// The dampers within time steps: a Maxwell unit is eliminated by the trapezoidal rule. The spring beside a dashpot is in the
/// stiffness matrix.
class StepwiseDampers {
 public:
  StepwiseDampers(const std::vector<const fe::Spring*>& dampers, double step_s) : dampers_(dampers), dt_(step_s) {
    inner_ = inner_rate_ = within_ = VectorXd::Zero(static_cast<Index>(dampers.size()));
    for (std::size_t j = 0; j < dampers.size(); ++j) {
      const double dashpot = 2.0 * dampers[j]->damping / dt_, spring = dampers[j]->stiffness;
      const bool in_series = dampers[j]->series;
      // Without spring or dashpot a chain of both holds no force.
      within_[static_cast<Index>(j)] = !in_series                      ? dashpot
                                       : spring > 0.0 && dashpot > 0.0 ? spring * dashpot / (spring + dashpot)
                                                                       : 0.0;
    }
  }
  /// Stiffness of each damper within a step.
  [[nodiscard]] const VectorXd& stiffness() const { return within_; }
  /// Forces at a predicted elongation and its rate.
  [[nodiscard]] VectorXd force(const VectorXd& elongation, const VectorXd& rate) const {
    VectorXd force(within_.size());
    for (Index j = 0; j < force.size(); ++j) {
      const fe::Spring& damper = *dampers_[static_cast<std::size_t>(j)];
      const double dashpot = 2.0 * damper.damping / dt_;
      if (!damper.series)
        force[j] = damper.damping * rate[j];
      else if (within_[j] == 0.0)
        force[j] = 0.0;
      else
        force[j] = within_[j] * elongation[j] -
                   damper.stiffness / (damper.stiffness + dashpot) * damper.damping * (2.0 / dt_ * inner_[j] + inner_rate_[j]);
    }
    return force;
  }
  /// Moves the inner points of the Maxwell units to the end of the step.
  void advance(const VectorXd& elongation) {
    for (Index j = 0; j < within_.size(); ++j) {
      const fe::Spring& damper = *dampers_[static_cast<std::size_t>(j)];
      if (!damper.series || within_[j] == 0.0) continue;
      const double dashpot = 2.0 * damper.damping / dt_;
      const double next = (damper.stiffness * elongation[j] + damper.damping * (2.0 / dt_ * inner_[j] + inner_rate_[j])) /
                          (damper.stiffness + dashpot);
      inner_rate_[j] = 2.0 / dt_ * (next - inner_[j]) - inner_rate_[j];
      inner_[j] = next;
    }
  }

 private:
  const std::vector<const fe::Spring*>& dampers_;
  double dt_;
  VectorXd within_, inner_, inner_rate_;  ///< inner point of a Maxwell unit, and its rate
};

}  // namespace

MatrixXd full_model_history(const dynamics::LoadedModel& loaded, const std::vector<const fe::Spring*>& dampers,
                            const RayleighDamping& damping, const Eigen::Ref<const MatrixXd>& patterns,
                            const Eigen::Ref<const MatrixXd>& amplitude, const Eigen::Ref<const MatrixXd>& observed,
                            double step_s) {
  const linalg::SparseMatrix k = aero::stiffness_with(loaded, dampers), m = loaded.system.mass(loaded.theta);
  const MatrixXd direction = aero::damper_patterns(loaded, dampers);
  const double dt = step_s, quarter = 0.25 * dt * dt;

  // M + dt/2 C + dt²/4 K, with each damper as what it is within a step.
  StepwiseDampers stepwise(dampers, dt);
  const double mass_part = 1.0 + 0.5 * dt * damping.mass_part, stiffness_part = quarter + 0.5 * dt * damping.stiffness_part;
  linalg::SparseMatrix effective = mass_part * m + stiffness_part * k;
  effective += aero::sum_of_outer_products(direction, quarter * stepwise.stiffness());
  linalg::Cholesky factor;
  const Status status = factor.factorize(effective);
  TWINDECK_ASSERT(status.converged);

  const auto mass = m.selfadjointView<Eigen::Lower>();
  const auto stiffness = k.selfadjointView<Eigen::Lower>();
  const MatrixXd force = linalg::product(patterns, amplitude);
  VectorXd q = VectorXd::Zero(k.rows()), v = q, a = q;
  MatrixXd out = MatrixXd::Zero(observed.rows(), amplitude.cols());
  for (Index i = 1; i < amplitude.cols(); ++i) {
    q += dt * v + quarter * a;  // predictors
    v += 0.5 * dt * a;
    VectorXd right = force.col(i);
    right -= damping.mass_part * VectorXd(mass * v);
    right -= stiffness * VectorXd(q + damping.stiffness_part * v);
    const VectorXd elongation = direction.transpose() * q, rate = direction.transpose() * v;
    right -= direction * stepwise.force(elongation, rate);
    a = factor.solve(right);
    q += quarter * a;
    v += 0.5 * dt * a;
    stepwise.advance(direction.transpose() * q);
    out.col(i) = observed * a;
  }
  return out;
}

}  // namespace twindeck::buffeting
