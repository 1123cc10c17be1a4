#include "steps/campaign/test_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "aero/files/turbulence_files.hpp"
#include "aero/yaw_rule.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fe/assembly_parameters.hpp"
#include "io/csv.hpp"
#include "io/npy.hpp"
#include "model_io/write_model.hpp"
#include "ponte/virtual_bridge/simulated_records.hpp"
#include "ponte/virtual_bridge/stay_records.hpp"
#include "ponte/virtual_bridge/virtual_bridge.hpp"
#include "steps/campaign/campaign_files.hpp"
#include "steps/layout/layout_files.hpp"
#include "steps/shared/config_parts.hpp"
#include "steps/wind/aerodynamics_config.hpp"
#include "steps/wind/deck_files.hpp"

namespace twindeck::steps {

namespace {

constexpr double kHighestTruth_Hz = 3.0;

Status write_calibration(const ponte::VirtualBridge& bridge, const ponte::CampaignSettings& settings,
                         const runner::StepContext& context) {
  const ponte::BridgeTuning found = tune(bridge, settings, context);
  io::CsvWriter csv({"parameter", "factor"});
  for (std::size_t i = 0; i < bridge.undivided.parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    csv.row({bridge.undivided.parameters[i].name, fmt::format("{:.6f}", found.theta[at] / bridge.uncorrected[at])});
  }
  csv.save(context.out / "corrections.csv");
  return found.status;
}

struct Simulated {
  Eigen::MatrixXd damper_force_N;
  Eigen::VectorXd rms_displacement_m;
};

struct CampaignInputs {
  ponte::VirtualBridge bridge;
  std::vector<sensors::LayoutPoint> points;
  std::vector<sensors::LayoutChannel> layout;
  std::vector<RecordFile> files;
  Eigen::VectorXd theta;                   ///< corrected parameters
  std::optional<ponte::VirtualWind> wind;  ///< set if a record is of a wind event
};

/// Data of wind events: the configuration of step 7 that the settings name, its decks, and the turbulence.
ponte::VirtualWind read_virtual_wind(runner::StepContext& context, const ponte::CampaignSettings& settings) {
  ponte::VirtualWind out;
  AerodynamicsConfig config;
  io::FieldTable fields = config.fields();
  fields.load(context.input(settings.wind_aerodynamics));
  fields.require();
  out.aerodynamics = config;
  out.data = read_deck_aerodynamics(out.aerodynamics, context);
  out.turbulence = aero::read_turbulence_set(context.input(settings.wind_turbulence_file), settings.wind_turbulence_set);
  return out;
}

/// Refuses names in the settings that the layout or the bridge does not have.
void refuse_unknown_names(const ponte::CampaignSettings& settings, const CampaignInputs& read) {
  for (const ponte::RecordSettings& record : settings.records) {
    const auto is_its = [&](const sensors::LayoutPoint& point) { return point.name == record.point; };
    if (record.kind == "free_decay" && std::ranges::none_of(read.points, is_its))
      throw InputError({"", 0, "record.point"}, "'" + record.point + "' is no point of the layout", "name a row of points.csv");
  }
  for (const ponte::StayTest& test : settings.stays) static_cast<void>(ponte::stay_of(read.bridge.undivided, test));
  for (const ponte::ConditionSettings& condition : settings.conditions)
    static_cast<void>(ponte::at_temperature(read.bridge, settings, read.theta, condition.temperature_C));
}

/// The bridge in each condition, in the order of the settings.
using ConditionModels = std::vector<ponte::ConditionModel>;

const ponte::ConditionModel& model_of(const ConditionModels& models, const ponte::CampaignSettings& settings,
                                      const std::string& condition) {
  return models[static_cast<std::size_t>(&settings.condition(condition) - settings.conditions.data())];
}

/// Records of the decks. Each has random streams of its own, so that the number of threads changes nothing.
std::vector<Simulated> simulate_decks(const runner::StepContext& context, const ponte::CampaignSettings& settings,
                                      const CampaignInputs& read, const ConditionModels& models) {
  std::vector<Simulated> simulated(settings.records.size());
  parallel_for(settings.records.size(), [&](std::size_t i) {
    const ponte::RecordSettings& record = settings.records[i];
    const ponte::ConditionModel& model = model_of(models, settings, record.condition);
    const std::vector<sensors::LayoutChannel> channels = sensors::channels_of(read.layout, record.setup);
    ponte::Motion motion = record.kind == "wind"
                               ? ponte::simulate_wind(model, settings, record, *read.wind, channels, context.seed, i)
                               : ponte::simulate(model, settings, record, channels, read.points, context.seed, i);
    io::write_npy_single(ponte::logged_record(motion, settings, context.seed, i), context.out / read.files[i].file);
    simulated[i] = {std::move(motion.damper_force_N), std::move(motion.rms_displacement_m)};
  });
  return simulated;
}

std::vector<ponte::StayRecord> simulate_stays(const runner::StepContext& context, const ponte::CampaignSettings& settings,
                                              const CampaignInputs& read, const fe::Model& bridge) {
  std::vector<ponte::StayRecord> stays;
  for (std::size_t i = 0; i < settings.stays.size(); ++i) {
    const std::uint64_t stream = settings.records.size() + i;
    stays.push_back(ponte::stay_record(bridge, settings.stays[i], settings, context.seed, stream));
    ponte::Motion motion;
    motion.acceleration_m_s2 = stays.back().acceleration_m_s2;
    io::write_npy_single(ponte::logged_record(motion, settings, context.seed, stream),
                         context.out / read.files[settings.records.size() + i].file);
  }
  return stays;
}

std::optional<std::size_t> longest_record(const ponte::CampaignSettings& settings, const std::string& condition) {
  std::optional<std::size_t> longest;
  for (std::size_t i = 0; i < settings.records.size(); ++i) {
    const ponte::RecordSettings& r = settings.records[i];
    if (r.condition == condition && (r.kind == "ambient" || r.kind == "wind") &&
        (!longest || r.duration_s > settings.records[*longest].duration_s))
      longest = i;
  }
  return longest;
}

/// Writes the true values of each condition's longest record. @return RMS motion in that record, by condition
std::map<std::string, Amplitude> write_truth(const runner::StepContext& context, const ponte::CampaignSettings& settings,
                                             const CampaignInputs& read, const ConditionModels& models,
                                             const std::vector<Simulated>& simulated,
                                             const std::vector<ponte::StayRecord>& stays) {
  TruthTables truth;
  std::map<std::string, Amplitude> amplitudes;
  for (const ponte::ConditionSettings& condition : settings.conditions) {
    const std::optional<std::size_t> longest = longest_record(settings, condition.name);
    if (!longest) continue;
    const ponte::ConditionModel& model = model_of(models, settings, condition.name);
    const Eigen::MatrixXd& force = simulated[*longest].damper_force_N;
    truth.add(condition.name, settings, model, ponte::true_modes(model, settings, force, kHighestTruth_Hz), read.layout, force);
    const auto channels = sensors::channels_of(read.layout, settings.records[*longest].setup);
    amplitudes[condition.name] = {channels.front().channel, simulated[*longest].rms_displacement_m[0]};
  }
  truth.save(settings, stays, context.out / "truth");
  return amplitudes;
}

Status run_test_campaign(runner::StepContext& context, const ponte::CampaignSettings& settings, const CampaignInputs& read) {
  // 1. The bridge as it is built, in each condition.
  const ponte::VirtualBridge bridge = ponte::numbered(read.bridge);
  if (context.has_flag("calibrate")) return write_calibration(bridge, settings, context);
  const std::map<double, ponte::BridgeState> states = ponte::solve_states(bridge, settings, read.theta);
  ConditionModels models;
  for (const ponte::ConditionSettings& condition : settings.conditions)
    models.push_back(ponte::condition_model(settings, condition, states.at(condition.temperature_C), read.points));
  context.say(fmt::format("virtual bridge: {} degrees of freedom, {} modes to {:.2f} Hz", states.begin()->second.system.size(),
                          settings.modes, states.begin()->second.modes.frequency_Hz.tail(1)[0]));

  // 2. Records of the decks, then of single stays.
  const std::vector<Simulated> simulated = simulate_decks(context, settings, read, models);
  const std::vector<ponte::StayRecord> stays = simulate_stays(context, settings, read, bridge.undivided);

  // 3. True values, and the files that a reader needs.
  const std::map<std::string, Amplitude> amplitudes = write_truth(context, settings, read, models, simulated, stays);
  model_io::write_model(fe::with_parameters(bridge.undivided, read.theta), context.out / "truth" / "model");
  write_campaign_files(settings, read.layout, stays, read.files, amplitudes, context.out);
  return {};
}

void bind_condition(io::FieldTable& t, ponte::ConditionSettings& c) {
  t.path_name("name", c.name, "condition", "name, as records refer to it", true)
      .boolean("dampers", c.dampers, "whether the dampers are fitted")
      .number("temperature", c.temperature_C, "degC", {-30.0, 60.0}, "temperature of the structure")
      .number("wind", c.wind_m_s, "m/s", io::non_negative(), "mean wind speed; only written to conditions.toml")
      .integer("people", c.people, io::non_negative(), "number of people on the bridge; only written to conditions.toml")
      .number("force.deck", c.force_deck, "", io::non_negative(),
              "white-noise force on each edge point of the decks in each of three directions, N/sqrt(Hz)")
      .number("force.stay", c.force_stay, "", io::non_negative(),
              "white-noise force on each inner node of a stay in each of three directions, N/sqrt(Hz)")
      .number("force.mast", c.force_mast, "", io::non_negative(),
              "white-noise force on the head of the mast in each of three directions, N/sqrt(Hz)");
}

void bind_record(io::FieldTable& t, ponte::RecordSettings& r) {
  t.path_name("setup", r.setup, "setup", "setup in the file of setups", true)
      .choice("kind", r.kind, {"ambient", "free_decay", "wind"},
              "kind of the record: ambient, free decay after the release of a suspended mass, or wind event")
      .path_name("condition", r.condition, "condition", "name of the condition", true)
      .number("duration", r.duration_s, "s", {0.0, io::longest_record_s, true}, "length of the record", true)
      .number("mass", r.mass_kg, "kg", io::non_negative(), "free_decay: suspended mass that is released")
      .text("point", r.point, "free_decay: point from which the mass is suspended")
      .number("speed", r.speed_m_s, "m/s", {0.0, io::highest_wind_m_s}, "wind: mean wind speed at the decks")
      .number("direction_deg", r.direction_deg, "", {-360.0, 360.0},
              "wind: direction towards which the wind blows, degrees anticlockwise from +X");
}

void bind_stay(io::FieldTable& t, ponte::StayTest& s) {
  t.path_name("stay", s.stay, "stay", "name of the stay", true)
      .path_name("condition", s.condition, "condition", "condition of the record", true)
      .number("pull", s.pull_N, "N", io::positive(), "tension T of the stay", true)
      .number("lambda_squared", s.lambda_squared, "", io::non_negative(),
              "Irvine's parameter lambda^2, from which the axial stiffness follows", true)
      .number("damping", s.damping_ratio, "", {0.0, 0.2, true}, "damping ratio of every mode", true)
      .numbers("imposed", s.imposed_Hz, "Hz", io::positive(),
               "imposed frequencies of the first in-plane modes; empty: those of the cable");
}

}  // namespace

runner::Computation read_test_campaign(runner::StepContext& context, const ponte::CampaignSettings& settings) {
  CampaignInputs read;
  read.bridge = ponte::read_virtual_bridge(context.input(settings.bridge), settings);
  if (!context.has_flag("calibrate")) {
    read.points = read_points(context.input(settings.points));
    read.layout = read_setups(context.input(settings.setups), read.points);
    read.files = record_files(settings, read.layout);
    read.theta = ponte::corrected_parameters(
        read.bridge, settings.corrections.empty() ? std::filesystem::path() : context.input(settings.corrections));
    refuse_unknown_names(settings, read);
    for (const ponte::RecordSettings& record : settings.records)
      if (record.kind == "wind" && !read.wind) read.wind = read_virtual_wind(context, settings);
  }
  return [&context, &settings, read = std::move(read)] { return run_test_campaign(context, settings, read); };
}

io::FieldTable CampaignConfig::fields() {
  io::FieldTable table;
  table.text("bridge", bridge, "definition of the virtual bridge (variant as_built)", true)
      .text("corrections", corrections, "file of correction factors of the parameters, found by --calibrate; empty: none")
      .text("points", points, "file of possible sensor points", true)
      .text("setups", setups, "file of sensor setups: channels at points", true)
      .integer("modes", modes, {10.0, 1000.0}, "number of modes in the basis of the time histories")
      .integer("zones", zones, {1.0, 50.0},
               "number of zones from mid-length to the ends; each has its own corrections of members and masses")
      .texts("vibrating_stays", vibrating_stays, "stays divided into elements, with modes of their own; the others are springs")
      .integer("stay_pieces", stay_pieces, {2.0, 100.0}, "number of elements of each divided stay")
      .number("unevenness", unevenness, "", {0.0, 0.3}, "relative standard deviation of the thickness of the slabs")
      .number("unevenness_wavelength", unevenness_wavelength_m, "m", io::positive(), "longest wavelength of that variation")
      .number("reference_temperature", reference_temperature_C, "degC", {-30.0, 60.0},
              "temperature at which the frequencies of [[mode]] hold")
      .number("damping.structure", other_damping, "", {0.0, 0.2, true}, "damping ratio of modes that [[mode]] does not name")
      .number("damping.stays", stay_damping, "", {0.0, 0.2, true},
              "damping ratio of stays; a mode gets the mean of structure and stays, weighted by kinetic energy")
      .number("damping.corrections", correction_damping, "", {0.0, 1.0, true}, "damping ratio of the static correction shapes")
      .tables("mode",
              rows_of(named,
                      [](io::FieldTable& t, ponte::NamedMode& m) {
                        t.text("name", m.name, "name in the paper's Table 4", true)
                            .number("frequency", m.frequency_Hz, "Hz", io::positive(), "undamped natural frequency", true)
                            .number("damping", m.damping_ratio, "", {0.0, 0.2, true}, "damping ratio without dampers", true)
                            .integer(
                                "deck_mode", m.deck_mode, {1.0, 1000.0},
                                "position among the uncorrected deck modes (not mostly stays), from which calibration starts",
                                true);
                      }),
              "a mode with imposed frequency and damping", "name")
      .tables("temperature_effect",
              rows_of(temperature,
                      [](io::FieldTable& t, ponte::TemperatureEffect& e) {
                        t.text("parameter", e.parameter, "parameter of the bridge definition", true)
                            .number("per_K", e.per_K, "", {-0.1, 0.1}, "relative change per kelvin", true);
                      }),
              "effect of temperature on one parameter", "parameter")
      .tables("damper",
              rows_of(dampers,
                      [](io::FieldTable& t, ponte::DamperSettings& d) {
                        t.text("type", d.type, "type in the bridge definition", true)
                            .number("mount_stiffness", d.mount_stiffness_N_m, "N/m", io::non_negative(),
                                    "stiffness of the anchorage; 0: that of the damper's own spring")
                            .number("mount_loss_factor", d.mount_loss_factor, "", {0.0, 2.0},
                                    "loss factor of the mount at 1 Hz")
                            .number("friction", d.friction_N, "N", io::non_negative(),
                                    "friction force below which the dashpot does not move");
                      }),
              "data of a type of damper that the bridge definition lacks", "type")
      .tables("condition", rows_of(conditions, bind_condition), "a condition", "name")
      .tables("record", rows_of(records, bind_record), "a record")
      .tables("stay_test", rows_of(stays, bind_stay), "a test of a stay with an accelerometer")
      .number("stay.duration", stay_duration_s, "s", {0.0, io::longest_record_s, true}, "length of a stay's record")
      .number("stay.force", stay_force, "", io::positive(), "white-noise force on each node of the stay, N/sqrt(Hz)")
      .number("stay.sensor", stay_sensor, "", {0.01, 0.5}, "position of the accelerometer, relative to the length of the stay")
      .number("logger.rate", rate_Hz, "Hz", {0.0, io::highest_rate_Hz, true}, "sampling rate")
      .integer("logger.substeps", substeps, {1.0, 100.0}, "number of integration steps between two samples")
      .integer("logger.second_lag", second_logger_lag, {0.0, 100.0},
               "number of integration steps by which the second logger (second half of the channels) lags")
      .number("logger.noise", noise, "m/s^2", io::non_negative(), "RMS of each sensor's noise")
      .number("logger.step", converter_step, "m/s^2", io::non_negative(), "resolution of the analogue-to-digital converter")
      .number("logger.range", range, "m/s^2", io::non_negative(), "largest reading; larger ones are clipped; 0: no limit")
      .number("logger.drift", drift, "m/s^2", io::non_negative(), "drift of the zero over a record")
      .text("wind.aerodynamics", wind_aerodynamics, "wind events: configuration of step 7, which gives decks and their data")
      .text("wind.turbulence_file", wind_turbulence_file, "wind events: file of turbulence sets")
      .text("wind.turbulence_set", wind_turbulence_set, "wind events: name of the set in wind.turbulence_file")
      .choice("wind.model", wind_model, aero::published_yaw_rule_names(),
              "wind events: model of Table 11 on the virtual bridge")
      .number("wind.height", wind_height_m, "m", io::positive(), "wind events: height of the decks above ground")
      .number("wind.level", wind_level, "", io::positive(), "wind events: level of the synthetic aerodynamic set")
      .number("calibration.spread", correction_spread, "", io::positive(),
              "prior standard deviation of the logarithm of a correction factor; smaller values penalise corrections more")
      .number("calibration.frequency", frequency_weight, "", io::positive(),
              "relative standard deviation of the named frequencies in the fit");
  return table;
}

}  // namespace twindeck::steps
