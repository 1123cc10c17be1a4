#include "steps/validation/validation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "buffeting/paper_statements.hpp"
#include "buffeting/simulated_runs.hpp"
#include "buffeting/time_checks.hpp"
#include "core/error.hpp"
#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"
#include "records/campaign.hpp"
#include "records/vertical_channel.hpp"
#include "signal/condition.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/validation/outputs.hpp"
#include "steps/wind/deck_files.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::steps {

namespace {

/// Channels that are the vertical acceleration at the monitoring point of their name. Warns of those that are not.
std::set<std::string> vertical_channels(runner::StepContext& context, const records::Campaign& campaign, const fe::Model& model,
                                        double tolerance_m) {
  const std::vector<std::string> points = buffeting::accelerometers(model);
  std::set<std::string> vertical;
  for (const records::CampaignChannel& channel : campaign.channels) {
    if (std::find(points.begin(), points.end(), channel.name) == points.end()) continue;
    const Eigen::Vector3d& x_m = model.nodes[static_cast<std::size_t>(model.monitoring_points.at(channel.name))].x_m;
    const std::string other = records::other_than_vertical_acceleration(channel, x_m, tolerance_m);
    if (other.empty())
      vertical.insert(channel.name);
    else
      context.warn(fmt::format("channel {} is not the vertical acceleration at the point {}: {}; it is left out", channel.name,
                               channel.name, other));
  }
  return vertical;
}

/// Mean squares of the channels of one event.
class MeanSquares {
 public:
  void add(const std::string& channel, const Eigen::Ref<const Eigen::VectorXd>& values) {
    Sum& sum = sums_[channel];
    sum.square += values.squaredNorm();
    sum.samples += static_cast<double>(values.size());
  }
  void write(const std::string& event, buffeting::MeasuredRms& out) const {
    for (const auto& [channel, sum] : sums_) out[{event, channel}] = std::sqrt(sum.square / sum.samples);
  }

 private:
  struct Sum {
    double square = 0.0, samples = 0.0;
  };
  std::map<std::string, Sum> sums_;
};

/// The campaign's folder; empty where there is none to read.
std::optional<std::filesystem::path> folder_of(const runner::StepContext& context) {
  const std::filesystem::path folder = context.campaign.value_or(context.results / "s0_campaign");
  if (std::filesystem::exists(folder)) return folder;
  if (context.campaign)
    throw InputError({folder.string(), 0, ""}, "is not there, expected a campaign's folder",
                     "give --campaign the folder that holds campaign.toml");
  context.say("no campaign: the simulations stand alone, without a measured side");
  return std::nullopt;
}

/// RMS of the vertical acceleration in the campaign's wind records, by event and channel [m/s²], over all records that have the
/// channel. A channel counts for the monitoring point whose name it has, if it can be that point's vertical acceleration: an
/// acceleration, of role "response", vertical (up or down), and within `sensor_tolerance` of the point where its position is
/// given. A channel that has the name and is something else is left out with a warning. Empty for events whose condition is
/// not named. `--campaign`, or the study's s0_campaign.
/// @throws InputError  if the campaign is there but has no wind record of a condition that is named
buffeting::MeasuredRms measured_rms(runner::StepContext& context, const ValidationConfig& config, const fe::Model& model) {
  buffeting::MeasuredRms out;
  const bool wanted = std::any_of(config.events.begin(), config.events.end(),
                                  [](const buffeting::WindEvent& e) { return !e.condition.empty(); });
  if (!wanted) return out;
  const std::optional<std::filesystem::path> folder = folder_of(context);
  if (!folder) return out;
  context.input(*folder / "campaign.toml");
  context.input(*folder / "channels.csv");
  const records::Campaign campaign = records::read_campaign(*folder);
  for (const std::string& warning : campaign.warnings) context.say(warning);
  const std::set<std::string> vertical = vertical_channels(context, campaign, model, config.sensor_tolerance_m);
  for (const buffeting::WindEvent& event : config.events) {
    if (event.condition.empty()) continue;
    records::RecordChoice choice;
    choice.condition = event.condition;
    choice.kind = "wind";
    MeanSquares squares;
    for (const records::RecordGroup& group : records::record_groups(campaign, choice)) {
      for (const records::CampaignRecord& record : group.records) {
        context.record(record.file);
        const records::RecordSamples recorded = records::read_record(campaign, record);
        for (const std::string& note : recorded.notes) context.say(note);
        const Eigen::MatrixXd data = signal::detrended(recorded.values);
        if (!data.allFinite())
          throw InputError({record.file.string(), 0, ""}, "has gaps, which an RMS cannot have", "take a record without gaps");
        for (std::size_t c = 0; c < record.channels.size(); ++c) {
          if (vertical.contains(record.channels[c])) squares.add(record.channels[c], data.col(static_cast<Eigen::Index>(c)));
        }
      }
    }
    squares.write(event.name, out);
  }
  return out;
}

/// What the step reads.
struct ValidationInputs {
  wind::TurbulenceSet turbulence;
  aero::WindSettings aerodynamics;          ///< of step 7
  dynamics::ReadModel model;                ///< the updated one
  std::vector<aero::SectionAero> sections;  ///< of the set, at the level that step 7 fitted
  buffeting::MeasuredRms measured;
};

ValidationInputs read_validation_inputs(const ValidationConfig& config, runner::StepContext& context) {
  if (config.events.empty() || config.runs.empty()) {
    throw InputError({"", 0, config.events.empty() ? "event" : "run"}, "none is given", "add [[event]] and [[run]] tables");
  }
  ValidationInputs read;
  read.turbulence = read_turbulence(config, context);
  read.aerodynamics = read_step_7(config.aerodynamics, context);
  read.aerodynamics.n_modes = config.n_modes;
  for (const buffeting::ValidationRun& run : config.runs)
    static_cast<void>(buffeting::deployment_of(read.aerodynamics, run.model));
  read.model = load_model(context, context.results / "s6_updating" / "model");
  const std::vector<aero::DeckAerodynamics> data = read_deck_aerodynamics(read.aerodynamics, context);
  static_cast<void>(aero::aero_nodes_of(read.aerodynamics, read.model.fe_model(), read.model.source));
  read.sections = aero::sections_of(read.aerodynamics, data, config.set, fitted_level(context, config.set));
  if (const std::string untaken = aero::untaken_in_words(*read.model.fe_model()); !untaken.empty()) context.warn(untaken);
  if (buffeting::accelerometers(*read.model.fe_model()).empty())
    context.warn(
        "the model has no monitoring point, a name in points.csv that begins with M: rms.csv and checks.csv have no rows");
  read.measured = measured_rms(context, config, *read.model.fe_model());
  return read;
}

Status run_validation(const ValidationConfig& config, const ValidationInputs& read, runner::StepContext& context) {
  // 1. The bridge, reduced, and the turbulence.
  const wind::TurbulenceSet& set = read.turbulence;
  const buffeting::BridgeInWind bridge =
      buffeting::prepare_bridge_in_wind(config, read.aerodynamics, read.model, read.sections);
  if (!bridge.loaded.state.status.converged) return bridge.loaded.state.status;
  if (!bridge.model.modes.status.converged) return bridge.model.modes.status;
  context.say(fmt::format("{} coordinates for {} degrees of freedom, {} aerodynamic nodes, {} dampers",
                          bridge.reduced.structure.size(), bridge.loaded.system.size(), bridge.model.strips.size(),
                          bridge.reduced.dampers));

  // 2. Events one after the other, seeds in parallel. Where the bridge is unstable in a run there is nothing to publish of it.
  std::vector<buffeting::RunResult> results;
  std::vector<buffeting::FieldCheck> checks;
  std::optional<buffeting::CheckedCase> stable;
  std::vector<std::string> unstable;
  for (const buffeting::WindEvent& event : config.events) {
    buffeting::SimulatedEvent simulated = buffeting::simulate_event(bridge, set, config, event, context.seed, context);
    for (std::size_t i = 0; i < simulated.runs.size(); ++i) {
      const Status& status = simulated.runs[i].status;
      if (!status.converged) {
        unstable.push_back(status.message);
      } else if (!stable) {
        stable = {event, config.runs[i]};
      }
      results.push_back(std::move(simulated.runs[i]));
    }
    checks.insert(checks.end(), simulated.checks.begin(), simulated.checks.end());
  }

  for (const std::string& told : unstable) context.warn(told + "; its rows in rms.csv and comfort.csv are left empty");

  // 3. Tables.
  write_rms(results, bridge, read.measured, config, context.out);
  write_statements(buffeting::paper_statements(results, bridge.sensors, read.measured), context.out);
  write_comfort(results, bridge, config, context.out);
  write_wind_check(checks, context.out);
  write_hybrid(bridge, context.out);
  write_time_checks(stable ? buffeting::check_time_integration(bridge, set, config, *stable, context.seed)
                           : std::vector<buffeting::TimeCheck>(),
                    context.out);
  if (!stable) return {false, fmt::format("{}", fmt::join(unstable, "; "))};
  return {};
}

}  // namespace

runner::Computation read_validation(const ValidationConfig& config, runner::StepContext& context) {
  return [&config, &context, read = read_validation_inputs(config, context)] { return run_validation(config, read, context); };
}

}  // namespace twindeck::steps
