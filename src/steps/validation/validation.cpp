#include "steps/validation/validation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "buffeting/bridge_in_wind.hpp"
#include "buffeting/field_statistics.hpp"
#include "buffeting/paper_statements.hpp"
#include "buffeting/simulated_runs.hpp"
#include "buffeting/time_checks.hpp"
#include "core/error.hpp"
#include "core/lists.hpp"
#include "core/units.hpp"
#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"
#include "io/csv.hpp"
#include "records/campaign.hpp"
#include "records/campaign_channels.hpp"
#include "signal/condition.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/wind/deck_files.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::steps {
namespace {

struct ValidationOutcome {
  std::vector<buffeting::RunResult> results;
  std::vector<buffeting::FieldCheck> field_checks;
  std::vector<buffeting::TimeCheck> time_checks;  ///< of the first event and run with a stable bridge
};

using Eigen::Index;

constexpr std::size_t kBeforeMeasured = 12;  ///< columns of rms.csv before the measured side

/// rms.csv: accelerations at the monitoring points, mean over seeds with its interval, standard deviation of one seed, and the
/// values of the frequency domain, with derivatives frozen as in the time domain and with derivatives at each frequency; then
/// the measured RMS and its errors in the vertical direction, Eq. (18), 100 (RMS_num / RMS_exp - 1), empty without a measured
/// side. The bounds are those of the mean over seeds. If the bridge is unstable in an event and run, all simulated values are
/// empty.
void write_rms(const std::vector<buffeting::RunResult>& results, const buffeting::BridgeInWind& bridge,
               const buffeting::MeasuredRms& measured, const ValidationConfig& config, const std::filesystem::path& folder) {
  io::CsvWriter csv({"event", "run", "model", "channel", "direction", "rms_m_s2", "rms_low_m_s2", "rms_high_m_s2",
                     "seed_deviation_m_s2", "peak_m_s2", "spectral_rms_m_s2", "spectral_rms_each_frequency_m_s2",
                     "measured_rms_m_s2", "error_pct", "error_low_pct", "error_high_pct"});
  const std::array<std::string, 3> axes = {"x", "y", "z"};
  for (const buffeting::RunResult& result : results) {
    for (std::size_t p = 0; p < bridge.sensors.points.size(); ++p) {
      for (Index d = 0; d < 3; ++d) {
        const Index row = 3 * static_cast<Index>(p) + d;
        const auto found = measured.find({result.event, bridge.sensors.points[p]});
        std::optional<double> there, error, low, high;
        if (d == 2 && found != measured.end()) there = found->second;
        std::vector<io::Cell> cells = {result.event, result.run, result.model, bridge.sensors.points[p],
                                       axes[static_cast<std::size_t>(d)]};
        if (result.status.converged) {
          const buffeting::Interval rms = buffeting::confidence_interval(result.rms.row(row).transpose(), config.level);
          if (there) {
            error = 100.0 * (rms.mean / *there - 1.0);
            low = 100.0 * (rms.low / *there - 1.0);
            high = 100.0 * (rms.high / *there - 1.0);
          }
          for (const double value : {rms.mean, rms.low, rms.high, rms.deviation, result.peak.row(row).mean(),
                                     result.spectral_rms[row], result.spectral_rms_each_frequency[row]})
            cells.emplace_back(value);
        } else {
          cells.resize(kBeforeMeasured, io::Cell(""));
        }
        for (const std::optional<double>& value : {there, error, low, high}) cells.emplace_back(value);
        csv.row(cells);
      }
    }
  }
  csv.save(folder / "rms.csv");
}

void write_statements(const std::vector<buffeting::PaperStatement>& statements, const std::filesystem::path& folder) {
  io::CsvWriter csv({"statement", "found", "verdict"});
  for (const buffeting::PaperStatement& said : statements) csv.row({said.statement, said.found, said.holds ? "hit" : "miss"});
  csv.save(folder / "statements.csv");
}

/// The aerodynamic node with the largest mean peak, against the comfort limits: "within", "exceeded", or "unstable", which has
/// no peak.
void write_comfort(const std::vector<buffeting::RunResult>& results, const buffeting::BridgeInWind& bridge,
                   const ValidationConfig& config, const std::filesystem::path& folder) {
  io::CsvWriter csv({"event", "run", "direction", "deck", "station_m", "peak_m_s2", "peak_low_m_s2", "peak_high_m_s2",
                     "limit_m_s2", "verdict"});
  for (const buffeting::RunResult& result : results) {
    for (const bool vertical : {true, false}) {
      const double limit = vertical ? config.comfort_vertical_m_s2 : config.comfort_lateral_m_s2;
      const std::string direction = vertical ? "vertical" : "lateral";
      if (!result.status.converged) {
        csv.row({result.event, result.run, direction, "", "", "", "", "", limit, "unstable"});
        continue;
      }
      std::size_t worst = 0;
      double highest = -1.0;
      for (std::size_t i = 0; i < bridge.sensors.nodes.size(); ++i) {
        const Index row = vertical ? bridge.sensors.vertical_row(i) : bridge.sensors.lateral_row(i);
        if (const double mean = result.peak.row(row).mean(); mean > highest) {
          highest = mean;
          worst = i;
        }
      }
      const Index row = vertical ? bridge.sensors.vertical_row(worst) : bridge.sensors.lateral_row(worst);
      const aero::Strip& strip = bridge.model.strips[bridge.sensors.nodes[worst]];
      const buffeting::Interval peak = buffeting::confidence_interval(result.peak.row(row).transpose(), config.level);
      csv.row({result.event, result.run, direction, strip.deck, strip.station_m, peak.mean, peak.low, peak.high, limit,
               peak.high <= limit ? "within" : "exceeded"});
    }
  }
  csv.save(folder / "comfort.csv");
}

/// No rows of an event in which all runs are unstable.
void write_wind_check(const std::vector<buffeting::FieldCheck>& checks, const std::filesystem::path& folder) {
  io::CsvWriter csv({"event", "quantity", "target", "found", "allowed", "verdict"});
  for (const buffeting::FieldCheck& check : checks)
    csv.row({check.event, check.quantity, check.target, check.found, check.allowed,
             std::abs(check.found - check.target) <= check.allowed ? "met" : "missed"});
  csv.save(folder / "wind_check.csv");
}

/// Of the first event and run in which the bridge is stable.
void write_time_checks(const std::vector<buffeting::TimeCheck>& checks, const std::filesystem::path& folder) {
  io::CsvWriter csv({"check", "channel", "reference_m_s2", "found_m_s2", "difference_pct", "allowed_pct", "verdict"});
  for (const buffeting::TimeCheck& check : checks) {
    const double difference = 100.0 * (check.found_m_s2 / check.reference_m_s2 - 1.0);
    csv.row({check.name, check.channel, check.reference_m_s2, check.found_m_s2, difference, check.allowed_pct,
             std::abs(difference) <= check.allowed_pct ? "met" : "missed"});
  }
  csv.save(folder / "checks.csv");
}

/// hybrid.csv: the zones of Table 14; the ends are the yaw at the decks' end stays. hybrid_nodes.csv: Fig. 21.
void write_hybrid(const buffeting::BridgeInWind& bridge, const std::filesystem::path& folder) {
  io::CsvWriter zones({"deck", "theta_from_deg", "theta_to_deg", "zone", "model", "statics", "lookup_cos_power",
                       "block_inverse_cos_power", "nodes"});
  io::CsvWriter nodes({"deck", "node", "station_m", "x_m", "y_m", "yaw_deg", "model", "static_factor", "block_factor"});
  if (!bridge.aerodynamics.hybrid.empty()) {
    const aero::Deployment deployment = buffeting::deployment_of(bridge.aerodynamics, "hybrid");
    for (const aero::HybridZone& zone : bridge.aerodynamics.hybrid) {
      std::vector<double> yaw;
      for (const aero::Strip& strip : bridge.model.strips) {
        if (strip.deck != zone.deck) continue;
        const aero::YawRule& rule = deployment.at(strip.deck, strip.yaw_rad);
        yaw.push_back(strip.yaw_rad * degrees);
        nodes.row({strip.deck, yaw.size(), strip.station_m, strip.x_m.x(), strip.x_m.y(), yaw.back(), rule.name,
                   aero::static_factor(rule, strip.yaw_rad).force, aero::block_factor(rule, strip.yaw_rad)(1, 1)});
      }
      if (yaw.size() < 2) continue;
      std::ranges::sort(yaw);
      // The outermost strips end half a strip beyond their nodes, at the end stays.
      const double lowest = yaw[0] - 0.5 * (yaw[1] - yaw[0]), highest = yaw.back() + 0.5 * (yaw.back() - yaw[yaw.size() - 2]);
      const auto put = [&](const std::string& name, double from, double to) {
        const aero::YawRule& rule = deployment.at(zone.deck, 0.5 * (from + to) / degrees);
        const auto inside = std::ranges::count_if(yaw, [&](double y) { return y >= from && y <= to; });
        zones.row({zone.deck, from, to, name, rule.name, name_of(rule.statics), rule.lookup_power, rule.inverse_power(1, 1),
                   static_cast<long>(inside)});
      };
      if (lowest < -zone.beyond_deg) put("end", lowest, -zone.beyond_deg);
      if (highest > zone.beyond_deg) put("end", zone.beyond_deg, highest);
      put("middle", std::max(lowest, -zone.beyond_deg), std::min(highest, zone.beyond_deg));
    }
  }
  zones.save(folder / "hybrid.csv");
  nodes.save(folder / "hybrid_nodes.csv");
}

void write_tables(const ValidationOutcome& found, const buffeting::BridgeInWind& bridge, const buffeting::MeasuredRms& measured,
                  const ValidationConfig& config, const std::filesystem::path& folder) {
  write_rms(found.results, bridge, measured, config, folder);
  write_statements(buffeting::paper_statements(found.results, bridge.sensors, measured), folder);
  write_comfort(found.results, bridge, config, folder);
  write_wind_check(found.field_checks, folder);
  write_hybrid(bridge, folder);
  write_time_checks(found.time_checks, folder);
}

/// Channels that measure the vertical acceleration at the monitoring point of their name. Warns of channels with such a name
/// that do not.
std::set<std::string> vertical_channels(runner::StepContext& context, const records::Campaign& campaign, const fe::Model& model,
                                        double tolerance_m) {
  const std::vector<std::string> points = buffeting::accelerometers(model);
  std::set<std::string> vertical;
  for (const records::CampaignChannel& channel : campaign.channels) {
    if (!contains(points, channel.name)) continue;
    const Eigen::Vector3d& x_m = model.nodes[static_cast<std::size_t>(model.monitoring_points.at(channel.name))].x_m;
    if (const std::string other = records::other_than_vertical_acceleration(channel, x_m, tolerance_m); other.empty())
      vertical.insert(channel.name);
    else
      context.warn(fmt::format("channel {} is not the vertical acceleration at the point {}: {}; it is left out", channel.name,
                               channel.name, other));
  }
  return vertical;
}

struct MeanSquare {
  double sum = 0.0, samples = 0.0;
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
/// given. Other channels with such a name are left out with a warning. Empty for events whose condition is not named.
/// `--campaign`, or the study's s0_campaign.
/// @throws InputError  if the campaign is there but has no wind record of a condition that is named
buffeting::MeasuredRms measured_rms(runner::StepContext& context, const ValidationConfig& config, const fe::Model& model) {
  buffeting::MeasuredRms out;
  const bool wanted = std::ranges::any_of(config.events, [](const buffeting::WindEvent& e) { return !e.condition.empty(); });
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
    records::RecordChoice choice{.setup = {}, .condition = event.condition, .kind = "wind"};
    std::map<std::string, MeanSquare> squares;  // by channel
    for (const records::RecordGroup& group : records::record_groups(campaign, choice)) {
      for (const records::CampaignRecord& record : group.records) {
        context.record(record.file);
        const records::RecordSamples recorded = records::read_record(campaign, record);
        for (const std::string& note : recorded.notes) context.say(note);
        const Eigen::MatrixXd data = signal::detrended(recorded.values);
        if (!data.allFinite())
          throw InputError({record.file.string(), 0, ""}, "has gaps, which an RMS cannot have", "take a record without gaps");
        for (std::size_t c = 0; c < record.channels.size(); ++c) {
          if (!vertical.contains(record.channels[c])) continue;
          MeanSquare& square = squares[record.channels[c]];
          square.sum += data.col(static_cast<Index>(c)).squaredNorm();
          square.samples += static_cast<double>(data.rows());
        }
      }
    }
    for (const auto& [channel, square] : squares) out[{event.name, channel}] = std::sqrt(square.sum / square.samples);
  }
  return out;
}

struct ValidationInputs {
  wind::TurbulenceSet turbulence;
  aero::WindSettings aerodynamics;          ///< of step 7
  dynamics::ReadModel model;                ///< the updated one
  std::vector<aero::SectionAero> sections;  ///< of the set, at the level that step 7 fitted
  buffeting::MeasuredRms measured;
};

ValidationInputs read_validation_inputs(const ValidationConfig& config, runner::StepContext& context) {
  if (config.events.empty() || config.runs.empty())
    throw InputError({"", 0, config.events.empty() ? "event" : "run"}, "none is given", "add [[event]] and [[run]] tables");
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

  // 2. Events one after the other, seeds in parallel. A run with an unstable bridge has no results.
  ValidationOutcome found;
  std::optional<buffeting::CheckedCase> stable;
  std::vector<std::string> unstable;
  for (const buffeting::WindEvent& event : config.events) {
    buffeting::SimulatedEvent simulated = buffeting::simulate_event(bridge, set, config, event, context.seed, context);
    for (std::size_t i = 0; i < simulated.runs.size(); ++i) {
      if (const Status& status = simulated.runs[i].status; !status.converged)
        unstable.push_back(status.message);
      else if (!stable)
        stable = {event, config.runs[i]};
      found.results.push_back(std::move(simulated.runs[i]));
    }
    found.field_checks.insert(found.field_checks.end(), simulated.checks.begin(), simulated.checks.end());
  }

  for (const std::string& told : unstable) context.warn(told + "; its rows in rms.csv and comfort.csv are left empty");

  // 3. Tables.
  if (stable) found.time_checks = buffeting::check_time_integration(bridge, set, config, *stable, context.seed);
  write_tables(found, bridge, read.measured, config, context.out);
  if (!stable) return {false, fmt::format("{}", fmt::join(unstable, "; "))};
  return {};
}

}  // namespace

runner::Computation read_validation(const ValidationConfig& config, runner::StepContext& context) {
  return [&config, &context, read = read_validation_inputs(config, context)] { return run_validation(config, read, context); };
}

}  // namespace twindeck::steps
