#include "steps/campaign/test_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "aero/files/turbulence_files.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fe/assembly_parameters.hpp"
#include "io/csv.hpp"
#include "io/npy.hpp"
#include "model_io/write_model.hpp"
#include "ponte/virtual_bridge/simulated_records.hpp"
#include "ponte/virtual_bridge/stay_records.hpp"
#include "ponte/virtual_bridge/tuning.hpp"
#include "steps/campaign/campaign_files.hpp"
#include "steps/layout/layout_files.hpp"
#include "steps/wind/aerodynamics_config.hpp"
#include "steps/wind/deck_files.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kHighestTruth_Hz = 3.0;

Status write_calibration(const ponte::VirtualBridge& bridge, const ponte::CampaignSettings& settings,
                         const runner::StepContext& context) {
  const ponte::BridgeTuning found = tune(bridge, settings, context);
  io::CsvWriter csv({"parameter", "factor"});
  for (std::size_t i = 0; i < bridge.undivided.parameters.size(); ++i) {
    const auto at = static_cast<Index>(i);
    csv.row({bridge.undivided.parameters[i].name, fmt::format("{:.6f}", found.theta[at] / bridge.uncorrected[at])});
  }
  csv.save(context.out / "corrections.csv");
  return found.status;
}

struct Simulated {
  MatrixXd damper_force_N;
  VectorXd rms_displacement_m;
};

/// What the step reads.
struct CampaignInputs {
  ponte::VirtualBridge bridge;
  std::vector<sensors::LayoutPoint> points;
  std::vector<sensors::LayoutChannel> layout;
  std::vector<RecordFile> files;
  VectorXd theta;                          ///< corrected parameters
  std::optional<ponte::VirtualWind> wind;  ///< where a record is of a wind event
};

/// What wind events of the virtual bridge rest on: the configuration of step 7 that the settings name, its decks, turbulence.
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

/// Names in the settings that the layout and the bridge must have.
void refuse_unknown_names(const ponte::CampaignSettings& settings, const CampaignInputs& read) {
  for (const ponte::RecordSettings& record : settings.records) {
    const auto is_its = [&](const sensors::LayoutPoint& point) { return point.name == record.point; };
    if (record.kind == "free_decay" && std::none_of(read.points.begin(), read.points.end(), is_its))
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

/// Records of the decks, each with random streams of its own, so that threads change nothing.
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

/// Records of single stays.
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

/// Position of a condition's longest ambient or wind record.
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

/// What is true of each condition's longest record. @return how large the motion was in it, by condition
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
    const MatrixXd& force = simulated[*longest].damper_force_N;
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

  // 3. What is true, and what a reader needs.
  const std::map<std::string, Amplitude> amplitudes = write_truth(context, settings, read, models, simulated, stays);
  model_io::write_model(fe::with_parameters(bridge.undivided, read.theta), context.out / "truth" / "model");
  write_campaign_files(settings, read.layout, stays, read.files, amplitudes, context.out);
  return {};
}

}  // namespace

runner::Computation read_test_campaign(runner::StepContext& context, const ponte::CampaignSettings& settings) {
  CampaignInputs read;
  read.bridge = ponte::read_virtual_bridge(context.input(settings.bridge), settings);
  if (!context.has_flag("calibrate")) {
    read.points = read_points(context.input(settings.points));
    read.layout = read_setups(context.input(settings.setups), read.points);
    read.files = record_files(settings, read.layout);
    read.theta = ponte::corrected_parameters(read.bridge,
                                             settings.corrections.empty() ? fs::path() : context.input(settings.corrections));
    refuse_unknown_names(settings, read);
    for (const ponte::RecordSettings& record : settings.records)
      if (record.kind == "wind" && !read.wind) read.wind = read_virtual_wind(context, settings);
  }
  return [&context, &settings, read = std::move(read)] { return run_test_campaign(context, settings, read); };
}

}  // namespace twindeck::steps
