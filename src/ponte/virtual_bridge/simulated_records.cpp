#include "ponte/virtual_bridge/simulated_records.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "buffeting/loads.hpp"
#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/random.hpp"
#include "matching/pairing.hpp"
#include "sensors/logger.hpp"
#include "wind/simulation.hpp"

namespace twindeck::ponte {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWarmUp_s = 100.0;  // ten times the time in which the motion of the least damped mode decays to 1/e

std::vector<int> nodes_of(const BridgeState& state, const std::vector<sensors::LayoutPoint>& points) {
  return sensors::nodes_at(state.chains.model, each_of(points, &sensors::LayoutPoint::x_m), 0.05);
}

/// A node that is loaded in its three directions, and how much.
struct LoadedNode {
  int node;
  double density;  ///< square root of the one-sided spectral density [N/sqrt(Hz)]
};

int head_of_mast(const fe::Model& model) {
  int head = 0;
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].x_m.z() > model.nodes[static_cast<std::size_t>(head)].x_m.z()) head = static_cast<int>(i);
  return head;
}

/// Decks in the order of the layout, head of the mast, inner nodes of the hanging stays by name.
std::vector<LoadedNode> loaded_nodes(const ConditionSettings& condition, const BridgeState& state,
                                     const std::vector<sensors::LayoutPoint>& points) {
  std::vector<LoadedNode> loaded;
  for (const int node : nodes_of(state, points)) loaded.push_back({node, condition.force_deck});
  loaded.push_back({head_of_mast(state.chains.model), condition.force_mast});
  for (const auto& [name, nodes] : state.chains.nodes)
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) loaded.push_back({nodes[k], condition.force_stay});
  return loaded;
}

/// Modal loads from sample to sample: white loads where they act, projected. A stretch of samples is projected at once.
class AmbientLoads {
 public:
  /// @param intensity  standard deviation of a load of density 1 [sqrt(Hz)]
  AmbientLoads(const MatrixXd& loads, double intensity, std::uint64_t seed, std::uint64_t stream)
      : loads_(intensity * loads),
        seed_(seed),
        stream_(stream),
        drawn_(loads.cols(), kStretch),
        modal_(loads.rows(), kStretch) {}
  /// @param step  from 0, one after the other
  auto at(Index step) {
    if (step % kStretch == 0) draw(step);
    return modal_.col(step % kStretch);
  }

 private:
  static constexpr Index kStretch = 128;
  void draw(Index first) {
    const auto begin = static_cast<std::uint64_t>(first * drawn_.rows());
    for (Index i = 0; i < drawn_.size(); ++i)
      drawn_.data()[i] = white_number(seed_, stream_, begin + static_cast<std::uint64_t>(i));
    modal_.noalias() = loads_ * drawn_;
  }
  MatrixXd loads_;
  std::uint64_t seed_, stream_;
  MatrixXd drawn_, modal_;  // (n_loads × stretch), (n_modes × stretch)
};

void fit_dampers(const CampaignSettings& settings, ConditionModel& out, MatrixXd& loads) {
  const fe::Model& model = out.state->chains.model;
  std::vector<VectorXd> columns;
  for (const fe::Spring& spring : model.springs) {
    if (!spring.group.starts_with("damper_")) continue;
    const auto kind =
        std::ranges::find_if(settings.dampers, [&](const DamperSettings& d) { return "damper_" + d.type == spring.group; });
    TWINDECK_ASSERT(kind != settings.dampers.end());
    transient::SlidingDamper damper;
    damper.stiffness_N_m = kind->mount_stiffness_N_m > 0.0 ? kind->mount_stiffness_N_m : spring.stiffness;
    damper.mount_damping_N_s_m = kind->mount_loss_factor * damper.stiffness_N_m / (2.0 * std::numbers::pi);
    damper.damping_N_s_m = spring.damping;
    damper.friction_N = kind->friction_N;
    out.dampers.push_back(damper);
    out.damper_names.push_back(spring.name);
    VectorXd load = VectorXd::Zero(out.state->system.expansion.rows());
    load.segment<3>(6 * spring.node) = spring.direction.normalized();
    columns.emplace_back(out.state->system.expansion.transpose() * load);
  }
  loads.resize(out.state->system.size(), std::ssize(columns));
  for (std::size_t i = 0; i < columns.size(); ++i) loads.col(static_cast<Index>(i)) = columns[i];
}

constexpr double kRampUp_s = 60.0;

/// v' and w' at the aerodynamic nodes, one after the other. @return (n_samples × 2 n_nodes)
MatrixXd gusts(const VirtualWind& virtual_wind, const CampaignSettings& settings, const RecordSettings& record,
               const std::vector<aero::Strip>& strips, const aero::Wind& wind, std::uint64_t seed) {
  const auto n = std::ssize(strips);
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
    wind::SimulationOptions options{.duration_s = record.duration_s,
                                    .rate_Hz = settings.rate_Hz,
                                    .cutoff_Hz = std::min(8.0, 0.5 * settings.rate_Hz),
                                    .amplitudes = wind::Amplitudes::gaussian};
    out.middleCols(component == wind::Component::along ? 0 : n, n) = wind::Simulator(field, options).sample(seed);
  }
  return out;
}

transient::TrapezoidalStepper stepper_of(const ConditionModel& model, const CampaignSettings& settings) {
  transient::TrapezoidalStepper stepper(model.basis.omega_rad_s, model.damping,
                                        1.0 / (settings.rate_Hz * static_cast<double>(settings.substeps)));
  if (!model.dampers.empty()) stepper.set_dampers(model.at_dampers, model.dampers);
  return stepper;
}

/// Steps through the warm-up, of which nothing is kept, and the record. Loads are joined by straight lines.
/// @param load_at  load of a sample, from -warm_up on
/// @param self     self-excited forces, null for none
/// @param seen     (n_channels × r) accelerations of the channels from those of the coordinates
template <class LoadAt>
Motion motion_under(const LoadAt& load_at, const aero::AeroelasticSystem::Block* self, Index warm_up, Index n_samples,
                    const MatrixXd& seen, const ConditionModel& model, const CampaignSettings& settings,
                    transient::TrapezoidalStepper& stepper) {
  const Index n_late = seen.rows() / 2, n_first = seen.rows() - n_late;
  Motion out{MatrixXd(n_samples, seen.rows()),
             MatrixXd(model.dampers.empty() ? 0 : n_samples * settings.substeps, std::ssize(model.dampers)),
             VectorXd::Zero(seen.rows())};
  VectorXd before, after = VectorXd::Zero(model.basis.omega_rad_s.size());
  for (Index sample = -warm_up; sample < n_samples; ++sample) {
    before = after;
    after = load_at(sample);
    for (long k = 0; k < settings.substeps; ++k) {
      const double part = static_cast<double>(k + 1) / static_cast<double>(settings.substeps);
      VectorXd load = (1.0 - part) * before + part * after;
      if (self != nullptr) load = load + self->damping * stepper.velocity() + self->stiffness * stepper.displacement();
      stepper.step(load);
      if (sample < 0) continue;
      const auto take = [&](auto&& there, const auto& channels) {
        there.noalias() = (channels * stepper.acceleration()).transpose();
      };
      if (k == 0) take(out.acceleration_m_s2.row(sample).head(n_first), seen.topRows(n_first));
      if (k == settings.second_logger_lag) take(out.acceleration_m_s2.row(sample).tail(n_late), seen.bottomRows(n_late));
      if (out.damper_force_N.size() > 0) out.damper_force_N.row(sample * settings.substeps + k) = stepper.damper_force();
      if (k + 1 == settings.substeps) out.rms_displacement_m += (seen * stepper.displacement()).cwiseAbs2();
    }
  }
  out.rms_displacement_m = (out.rms_displacement_m / static_cast<double>(n_samples)).cwiseSqrt();
  return out;
}

}  // namespace

ConditionModel condition_model(const CampaignSettings& settings, const ConditionSettings& condition, const BridgeState& state,
                               const std::vector<sensors::LayoutPoint>& points) {
  ConditionModel out;
  out.settings = &condition;
  out.state = &state;
  MatrixXd loads(state.system.size(), 0);
  if (condition.dampers) fit_dampers(settings, out, loads);
  const linalg::SparseMatrix stiffness = state.system.stiffness(state.theta), mass = state.system.mass(state.theta);
  MatrixXd corrections(state.system.size(), 0);
  if (condition.dampers) {
    linalg::Cholesky factor;
    const Status status = factor.factorize(stiffness);
    if (!status.converged) throw InputError({settings.bridge, 0, ""}, "has a singular stiffness matrix: " + status.message);
    corrections = transient::static_corrections(factor, mass, state.modes.shapes, loads, loads.cols());
  }
  // Corrections are orthogonal to the modes in K and M, so that they come after them, above the last one's frequency.
  out.basis = transient::reduced_basis(stiffness, mass, state.modes.shapes, corrections);
  out.n_modes = state.modes.shapes.cols();
  const Index r = out.basis.omega_rad_s.size(), n = out.n_modes;
  out.at_dampers = loads.transpose() * out.basis.vectors;
  out.damping = VectorXd::Constant(r, settings.correction_damping);
  out.damping.head(n) = imposed_damping(state, settings);

  const MatrixXd full = state.system.expand(out.basis.vectors.leftCols(n));
  const std::vector<LoadedNode> loaded = loaded_nodes(condition, state, points);
  out.loads.resize(n, 3 * std::ssize(loaded));
  for (std::size_t i = 0; i < loaded.size(); ++i)
    out.loads.middleCols(3 * static_cast<Index>(i), 3) = loaded[i].density * full.middleRows(6 * loaded[i].node, 3).transpose();
  if ((out.loads.rowwise().squaredNorm().array() <= 0.0).any())
    throw InputError({"", 0, "force.deck"}, "leaves modes without load", "give a force on decks, stays and mast");
  out.load_covariance = MatrixXd::Zero(r, r);
  out.load_covariance.topLeftCorner(n, n) = out.loads * out.loads.transpose();
  return out;
}

Motion simulate(const ConditionModel& model, const CampaignSettings& settings, const RecordSettings& record,
                const std::vector<sensors::LayoutChannel>& channels, const std::vector<sensors::LayoutPoint>& points,
                std::uint64_t seed, std::uint64_t stream) {
  const Index r = model.basis.omega_rad_s.size(), n = model.n_modes;
  const MatrixXd seen = at_channels(*model.state, model.basis.vectors, channels);
  const auto n_samples = static_cast<Index>(std::lround(record.duration_s * settings.rate_Hz));
  transient::TrapezoidalStepper stepper = stepper_of(model, settings);

  Index warm_up = static_cast<Index>(std::lround(kWarmUp_s * settings.rate_Hz));
  if (record.kind == "free_decay") {
    warm_up = 0;
    const auto at = std::ranges::find(points, record.point, &sensors::LayoutPoint::name);
    TWINDECK_ASSERT(at != points.end());
    const MatrixXd down = at_channels(*model.state, model.basis.vectors, {sensors::channel_at(*at, "vertical", "")});
    const VectorXd load = -record.mass_kg * model.state->chains.model.gravity_m_s2 * down.transpose();
    stepper.start(load.cwiseQuotient(model.basis.omega_rad_s.cwiseAbs2()), load);
  }

  // A force of density S [N²/Hz, one-sided] sampled at f has the variance S f / 2.
  const double intensity = std::sqrt(0.5 * settings.rate_Hz);
  AmbientLoads loads(model.loads, intensity, seed, stream);
  VectorXd load = VectorXd::Zero(r);
  const auto load_at = [&](Index sample) -> const VectorXd& {
    load.head(n) = loads.at(sample + warm_up);
    return load;
  };
  return motion_under(load_at, nullptr, warm_up, n_samples, seen, model, settings, stepper);
}

MatrixXd logged_record(const Motion& motion, const CampaignSettings& settings, std::uint64_t seed, std::uint64_t record) {
  constexpr std::uint64_t kLoggerStreams = 1000;  // beyond the loads' streams, which have one a record
  MatrixXd out = motion.acceleration_m_s2;
  const sensors::LoggerErrors errors{settings.noise, settings.converter_step, settings.range, settings.drift};
  for (Index c = 0; c < out.cols(); ++c)
    out.col(c) = sensors::logged(out.col(c), errors, seed, kLoggerStreams * (record + 1) + static_cast<std::uint64_t>(c));
  return out;
}

TrueModes true_modes(const ConditionModel& model, const CampaignSettings& settings, const MatrixXd& damper_force_N,
                     double highest_Hz) {
  const std::size_t d = model.dampers.size();
  TrueModes out;
  out.slip.resize(static_cast<Index>(d));
  for (std::size_t j = 0; j < d; ++j)
    out.slip[static_cast<Index>(j)] = transient::equivalent_slip(model.dampers[j], damper_force_N.col(static_cast<Index>(j)));
  const transient::LinearisedModes modes = transient::linearised_modes(model.basis.omega_rad_s, model.damping, model.at_dampers,
                                                                       model.dampers, out.slip, highest_Hz);
  out.frequency_Hz = modes.frequency_Hz;
  out.damping_ratio = modes.damping_ratio;
  out.shapes = modes.shapes.colwise().normalized();
  out.name.resize(static_cast<std::size_t>(out.frequency_Hz.size()));
  // Shares of the undamped modes in the shape: exact for the stays', as modes are orthogonal in M.
  const MatrixXd share = out.shapes.cwiseAbs2();
  out.stay_share = share.topRows(model.n_modes).transpose() * model.state->stay_share;
  // A mode keeps its name only if it moves the decks and at least a fifth of it is the old mode.
  constexpr double kLeastShare = 0.2;
  const Eigen::RowVectorXd moves_decks = (out.stay_share.transpose().array() < 0.5).cast<double>();
  const MatrixXd named = share(model.state->named, Eigen::all).array().rowwise() * moves_decks.array();
  const std::vector<int> followed = matching::follow_modes(named);
  for (std::size_t i = 0; i < followed.size(); ++i) {
    if (followed[i] < 0 || named(static_cast<Index>(i), followed[i]) < kLeastShare) continue;
    out.name[static_cast<std::size_t>(followed[i])] = settings.named[i].name;
  }
  return out;
}

VectorXd participation(const ConditionModel& model, const TrueModes& modes, const MatrixXd& channel_shapes) {
  MatrixXd variance = (channel_shapes * modes.shapes).cwiseAbs2();
  for (Index i = 0; i < variance.cols(); ++i) {
    const double load = (modes.shapes.col(i).adjoint() * model.load_covariance * modes.shapes.col(i)).value().real();
    variance.col(i) *= load * std::numbers::pi * modes.frequency_Hz[i] / (4.0 * modes.damping_ratio[i]);
  }
  const VectorXd total = variance.rowwise().sum();
  return (variance.array().colwise() / total.array()).colwise().maxCoeff();
}

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
  const Index n_samples = force.cols();
  const auto warm_up = std::min<Index>(n_samples, static_cast<Index>(std::lround(kRampUp_s * settings.rate_Hz)));
  const auto load_at = [&](Index sample) -> VectorXd {
    const double rise = std::min(1.0, 2.0 * static_cast<double>(sample + warm_up) / static_cast<double>(warm_up));
    return rise * force.col((sample + n_samples) % n_samples);
  };
  transient::TrapezoidalStepper stepper = stepper_of(model, settings);
  return motion_under(load_at, &self, warm_up, n_samples, at_channels(*model.state, model.basis.vectors, channels), model,
                      settings, stepper);
}

}  // namespace twindeck::ponte
