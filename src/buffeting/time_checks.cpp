#include "buffeting/time_checks.hpp"

#include <cmath>
#include <numbers>

#include "buffeting/full_model_history.hpp"
#include "buffeting/gusts.hpp"
#include "buffeting/loads.hpp"
#include "buffeting/response.hpp"

namespace twindeck::buffeting {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Vertical RMS at the monitoring points.
VectorXd vertical_rms(const BridgeInWind& bridge, const MatrixXd& acceleration) {
  const VectorXd all = buffeting::root_mean_squares(acceleration);
  VectorXd out(static_cast<Index>(bridge.sensors.points.size()));
  for (std::size_t p = 0; p < bridge.sensors.points.size(); ++p) out[static_cast<Index>(p)] = all[bridge.sensors.vertical(p)];
  return out;
}

void append(std::vector<TimeCheck>& checks, const std::string& name, const BridgeInWind& bridge, const VectorXd& reference,
            const VectorXd& found) {
  for (std::size_t p = 0; p < bridge.sensors.points.size(); ++p) {
    checks.push_back({name, bridge.sensors.points[p], reference[static_cast<Index>(p)], found[static_cast<Index>(p)], 1.0});
  }
}

}  // namespace

std::vector<TimeCheck> check_time_integration(const BridgeInWind& bridge, const wind::TurbulenceSet& set,
                                              const WindEventSettings& config, const CheckedCase& checked, std::uint64_t seed) {
  std::vector<TimeCheck> checks;
  const WindEvent& event = checked.event;
  const aero::AeroelasticSystem system = system_of(bridge, deployment_of(bridge.aerodynamics, checked.run.model));
  const MatrixXd load = buffeting::load_matrix(system, event.speed_m_s, config.equation_choice(), config.components());
  const MatrixXd points = bridge.sensors.motion.topRows(3 * static_cast<Index>(bridge.sensors.points.size()));

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
  // From nothing over the first quarter: a jump would ring in modes that no gust reaches.
  for (Index i = 0; i < steps / 4; ++i) {
    amplitude.col(i) *= 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps / 4));
  }
  const double omega1 = bridge.frozen_omega;
  const RayleighDamping rayleigh = RayleighDamping::with_ratio(bridge.aerodynamics.structural_damping, omega1, 5.0 * omega1);
  const std::vector<const fe::Spring*> dampers =
      config.dampers ? aero::dampers_of(*bridge.loaded.model) : std::vector<const fe::Spring*>();

  const MatrixXd patterns =
      nodal_patterns(bridge, system.deployment(), event.speed_m_s, config.equation_choice(), config.components());
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
  for (const aero::MaxwellUnit& unit : structure.maxwell) {
    transient::add_maxwell(reduced, unit.direction, unit.stiffness_N_m, unit.damping_N_s_m);
  }
  const MatrixXd force = load * amplitude;
  const transient::History history = transient::Newmark(reduced, config.step_s).run(force);
  const MatrixXd short_record = points * history.acceleration.topRows(points.cols());
  append(checks, "full_model", bridge, vertical_rms(bridge, full.transpose()), vertical_rms(bridge, short_record.transpose()));
  return checks;
}

}  // namespace twindeck::buffeting
