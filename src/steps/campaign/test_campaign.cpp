#include "steps/campaign/test_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "io/csv.hpp"
#include "io/npy.hpp"
#include "sensors/logger.hpp"
#include "steps/campaign/campaign_files.hpp"
#include "steps/campaign/virtual_calibration.hpp"
#include "steps/campaign/virtual_records.hpp"
#include "steps/campaign/virtual_stays.hpp"
#include "steps/campaign/virtual_wind.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kHighestTruth_Hz = 3.0;

Status write_calibration(const VirtualBridge& bridge, const CampaignSettings& settings, const StepContext& context) {
  const BridgeTuning found = tune(bridge, settings, context);
  io::CsvWriter csv({"parameter", "factor"});
  for (std::size_t i = 0; i < bridge.undivided.parameters.size(); ++i) {
    const auto at = static_cast<Index>(i);
    csv.row({bridge.undivided.parameters[i].name, fmt::format("{:.6f}", found.theta[at] / bridge.uncorrected[at])});
  }
  csv.save(context.out / "corrections.csv");
  return found.status;
}

/// Refuses corrections that were found for other frequencies or for another bridge. @param state  with the corrections,
/// untouched by temperature
void refuse_stale_corrections(const CampaignSettings& settings, const BridgeState& state) {
  constexpr double kAllowed = 0.002;  // [-] ten times what --calibrate ends at: rounding and a mode that turns do not reach it
  if (settings.corrections.empty()) return;
  for (std::size_t i = 0; i < settings.named.size(); ++i) {
    const NamedMode& wanted = settings.named[i];
    const double f_Hz = state.modes.frequency_Hz[state.named[i]];
    if (std::abs(f_Hz / wanted.frequency_Hz - 1.0) > kAllowed)
      throw InputError(
          {settings.corrections, 0, "factor"},
          fmt::format("the bridge has mode {} at {:.4f} Hz, expected {:g} Hz within {:g} %, as mode.frequency says",
                      wanted.name, f_Hz, wanted.frequency_Hz, 100.0 * kAllowed),
          "find corrections for it with --calibrate and corrections = \"\"");
  }
}

/// States of the bridge by temperature: each is solved once.
std::map<double, BridgeState> solve_states(const VirtualBridge& bridge, const CampaignSettings& settings,
                                           const VectorXd& theta) {
  std::map<double, BridgeState> states;
  const BridgeState& reference =
      states.emplace(settings.reference_temperature_C, solve_bridge(bridge, settings, theta, settings.modes)).first->second;
  refuse_stale_corrections(settings, reference);
  for (const ConditionSettings& condition : settings.conditions) {
    if (states.contains(condition.temperature_C)) continue;
    BridgeState state =
        solve_bridge(bridge, settings, at_temperature(bridge, settings, theta, condition.temperature_C), settings.modes);
    state.named = follow_named(reference, state);
    states.emplace(condition.temperature_C, std::move(state));
  }
  return states;
}

/// What the loggers made of a motion.
MatrixXd logged_record(const Motion& motion, const CampaignSettings& settings, std::uint64_t seed, std::uint64_t record) {
  constexpr std::uint64_t kLoggerStreams = 1000;  // beyond the loads' streams, which have one a record
  MatrixXd out = motion.acceleration_m_s2;
  const sensors::LoggerErrors errors{settings.noise, settings.converter_step, settings.range, settings.drift};
  for (Index c = 0; c < out.cols(); ++c) {
    out.col(c) = sensors::logged(out.col(c), errors, seed, kLoggerStreams * (record + 1) + static_cast<std::uint64_t>(c));
  }
  return out;
}

struct Simulated {
  MatrixXd damper_force_N;
  VectorXd rms_displacement_m;
};

/// What the step reads.
struct CampaignInputs {
  VirtualBridge bridge;
  std::vector<LayoutPoint> points;
  std::vector<LayoutChannel> layout;
  std::vector<RecordFile> files;
  VectorXd theta;                   ///< corrected parameters
  std::optional<VirtualWind> wind;  ///< where a record is of a wind event
};

/// Names in the settings that the layout and the bridge must have.
void refuse_unknown_names(const CampaignSettings& settings, const CampaignInputs& read) {
  for (const RecordSettings& record : settings.records) {
    const auto is_its = [&](const LayoutPoint& point) { return point.name == record.point; };
    if (record.kind == "free_decay" && std::none_of(read.points.begin(), read.points.end(), is_its))
      throw InputError({"", 0, "record.point"}, "'" + record.point + "' is no point of the layout", "name a row of points.csv");
  }
  for (const StayTest& test : settings.stays) static_cast<void>(stay_of(read.bridge.undivided, test));
  for (const ConditionSettings& condition : settings.conditions)
    static_cast<void>(at_temperature(read.bridge, settings, read.theta, condition.temperature_C));
}

Status run_test_campaign(StepContext& context, const CampaignSettings& settings, const CampaignInputs& read) {
  // 1. The bridge as it is built.
  const VirtualBridge bridge = numbered(read.bridge);
  if (context.has_flag("calibrate")) return write_calibration(bridge, settings, context);
  const std::vector<LayoutPoint>& points = read.points;
  const std::vector<LayoutChannel>& layout = read.layout;
  const std::vector<RecordFile>& files = read.files;
  const std::map<double, BridgeState> states = solve_states(bridge, settings, read.theta);
  std::vector<ConditionModel> models;
  for (const ConditionSettings& condition : settings.conditions)
    models.push_back(condition_model(settings, condition, states.at(condition.temperature_C), points));
  const auto model_of = [&](const std::string& name) -> const ConditionModel& {
    return models[static_cast<std::size_t>(&settings.condition(name) - settings.conditions.data())];
  };
  context.say(fmt::format("virtual bridge: {} degrees of freedom, {} modes to {:.2f} Hz", states.begin()->second.system.size(),
                          settings.modes, states.begin()->second.modes.frequency_Hz.tail(1)[0]));

  // 2. Records of the decks, each with random streams of its own, so that threads change nothing.
  std::vector<Simulated> simulated(settings.records.size());
  parallel_for(settings.records.size(), [&](std::size_t i) {
    const RecordSettings& record = settings.records[i];
    const std::vector<LayoutChannel> channels = channels_of(layout, record.setup);
    Motion motion = record.kind == "wind"
                        ? simulate_wind(model_of(record.condition), settings, record, *read.wind, channels, context.seed, i)
                        : simulate(model_of(record.condition), settings, record, channels, points, context.seed, i);
    io::write_npy_single(logged_record(motion, settings, context.seed, i), context.out / files[i].file);
    simulated[i] = {std::move(motion.damper_force_N), std::move(motion.rms_displacement_m)};
  });

  // 3. Records of single stays.
  std::vector<StayRecord> stays;
  for (std::size_t i = 0; i < settings.stays.size(); ++i) {
    const std::uint64_t stream = settings.records.size() + i;
    stays.push_back(stay_record(bridge.undivided, settings.stays[i], settings, context.seed, stream));
    Motion motion;
    motion.acceleration_m_s2 = stays.back().acceleration_m_s2;
    io::write_npy_single(logged_record(motion, settings, context.seed, stream),
                         context.out / files[settings.records.size() + i].file);
  }

  // 4. What is true, and how large the motion was: of each condition's longest ambient or wind record.
  TruthTables truth;
  std::map<std::string, Amplitude> amplitudes;
  for (const ConditionSettings& condition : settings.conditions) {
    std::optional<std::size_t> longest;
    for (std::size_t i = 0; i < settings.records.size(); ++i) {
      const RecordSettings& r = settings.records[i];
      if (r.condition == condition.name && (r.kind == "ambient" || r.kind == "wind") &&
          (!longest || r.duration_s > settings.records[*longest].duration_s))
        longest = i;
    }
    if (!longest) continue;
    const ConditionModel& model = model_of(condition.name);
    const TrueModes modes = true_modes(model, settings, simulated[*longest].damper_force_N, kHighestTruth_Hz);
    truth.add(condition.name, settings, model, modes, layout, simulated[*longest].damper_force_N);
    const auto channels = channels_of(layout, settings.records[*longest].setup);
    amplitudes[condition.name] = {channels.front().channel, simulated[*longest].rms_displacement_m[0]};
  }
  truth.save(settings, stays, context.out / "truth");

  // 5. What a reader needs.
  write_campaign_files(settings, layout, stays, files, amplitudes, context.out);
  return {};
}

}  // namespace

Computation read_test_campaign(StepContext& context, const CampaignSettings& settings) {
  CampaignInputs read;
  read.bridge = read_virtual_bridge(context, settings);
  if (!context.has_flag("calibrate")) {
    read.points = read_points(context.input(settings.points));
    read.layout = read_setups(context.input(settings.setups), read.points);
    read.files = record_files(settings, read.layout);
    read.theta = corrected_parameters(context, read.bridge, settings.corrections);
    refuse_unknown_names(settings, read);
    for (const RecordSettings& record : settings.records)
      if (record.kind == "wind" && !read.wind) read.wind = read_virtual_wind(context, settings);
  }
  return [&context, &settings, read = std::move(read)] { return run_test_campaign(context, settings, read); };
}

}  // namespace twindeck::steps
