#include "steps/reliability/reliability.hpp"

#include <fmt/format.h>

#include <cmath>

#include "steps/reliability/outputs.hpp"

namespace twindeck::steps {
namespace {

using Eigen::Index;

std::string node_name(const buffeting::BridgeInWind& bridge, std::size_t node) {
  const aero::Strip& strip = bridge.model.strips[bridge.sensors.nodes[node]];
  return fmt::format("{} at {:.1f} m", strip.deck, strip.station_m);
}

/// Rows of the nodes that move most across the deck and vertically.
std::vector<std::size_t> largest_at_nodes(const buffeting::BridgeInWind& bridge,
                                          const std::vector<reliability::SpectralMoments>& mean) {
  std::vector<std::size_t> rows;
  for (const bool vertical : {false, true}) {
    std::size_t largest = 0;
    for (std::size_t node = 0; node < bridge.sensors.nodes.size(); ++node) {
      const auto row =
          static_cast<std::size_t>(vertical ? bridge.sensors.vertical_row(node) : bridge.sensors.lateral_row(node));
      if (node == 0 || mean[row].variance > mean[largest].variance) largest = row;
    }
    rows.push_back(largest);
  }
  return rows;
}

/// Comfort in one direction, at the row that `largest_at_nodes` chose.
FragilityRow comfort(const ReliabilityConfig& config, const buffeting::BridgeInWind& bridge,
                     const reliability::UncertainMoments& moments, bool vertical, double limit, std::uint64_t seed) {
  const std::size_t k = vertical ? 1 : 0, row = moments.varied[k];
  FragilityRow out;
  out.limit_state = vertical ? "comfort_vertical" : "comfort_lateral";
  out.limit_m_s2 = limit;
  out.channel = node_name(bridge, (row - 3 * bridge.sensors.points.size()) / 2);
  out.deviation_m_s2 = std::sqrt(moments.mean[row].variance);
  out.excursion = reliability::excursion(moments, k, limit, config.duration_s, static_cast<int>(config.samples), seed);
  return out;
}

/// Rows of responses.csv in one wind.
void add_responses(std::vector<ResponseRow>& rows, const ResponseRow& common, const buffeting::BridgeInWind& bridge,
                   const reliability::UncertainMoments& moments) {
  ResponseRow row = common;
  const auto add = [&](const std::string& channel, const std::string& direction, Index at) {
    row.channel = channel;
    row.direction = direction;
    row.moments = moments.mean[static_cast<std::size_t>(at)];
    rows.push_back(row);
  };
  for (std::size_t point = 0; point < bridge.sensors.points.size(); ++point) {
    const Index vertical = bridge.sensors.vertical(point);
    add(bridge.sensors.points[point], "x", vertical - 2);
    add(bridge.sensors.points[point], "y", vertical - 1);
    add(bridge.sensors.points[point], "z", vertical);
  }
  for (std::size_t node = 0; node < bridge.sensors.nodes.size(); ++node) {
    add(node_name(bridge, node), "lateral", bridge.sensors.lateral_row(node));
    add(node_name(bridge, node), "vertical", bridge.sensors.vertical_row(node));
  }
}

/// What the computation collects for its tables.
struct Found {
  std::vector<reliability::CriticalSpeed> critical;
  std::vector<FragilityRow> fragility;
  std::vector<ResponseRow> responses;
};

/// Critical speeds: every model without dampers, the response's model with them too.
void find_critical_speeds(const ReliabilityConfig& config, const ReliabilityInputs& read,
                          const reliability::UncertainBridge& uncertain, const aero::WindModel& model,
                          const aero::DampedModel& damped, const runner::StepContext& context, Found& found) {
  const auto add = [&](const std::string& name, const reliability::VariedStructure& structure, bool dampers) {
    found.critical.push_back(reliability::critical_speed(uncertain, read.aerodynamics, model, structure,
                                                         buffeting::deployment_of(read.aerodynamics, name), dampers));
    context.progress("critical speeds", static_cast<double>(found.critical.size()),
                     static_cast<double>(config.models.size()) + 1.0);
    for (const double speed : config.speed_m_s) {
      const double p = found.critical.back().probability_below(speed);
      found.fragility.push_back({"stability", name, dampers, speed, "", 0.0, 0.0, {p, p, p, 0.0, 0.0}});
    }
  };
  const reliability::VariedStructure bare(uncertain.loaded, aero::bare_structure(model, read.aerodynamics.structural_damping),
                                          model.motions, model.modes.shapes, read.parameters);
  for (const std::string& name : config.models) add(name, bare, false);
  if (damped.dampers == 0) return;
  add(config.response_model,
      reliability::VariedStructure(uncertain.loaded, damped.structure, damped.motions, damped.vectors, read.parameters), true);
}

/// Responses to turbulence and comfort at each mean speed, with dampers or without.
void find_responses(const ReliabilityConfig& config, const ReliabilityInputs& read,
                    const reliability::UncertainBridge& uncertain, bool dampers, runner::StepContext& context, Found& found) {
  aero::WindSettings aerodynamics = read.aerodynamics;
  aerodynamics.n_modes = read.validation.n_modes;
  ValidationConfig settings = read.validation;
  settings.dampers = dampers;
  const buffeting::BridgeInWind bridge =
      buffeting::prepare_bridge_in_wind(settings, aerodynamics, read.model, uncertain.sections(1.0));
  const reliability::VariedStructure structure(bridge.loaded, bridge.reduced.structure, bridge.reduced.motions,
                                               bridge.reduced.vectors, read.parameters);
  const reliability::WindResponse response{bridge,
                                           structure,
                                           settings,
                                           read.turbulence,
                                           buffeting::deployment_of(aerodynamics, config.response_model),
                                           bridge.sensors.motion,
                                           2};
  const std::string with = dampers ? "with dampers" : "without dampers";
  double done = 0.0;
  for (const double speed : config.speed_m_s) {
    const reliability::UncertainMoments moments = reliability::uncertain_moments(
        uncertain, response, speed,
        [&](const std::vector<reliability::SpectralMoments>& mean) { return largest_at_nodes(bridge, mean); });
    context.progress("mean speeds " + with, ++done, static_cast<double>(config.speed_m_s.size()));
    if (!moments.stable) {
      context.warn(
          fmt::format("at {:.1f} m/s {} the bridge is unstable, or one deviation of an input away from it: crossings.csv and "
                      "responses.csv have no rows of it",
                      speed, with));
      continue;
    }
    add_responses(found.responses, {config.response_model, dampers, speed, "", "", {}}, bridge, moments);
    for (const bool vertical : {true, false}) {
      FragilityRow row = comfort(config, bridge, moments, vertical,
                                 vertical ? settings.comfort_vertical_m_s2 : settings.comfort_lateral_m_s2, context.seed);
      row.model = config.response_model;
      row.dampers = dampers;
      row.speed_m_s = speed;
      found.fragility.push_back(row);
    }
  }
}

}  // namespace

Status run_reliability(const ReliabilityConfig& config, const ReliabilityInputs& read, runner::StepContext& context) {
  // 1. The updated bridge in wind as steps 7 and 8 have it, and what is uncertain of it.
  const dynamics::LoadedModel loaded = dynamics::solvable(read.model);
  if (!loaded.state.status.converged) return loaded.state.status;
  const aero::WindModel model = aero::prepare_wind_model(read.aerodynamics, loaded);
  if (!model.modes.status.converged) return model.modes.status;
  const aero::DampedModel damped = aero::with_dampers(model, loaded, read.aerodynamics.structural_damping);
  const reliability::UncertainBridge uncertain{
      read.random, loaded, read.parameters,
      [&](double factor) { return aero::sections_of(read.aerodynamics, read.data, read.validation.set, read.level * factor); },
      read.aerodynamics.structural_damping};

  // 2. Critical speeds, then responses and comfort at each mean speed.
  Found found;
  find_critical_speeds(config, read, uncertain, model, damped, context, found);
  find_responses(config, read, uncertain, false, context, found);
  if (damped.dampers > 0) find_responses(config, read, uncertain, true, context, found);

  // 3. Tables, and the outcome in words.
  write_random(read.random, context.out);
  write_critical(found.critical, read.random, read.aerodynamics.design_speed_m_s, context.out);
  write_fragility(found.fragility, context.out);
  write_responses(found.responses, context.out);
  for (const reliability::CriticalSpeed& each : found.critical) {
    if (!each.speed_m_s) continue;
    context.say(fmt::format(
        "model {} {}: critical speed {:.2f} m/s, deviation {:.1f} %, below {:.1f} m/s with probability {:.3g}", each.model,
        each.dampers ? "with dampers" : "without dampers", each.speed_m_s->value, 100.0 * each.speed_m_s->deviation(),
        read.aerodynamics.design_speed_m_s, each.probability_below(read.aerodynamics.design_speed_m_s)));
  }
  return {};
}

}  // namespace twindeck::steps
