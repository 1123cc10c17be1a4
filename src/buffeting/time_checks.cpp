#include "buffeting/time_checks.hpp"

#include <cmath>
#include <numbers>

#include "aero/wind_model.hpp"
#include "buffeting/loads.hpp"
#include "buffeting/response.hpp"
#include "linalg/cholesky.hpp"
#include "linalg/dense.hpp"

namespace twindeck::buffeting {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Vertical RMS at the monitoring points.
VectorXd vertical_rms(const BridgeInWind& bridge, const MatrixXd& acceleration) {
  const VectorXd all = buffeting::root_mean_squares(acceleration);
  VectorXd out(std::ssize(bridge.sensors.points));
  for (std::size_t p = 0; p < bridge.sensors.points.size(); ++p) out[static_cast<Index>(p)] = all[bridge.sensors.vertical(p)];
  return out;
}

void append(std::vector<TimeCheck>& checks, const std::string& name, const BridgeInWind& bridge, const VectorXd& reference,
            const VectorXd& found) {
  for (std::size_t p = 0; p < bridge.sensors.points.size(); ++p)
    checks.push_back({name, bridge.sensors.points[p], reference[static_cast<Index>(p)], found[static_cast<Index>(p)], 1.0});
}

/// The dampers within time steps: a Maxwell unit is eliminated by the trapezoidal rule. The spring beside a dashpot is in the
/// stiffness matrix.
class StepwiseDampers {
 public:
  StepwiseDampers(const std::vector<const fe::Spring*>& dampers, double step_s) : dampers_(dampers), dt_(step_s) {
    inner_ = inner_rate_ = within_ = VectorXd::Zero(std::ssize(dampers));
    for (std::size_t j = 0; j < dampers.size(); ++j) {
      const double dashpot = 2.0 * dampers[j]->damping / dt_, spring = dampers[j]->stiffness;
      const bool in_series = dampers[j]->series;
      // A Maxwell unit without spring or without dashpot carries no force.
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

std::vector<TimeCheck> check_time_integration(const BridgeInWind& bridge, const wind::TurbulenceSet& set,
                                              const WindEventSettings& config, const CheckedCase& checked, std::uint64_t seed) {
  std::vector<TimeCheck> checks;
  const WindEvent& event = checked.event;
  const aero::AeroelasticSystem system = system_of(bridge, deployment_of(bridge.aerodynamics, checked.run.model));
  const MatrixXd load = buffeting::load_matrix(system, event.speed_m_s, config.equations, config.components());
  const MatrixXd points = bridge.sensors.motion.topRows(3 * std::ssize(bridge.sensors.points));

  // The same waves sampled twice as often.
  const auto at_step = [&](double step_s) {
    const transient::Newmark newmark(buffeting::equations_of_motion(system, event.speed_m_s, bridge.frozen_omega), step_s);
    const MatrixXd gusts = Gusts(bridge, set, config, event.speed_m_s, step_s).sample(seed);
    return vertical_rms(
        bridge,
        buffeting::respond(newmark, load, gusts, step_s, points, {config.lead_in_s, config.repeats()}).acceleration_m_s2);
  };
  append(checks, "half_step", bridge, at_step(0.5 * config.step_s), at_step(config.step_s));
  if (config.full_model_check_s == 0.0) return checks;

  // Reduced and full model under the same forces.
  const Index steps = std::min<Index>(static_cast<Index>(std::llround(config.full_model_check_s / config.step_s)),
                                      static_cast<Index>(std::llround(config.duration_s / config.step_s)));
  MatrixXd amplitude = Gusts(bridge, set, config, event.speed_m_s, config.step_s).sample(seed).topRows(steps).transpose();
  // The forces grow from zero over the first quarter: a jump would excite modes above the frequencies of the gusts.
  for (Index i = 0; i < steps / 4; ++i)
    amplitude.col(i) *= 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps / 4));
  const double omega1 = bridge.frozen_omega;
  const RayleighDamping rayleigh = RayleighDamping::with_ratio(bridge.aerodynamics.structural_damping, omega1, 5.0 * omega1);
  const std::vector<const fe::Spring*> dampers =
      config.dampers ? aero::dampers_of(*bridge.loaded.model) : std::vector<const fe::Spring*>();

  const MatrixXd patterns = nodal_patterns(bridge, system.deployment(), event.speed_m_s, config.equations, config.components());
  // Rows of the monitoring points over the free degrees of freedom.
  MatrixXd observed(points.rows(), bridge.loaded.system.size());
  Index row = 0;
  for (const std::string& name : bridge.sensors.points) {
    const int node = bridge.loaded.model->monitoring_points.at(name);
    observed.middleRows<3>(row) = MatrixXd(bridge.loaded.system.expansion.middleRows(6 * node, 3));
    row += 3;
  }
  const MatrixXd full = full_model_history(bridge.loaded, dampers, rayleigh, patterns, amplitude, observed, config.step_s);

  const aero::ReducedStructure& structure = bridge.reduced.structure;
  transient::LinearSystem reduced;
  reduced.mass = MatrixXd::Identity(structure.size(), structure.size());
  reduced.stiffness = structure.omega_rad_s.cwiseAbs2().asDiagonal();
  reduced.damping = structure.viscous + rayleigh.mass_part * reduced.mass + rayleigh.stiffness_part * reduced.stiffness;
  for (const aero::MaxwellUnit& unit : structure.maxwell)
    transient::add_maxwell(reduced, unit.direction, unit.stiffness_N_m, unit.damping_N_s_m);
  const MatrixXd force = load * amplitude;
  const transient::History history = transient::Newmark(reduced, config.step_s).run(force);
  const MatrixXd short_record = points * history.acceleration.topRows(points.cols());
  append(checks, "full_model", bridge, vertical_rms(bridge, full.transpose()), vertical_rms(bridge, short_record.transpose()));
  return checks;
}

RayleighDamping RayleighDamping::with_ratio(double ratio, double omega1, double omega2) {
  return {2.0 * ratio * omega1 * omega2 / (omega1 + omega2), 2.0 * ratio / (omega1 + omega2)};
}

MatrixXd full_model_history(const dynamics::LoadedModel& loaded, const std::vector<const fe::Spring*>& dampers,
                            const RayleighDamping& damping, const Eigen::Ref<const MatrixXd>& patterns,
                            const Eigen::Ref<const MatrixXd>& amplitude, const Eigen::Ref<const MatrixXd>& observed,
                            double step_s) {
  const linalg::SparseMatrix k = aero::stiffness_with(loaded, dampers), m = loaded.system.mass(loaded.theta);
  const MatrixXd direction = aero::damper_patterns(loaded, dampers);
  const double dt = step_s, quarter = 0.25 * dt * dt;

  // M + dt/2 C + dt²/4 K, with the stiffness that each damper has within a step.
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
