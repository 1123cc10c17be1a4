#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "blind/records.hpp"
#include "core/random.hpp"
#include "signal/condition.hpp"
#include "transient/trapezoidal.hpp"

namespace twindeck::blind {

namespace {

using diagnosis::Cause;
using diagnosis::Condition;
using diagnosis::ReducedPlace;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = 0.005, kSeconds = 600.0, kForcedBelow_Hz = 5.0, kSensorNoise = 0.03;
constexpr double kRigidMount = 1e9, kPersonMass = 75.0;
constexpr Index kModes = 80, kDecimation = 20;

/// Structure and dampers of one condition, in those of the truth's reduced coordinates that its causes need: vectors of other
/// places may hold the same motion once more.
struct State {
  std::vector<int> columns;
  MatrixXd stiffness, mass;
  MatrixXd at_dampers;  ///< (n_dampers × r)
  std::vector<transient::SlidingDamper> dampers;
};

std::vector<int> columns_of(const diagnosis::ReducedModel& model, const std::vector<Cause>& causes) {
  std::vector<int> columns(static_cast<std::size_t>(model.common));
  std::iota(columns.begin(), columns.end(), 0);
  for (const Cause& cause : causes)
    for (const ReducedPlace* place : cause.candidate->places)
      for (const int k : place->columns)
        if (std::find(columns.begin(), columns.end(), k) == columns.end()) columns.push_back(k);
  return columns;
}

/// The unit forces of a location (n_columns × k).
MatrixXd forces_of(const ReducedPlace& place, const std::vector<int>& columns) {
  MatrixXd forces(std::ssize(columns), place.directions.cols());
  for (Index d = 0; d < forces.cols(); ++d) forces.col(d) = place.directions.part(d, columns);
  return forces;
}

void apply(const Cause& cause, const Condition& condition, State& state) {
  for (const diagnosis::ActionSpec& action : cause.candidate->hypothesis->actions) {
    if (cause.candidate->places.empty()) continue;
    const ReducedPlace& place = *cause.candidate->places[0];
    const auto value = [&](const char* name) { return cause.candidate->value(action.number.at(name), cause.a); };
    const auto own = [&](const diagnosis::ReducedMatrix& full) { return full.part(state.columns); };
    if (action.primitive == diagnosis::Primitive::scale_stiffness)
      state.stiffness += (value("factor") - 1.0) * own(place.stiffness);
    if (action.primitive == diagnosis::Primitive::scale_mass) state.mass += (value("factor") - 1.0) * own(place.mass);
    if (action.primitive == diagnosis::Primitive::mass_add) {
      const MatrixXd b = forces_of(place, state.columns);
      state.mass += value("mass") * b * b.transpose();
    }
    if (action.primitive == diagnosis::Primitive::field_stiffness && condition.temperature_C)
      state.stiffness += value("rate") * (*condition.temperature_C - value("reference")) * own(place.stiffness);
    if (action.primitive == diagnosis::Primitive::step_stiffness && condition.temperature_C &&
        *condition.temperature_C < value("below"))
      state.stiffness += (value("factor") - 1.0) * own(place.stiffness);
    if (action.primitive == diagnosis::Primitive::element_spring && cause.candidate->places.size() == 2) {
      const ReducedPlace& other = *cause.candidate->places[1];
      const VectorXd b =
          (forces_of(place, state.columns) - forces_of(other, state.columns)) * (other.x_m - place.x_m).normalized();
      state.stiffness += value("stiffness") * b * b.transpose();
    }
  }
}

void add_damper(const ReducedPlace& damper, const std::vector<Cause>& causes, State& state) {
  const auto number = [&](const char* name) {
    const auto at = damper.attributes.find(name);
    return at == damper.attributes.end() ? 0.0 : at->second;
  };
  transient::SlidingDamper one{number("stiffness"), 0.0, number("damping"), number("friction")};
  bool series = number("series") != 0.0 || one.friction_N > 0.0;
  for (const Cause& cause : causes) {
    if (cause.candidate->places.empty() || cause.candidate->places[0] != &damper) continue;
    for (const diagnosis::ActionSpec& action : cause.candidate->hypothesis->actions) {
      const auto value = [&](const char* name) { return cause.candidate->value(action.number.at(name), cause.a); };
      if (action.primitive == diagnosis::Primitive::damper_absent) return;
      if (action.primitive == diagnosis::Primitive::damper_damping) one.damping_N_s_m *= value("factor");
      if (action.primitive == diagnosis::Primitive::damper_series ||
          action.primitive == diagnosis::Primitive::damper_friction) {
        one.stiffness_N_m = value("stiffness");
        series = true;
      }
      if (action.primitive == diagnosis::Primitive::damper_friction) one.friction_N = value("threshold");
    }
  }
  const VectorXd b = damper.directions.part(0, state.columns);
  if (!series) {  // spring and dashpot side by side, on a mount that does not give way
    state.stiffness += one.stiffness_N_m * b * b.transpose();
    one.stiffness_N_m = kRigidMount;
  }
  state.at_dampers.conservativeResize(state.at_dampers.rows() + 1, b.size());
  state.at_dampers.bottomRows(1) = b.transpose();
  state.dampers.push_back(one);
}

struct Modes {
  VectorXd omega;
  MatrixXd shapes;
};

/// M phi = 1/omega² K phi: static corrections hardly have a mass, and rank last.
Modes modes_of(const State& state) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(state.mass, state.stiffness);
  const Index n = state.mass.rows();
  Modes modes;
  Index count = 0;
  while (count < std::min(kModes, n) && eigen.eigenvalues()[n - 1 - count] > 1e-9) ++count;
  modes.omega.resize(count);
  modes.shapes.resize(n, count);
  for (Index i = 0; i < count; ++i) {
    const double mu = eigen.eigenvalues()[n - 1 - i];
    modes.omega[i] = 1.0 / std::sqrt(mu);
    modes.shapes.col(i) = eigen.eigenvectors().col(n - 1 - i) / std::sqrt(mu);  // phi' M phi = 1
  }
  return modes;
}

struct Run {
  MatrixXd acceleration;  ///< (n_steps × n_channels)
  double rms_m = 0.0;     ///< at the amplitude's channel
};

Run integrate(const Modes& modes, const VectorXd& damping, const State& state, const MatrixXd& channels,
              Index amplitude_channel, double force, double seconds, std::uint64_t seed, std::uint64_t stream) {
  transient::TrapezoidalStepper stepper(modes.omega, damping, kStep);
  if (!state.dampers.empty()) stepper.set_dampers(state.at_dampers * modes.shapes, state.dampers);
  const Index r = modes.omega.size();
  stepper.start(VectorXd::Zero(r), VectorXd::Zero(r));
  const MatrixXd at_channels = channels * modes.shapes;
  const auto steps = static_cast<Index>(seconds / kStep), lead = static_cast<Index>(40.0 / kStep);
  Run run;
  run.acceleration.resize(steps, channels.rows());
  Index forced = 0;
  while (forced < r && modes.omega[forced] < 2.0 * std::numbers::pi * kForcedBelow_Hz) ++forced;
  VectorXd load = VectorXd::Zero(r);
  double square = 0.0;
  for (Index t = -lead; t < steps; ++t) {
    for (Index i = 0; i < forced; ++i)
      load[i] = force * normal_number(seed, stream + static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(t + lead));
    stepper.step(load);
    if (t < 0) continue;
    run.acceleration.row(t) = (at_channels * stepper.acceleration()).transpose();
    square += std::pow(at_channels.row(amplitude_channel).dot(stepper.displacement()), 2);
  }
  run.rms_m = std::sqrt(square / static_cast<double>(steps));
  return run;
}

/// What the trial's structure and sensors are, within their scatter.
struct Drawn {
  VectorXd x, gain;  ///< nuisances in deviations; factor of each channel
};

Drawn draw(const Bench& bench, const diagnosis::FeatureMap& map, std::uint64_t seed) {
  Drawn drawn{VectorXd(static_cast<Index>(map.nuisances().size())), VectorXd::Ones(static_cast<Index>(bench.channels.size()))};
  for (Index j = 0; j < drawn.x.size(); ++j) {
    const diagnosis::Nuisance& v = map.nuisances()[static_cast<std::size_t>(j)];
    std::uint64_t again = 0;
    do drawn.x[j] = normal_number(seed, 1, static_cast<std::uint64_t>(j) * 64 + again++);
    while (drawn.x[j] < v.lower || drawn.x[j] > v.upper);
    if (v.kind == diagnosis::Nuisance::Kind::gain) drawn.gain[v.index] = 1.0 + v.deviation * drawn.x[j];
  }
  return drawn;
}

/// The structure in a condition, with its people, causes and dampers.
State state_in(const Condition& condition, const diagnosis::ReducedModel& model, const std::vector<Cause>& causes,
               const std::pair<MatrixXd, MatrixXd>& matrices, const std::vector<int>& columns) {
  State state{columns, matrices.first, matrices.second, MatrixXd(0, std::ssize(columns)), {}};
  if (condition.people.value_or(0.0) > 0.0) {
    const ReducedPlace& deck = model.sets.at("global").front();
    state.mass += *condition.people * kPersonMass / deck.attributes.at("deck_mass") * deck.mass.part(columns);
  }
  for (const Cause& cause : causes) apply(cause, condition, state);
  if (condition.dampers_on.value_or(false))
    for (const ReducedPlace& damper : model.sets.at("dampers")) add_damper(damper, causes, state);
  return state;
}

VectorXd damping_of(Index modes, std::uint64_t seed) {
  VectorXd damping = VectorXd::Constant(modes, 0.01);
  for (Index i = 0; i < std::min<Index>(12, modes); ++i)
    damping[i] = 0.005 * std::exp(0.3 * normal_number(seed, 2, static_cast<std::uint64_t>(i)));
  return damping;
}

/// What is wrong with the sensors, done to a run.
void disturb(const std::vector<Cause>& causes, MatrixXd& acceleration) {
  for (const Cause& cause : causes)
    for (const diagnosis::ActionSpec& action : cause.candidate->hypothesis->actions) {
      const auto& at = cause.candidate->channels;
      if (action.primitive == diagnosis::Primitive::channel_gain)
        acceleration.col(at[0]) *= cause.candidate->value(action.number.at("factor"), cause.a);
      if (action.primitive == diagnosis::Primitive::channel_sign) acceleration.col(at[0]) *= -1.0;
      if (action.primitive == diagnosis::Primitive::channel_swap) acceleration.col(at[0]).swap(acceleration.col(at[1]));
    }
}

/// At the logger's rate, with the sensors' noise.
MatrixXd logged(const MatrixXd& acceleration, std::uint64_t seed, std::uint64_t stream) {
  MatrixXd record = signal::decimated(acceleration, kDecimation);
  const double noise = kSensorNoise * std::sqrt(record.squaredNorm() / static_cast<double>(record.size()));
  for (Index ch = 0; ch < record.cols(); ++ch)
    for (Index t = 0; t < record.rows(); ++t)
      record(t, ch) += noise * normal_number(seed, stream + static_cast<std::uint64_t>(ch), static_cast<std::uint64_t>(t));
  return record;
}

}  // namespace

const std::set<std::string>& families_of_integrated_records() {
  static const std::set<std::string> families = {"brg",  "dampabsent", "dampc",    "foundation", "freeze", "fric",
                                                 "gain", "joint",      "mass",     "pol",        "stay",   "stiffness",
                                                 "swap", "tempE",      "tempStay", "tie"};
  return families;
}

Campaign integrated_records(const Bench& bench, const Hidden& hidden) {
  Campaign campaign;
  campaign.conditions = bench.rows.conditions;
  campaign.rate_Hz = 1.0 / (kStep * kDecimation);
  const std::uint64_t seed = hidden.seal.seed + 777;
  const diagnosis::ReducedModel& model = *bench.truth.reduced;
  const diagnosis::FeatureMap map(model, bench.rows, bench.scatter);
  const Drawn drawn = draw(bench, map, seed);
  const diagnosis::FeatureMap::Base base = map.base(drawn.x);
  const std::vector<int> columns = columns_of(model, hidden.causes);
  MatrixXd channels(drawn.gain.size(), static_cast<Index>(columns.size()));
  for (Index c = 0; c < drawn.gain.size(); ++c) channels.row(c) = model.sensors.row(4 * c)(columns);
  for (std::size_t c = 0; c < campaign.conditions.size(); ++c) {
    Condition& condition = campaign.conditions[c];
    const State state = state_in(condition, model, hidden.causes, map.matrices(base, columns), columns);
    const Modes modes = modes_of(state);
    const VectorXd damping = damping_of(modes.omega.size(), seed);
    Index amplitude_channel = 0;
    for (std::size_t k = 0; k < bench.rows.channels.size(); ++k)
      if (bench.rows.channels[k] == condition.amplitude_channel) amplitude_channel = static_cast<Index>(k);
    const std::uint64_t stream = 10000 * (c + 1);
    double force = 1.0;
    for (int pass = 0; pass < 3; ++pass) {  // forces that give the amplitude: where friction slips it does not grow with them
      const Run trial = integrate(modes, damping, state, channels, amplitude_channel, force, 120.0, seed, stream + 5000);
      force *= condition.amplitude_m.value_or(3e-4) / trial.rms_m;
    }
    Run run = integrate(modes, damping, state, channels, amplitude_channel, force, kSeconds, seed, stream);
    condition.amplitude_m = run.rms_m;
    run.acceleration *= drawn.gain.asDiagonal();
    disturb(hidden.causes, run.acceleration);
    campaign.records.push_back(logged(run.acceleration, seed, stream + 9000));
  }
  return campaign;
}

}  // namespace twindeck::blind
