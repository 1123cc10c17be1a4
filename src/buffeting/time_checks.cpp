#include "buffeting/time_checks.hpp"

#include <cmath>
#include <numbers>

#include "buffeting/full_model_history.hpp"
#include "buffeting/loads.hpp"
#include "buffeting/response.hpp"

namespace twindeck::buffeting {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd gusts_of_first_seed(const BridgeInWind& bridge, const wind::TurbulenceSet& set, const WindEventSettings& config,
                             const WindEvent& event, double step_s, std::uint64_t seed) {
  wind::SimulationOptions options;
  options.duration_s = config.duration_s;
  options.rate_Hz = 1.0 / step_s;
  options.cutoff_Hz = config.cutoff_Hz;
  options.anchors = static_cast<int>(config.anchors);
  const auto sample = [&](wind::Component component) {
    return wind::Simulator(field_at_nodes(bridge, set, config.height_m, event.speed_m_s, component, config.frozen), options)
        .sample(seed);
  };
  const auto n = static_cast<Index>(bridge.model.strips.size());
  MatrixXd gusts(static_cast<Index>(std::llround(config.duration_s / step_s)), 2 * n);
  gusts << sample(wind::Component::along), sample(wind::Component::vertical);
  return gusts;
}

/// Vertical RMS at the monitoring points.
VectorXd vertical_rms(const BridgeInWind& bridge, const MatrixXd& acceleration) {
  const VectorXd all = buffeting::root_mean_squares(acceleration);
  VectorXd out(static_cast<Index>(bridge.sensors.points.size()));
  for (std::size_t p = 0; p < bridge.sensors.points.size(); ++p) out[static_cast<Index>(p)] = all[bridge.sensors.vertical(p)];
  return out;
}

/// The wind's force on the strips, from v' and w', over the free degrees of freedom. @return (n × 2 n_strips)
MatrixXd nodal_patterns(const BridgeInWind& bridge, const aero::Deployment& deployment, const WindEventSettings& config,
                        double speed_m_s) {
  const auto n = static_cast<Index>(bridge.model.strips.size());
  MatrixXd at_nodes = MatrixXd::Zero(6 * n, 2 * n);
  for (Index i = 0; i < n; ++i) {
    const aero::Strip& strip = bridge.model.strips[static_cast<std::size_t>(i)];
    const aero::YawRule& rule = deployment.at(strip.deck, strip.yaw_rad);
    const LoadFactor factor =
        buffeting::buffeting_factor(bridge.sections[static_cast<std::size_t>(strip.section)], strip, rule,
                                    bridge.aerodynamics.density_kg_m3, speed_m_s, config.equation_choice());
    const aero::Kinematics kinematics = aero::kinematics(strip, rule.axes, bridge.aerodynamics.wind());
    at_nodes.block<6, 1>(6 * i, i) = kinematics.transpose() * factor.col(0);
    at_nodes.block<6, 1>(6 * i, n + i) = kinematics.transpose() * factor.col(1);
  }
  const MatrixXd nodal = bridge.model.nodes.motion.transpose() * at_nodes;
  return bridge.loaded.system.expansion.transpose() * nodal;
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
  const MatrixXd load = buffeting::load_matrix(system, event.speed_m_s, config.equation_choice());
  const MatrixXd points = bridge.sensors.motion.topRows(3 * static_cast<Index>(bridge.sensors.points.size()));

  // The same waves sampled twice as often.
  const auto at_step = [&](double step_s) {
    const transient::Newmark newmark(buffeting::equations_of_motion(system, event.speed_m_s, bridge.frozen_omega), step_s);
    const MatrixXd gusts = gusts_of_first_seed(bridge, set, config, event, step_s, seed);
    return vertical_rms(bridge, buffeting::respond(newmark, load, gusts, step_s, points, {config.lead_in_s}).acceleration_m_s2);
  };
  append(checks, "half_step", bridge, at_step(0.5 * config.step_s), at_step(config.step_s));
  if (config.full_model_check_s == 0.0) return checks;

  // Reduced and full model under the same forces.
  const Index steps = std::min<Index>(static_cast<Index>(std::llround(config.full_model_check_s / config.step_s)),
                                      static_cast<Index>(std::llround(config.duration_s / config.step_s)));
  MatrixXd amplitude = gusts_of_first_seed(bridge, set, config, event, config.step_s, seed).topRows(steps).transpose();
  // From nothing over the first quarter: a jump would ring in modes that no gust reaches.
  for (Index i = 0; i < steps / 4; ++i) {
    amplitude.col(i) *= 0.5 - 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(steps / 4));
  }
  const double omega1 = bridge.frozen_omega;
  const RayleighDamping rayleigh = RayleighDamping::with_ratio(bridge.aerodynamics.structural_damping, omega1, 5.0 * omega1);
  const std::vector<const fe::Spring*> dampers =
      config.dampers ? aero::dampers_of(*bridge.loaded.model) : std::vector<const fe::Spring*>();

  const MatrixXd patterns = nodal_patterns(bridge, system.deployment(), config, event.speed_m_s);
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
