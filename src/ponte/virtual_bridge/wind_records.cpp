#include "ponte/virtual_bridge/wind_records.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "buffeting/loads.hpp"
#include "wind/simulation.hpp"

namespace twindeck::ponte {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kRampUp_s = 60.0;

/// v' and w' at the aerodynamic nodes, one after the other. @return (n_samples × 2 n_nodes)
MatrixXd gusts(const VirtualWind& virtual_wind, const CampaignSettings& settings, const RecordSettings& record,
               const std::vector<aero::Strip>& strips, const aero::Wind& wind, std::uint64_t seed) {
  const auto n = static_cast<Index>(strips.size());
  const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(wind.direction);
  MatrixXd out(static_cast<Index>(std::llround(record.duration_s * settings.rate_Hz)), 2 * n);
  for (const wind::Component component : {wind::Component::along, wind::Component::vertical}) {
    wind::FieldDefinition field;
    field.component = component;
    field.position_m.resize(n, 3);
    for (Index i = 0; i < n; ++i) {
      const Eigen::Vector3d& x = strips[static_cast<std::size_t>(i)].x_m;
      field.position_m.row(i) << x.dot(wind.direction), x.dot(across), x.z();
    }
    field.speed_m_s = VectorXd::Constant(n, record.speed_m_s);
    field.sigma_m_s = VectorXd::Constant(
        n, wind::standard_deviation(virtual_wind.turbulence, component, settings.wind_height_m, record.speed_m_s));
    field.length_m = VectorXd::Constant(n, wind::length_scale(virtual_wind.turbulence, component, settings.wind_height_m));
    field.decay = virtual_wind.turbulence.decay[static_cast<std::size_t>(component)];
    wind::SimulationOptions options;
    options.duration_s = record.duration_s;
    options.rate_Hz = settings.rate_Hz;
    options.cutoff_Hz = std::min(8.0, 0.5 * settings.rate_Hz);
    options.amplitudes = wind::Amplitudes::gaussian;
    out.middleCols(component == wind::Component::along ? 0 : n, n) = wind::Simulator(field, options).sample(seed);
  }
  return out;
}

}  // namespace

Motion simulate_wind(const ConditionModel& model, const CampaignSettings& settings, const RecordSettings& record,
                     const VirtualWind& virtual_wind, const std::vector<sensors::LayoutChannel>& channels, std::uint64_t seed,
                     std::uint64_t stream) {
  // 1. The decks in this wind.
  aero::WindSettings aerodynamics = virtual_wind.aerodynamics;
  aerodynamics.direction_deg = record.direction_deg;
  const aero::Wind wind = aerodynamics.wind();
  const aero::AeroNodes nodes = aero::aero_nodes_of(aerodynamics, &model.state->chains.model, settings.bridge);
  const std::vector<aero::Strip> strips = aero::strips_of(nodes, aerodynamics.deck_names(), wind);
  const std::vector<aero::StripMotion> motions = aero::motions_of(nodes, model.state->system.expand(model.basis.vectors));
  aero::ReducedStructure structure;
  structure.omega_rad_s = model.basis.omega_rad_s;
  structure.damping_ratio = model.damping;
  const aero::AeroelasticSystem system(structure,
                                       aero::sections_of(aerodynamics, virtual_wind.data, "standin", settings.wind_level),
                                       strips, motions, wind, aero::everywhere(aero::published_yaw_rule(settings.wind_model)));
  const aero::AeroelasticSystem::Block self =
      system.self_excited(record.speed_m_s, model.basis.omega_rad_s[model.state->named.front()]);

  // 2. Its gusts, as forces on the coordinates.
  const MatrixXd load = buffeting::load_matrix(system, record.speed_m_s, aero::Equations::consistent);
  const MatrixXd force = load * gusts(virtual_wind, settings, record, strips, wind, seed + 7919 * (stream + 1)).transpose();

  // 3. The motion.
  const MatrixXd seen = at_channels(*model.state, model.basis.vectors, channels);
  const Index n_samples = force.cols();
  transient::TrapezoidalStepper stepper(model.basis.omega_rad_s, model.damping,
                                        1.0 / (settings.rate_Hz * static_cast<double>(settings.substeps)));
  if (!model.dampers.empty()) stepper.set_dampers(model.at_dampers, model.dampers);
  MotionRecorder recorder(model, settings, seen, n_samples);
  VectorXd before = VectorXd::Zero(force.rows()), after = before;
  const auto warm_up = std::min<Index>(n_samples, static_cast<Index>(std::lround(kRampUp_s * settings.rate_Hz)));
  for (Index sample = -warm_up; sample < n_samples; ++sample) {
    before = after;
    const double rise = std::min(1.0, 2.0 * static_cast<double>(sample + warm_up) / static_cast<double>(warm_up));
    after = rise * force.col((sample + n_samples) % n_samples);
    for (long k = 0; k < settings.substeps; ++k) {
      const double part = static_cast<double>(k + 1) / static_cast<double>(settings.substeps);
      stepper.step((1.0 - part) * before + part * after + self.damping * stepper.velocity() +
                   self.stiffness * stepper.displacement());
      recorder.take(sample, k, stepper);
    }
  }
  return recorder.motion();
}

}  // namespace twindeck::ponte
