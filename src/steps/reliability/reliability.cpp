#include "steps/reliability/reliability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/lists.hpp"
#include "core/parallel.hpp"
#include "reliability/fatigue.hpp"
#include "reliability/form.hpp"
#include "reliability/subset_simulation.hpp"
#include "reliability/varied_structure.hpp"
#include "reliability/wind_law.hpp"
#include "steps/reliability/outputs.hpp"

namespace twindeck::steps {
namespace {

using Eigen::Index;

constexpr double kHour_s = 3600.0, kYear_h = 8766.0;
constexpr Index kModesOverYears = 10;

/// Category of the stays [Pa], EN 1993-1-11:2006, table 9.1.
double stay_category_Pa(const std::string& name) {
  static const std::map<std::string, double> table = {
      {"bar", 105e6}, {"coil_rope", 150e6}, {"spiral_strand", 150e6}, {"parallel", 160e6}};
  return table.at(name);
}

std::string node_name(const buffeting::BridgeInWind& bridge, std::size_t node) {
  const aero::Strip& strip = bridge.model.strips[bridge.sensors.nodes[node]];
  return fmt::format("{} at {:.1f} m", strip.deck, strip.station_m);
}

/// One structure in wind: in one year, with dampers off or on, with or without a fault. Rows of its response are the
/// accelerations of step 8, then forces of the stays, then strokes of the dampers.
struct Structure {
  Case of;
  ValidationConfig settings;
  buffeting::BridgeInWind bridge;
  reliability::UncertainBridge uncertain;
  reliability::VariedStructure varied;
  reliability::MemberRows stays, dampers;
  Eigen::MatrixXd rows;

  [[nodiscard]] std::size_t first_stay() const { return static_cast<std::size_t>(bridge.sensors.motion.rows()); }
  [[nodiscard]] std::size_t first_damper() const { return first_stay() + stays.names.size(); }

  Structure(const Case& which, const ReliabilityInputs& read, const dynamics::ReadModel& model)
      : of(which),
        settings(settings_of(which, read)),
        bridge(buffeting::prepare_bridge_in_wind(settings, aerodynamics_of(read), model, sections_at(read)(1.0))),
        uncertain{read.random, bridge.loaded, read.parameters, sections_at(read), read.aerodynamics.structural_damping},
        varied(bridge.loaded, bridge.reduced.structure, bridge.reduced.motions, bridge.reduced.vectors, read.parameters),
        stays(reliability::stay_forces(bridge.loaded, bridge.reduced.vectors)) {
    if (of.dampers) dampers = reliability::damper_strokes(bridge.loaded, bridge.reduced.vectors);
    const Eigen::MatrixXd& motion = bridge.sensors.motion;
    rows.resize(motion.rows() + stays.rows.rows() + dampers.rows.rows(), motion.cols());
    rows.topRows(motion.rows()) = motion;
    rows.middleRows(motion.rows(), stays.rows.rows()) = stays.rows;
    if (of.dampers) rows.bottomRows(dampers.rows.rows()) = dampers.rows;
  }

 private:
  static ValidationConfig settings_of(const Case& which, const ReliabilityInputs& read) {
    ValidationConfig out = read.validation;
    out.dampers = which.dampers;
    return out;
  }
  static aero::WindSettings aerodynamics_of(const ReliabilityInputs& read) {
    aero::WindSettings out = read.aerodynamics;
    out.n_modes = read.validation.n_modes;
    return out;
  }
  static std::function<std::vector<aero::SectionAero>(double)> sections_at(const ReliabilityInputs& read) {
    return [&read](double factor) {
      return aero::sections_of(read.aerodynamics, read.data, read.validation.set, read.level * factor);
    };
  }
};

/// Results for the tables, and the moments of the year 0 at each speed.
struct Found {
  std::vector<CriticalRow> critical;
  std::vector<FragilityRow> fragility;
  std::vector<ResponseRow> responses;
  std::vector<FatigueRow> fatigue;
  std::vector<YearRow> years;
  std::vector<RareRow> rare;
  Status rare_status;
  struct First {
    Case of;
    double speed_m_s;
    reliability::UncertainMoments moments;
  };
  std::vector<First> first;
};

/// Rows with the largest response: of a node across the deck, of a node vertically, of the stay nearest to being slack, of a
/// damper's stroke.
std::vector<std::size_t> largest_rows(const Structure& s, const std::vector<reliability::SpectralMoments>& mean) {
  std::vector<std::size_t> rows;
  const auto add = [&](std::size_t count, const auto& row_of, const auto& weight) {
    std::size_t largest = 0;
    double best = -1.0;
    for (std::size_t i = 0; i < count; ++i) {
      if (const double here = mean[row_of(i)].variance * weight(i); here > best) {
        best = here;
        largest = row_of(i);
      }
    }
    if (count > 0) rows.push_back(largest);
  };
  const auto one = [](std::size_t) { return 1.0; };
  const buffeting::Sensors& sensors = s.bridge.sensors;
  add(
      sensors.nodes.size(), [&](std::size_t i) { return static_cast<std::size_t>(sensors.lateral_row(i)); }, one);
  add(
      sensors.nodes.size(), [&](std::size_t i) { return static_cast<std::size_t>(sensors.vertical_row(i)); }, one);
  add(
      s.stays.names.size(), [&](std::size_t i) { return s.first_stay() + i; },
      [&](std::size_t i) {
        const double pull = s.stays.pull_N[static_cast<Index>(i)];
        return pull > 0.0 ? 1.0 / (pull * pull) : 0.0;
      });
  add(
      s.dampers.names.size(), [&](std::size_t i) { return s.first_damper() + i; }, one);
  return rows;
}

void find_critical(const ReliabilityConfig& config, const ReliabilityInputs& read, const Structure& s, Found& found) {
  const auto add = [&](const reliability::CriticalSpeed& speed) {
    CriticalRow row{s.of, speed};
    for (const CriticalRow& first : found.critical) {
      if (s.of.years == 0.0 || !speed.speed_m_s || first.of.years > 0.0 || !first.of.same_but_years(s.of) ||
          first.speed.model != speed.model || !first.speed.speed_m_s)
        continue;
      const std::vector<reliability::UncertainBridge::Change> changes = s.uncertain.changes();
      for (std::size_t i = 0; i < changes.size(); ++i)
        row.speed.speed_m_s->slope[static_cast<Index>(i)] +=
            changes[i].corrosion * std::log(speed.speed_m_s->value / first.speed.speed_m_s->value);
    }
    found.critical.push_back(row);
    for (const double v : config.speed_m_s) {
      const double p = row.speed.probability_below(v);
      found.fragility.push_back({"stability", speed.model, s.of, v, "", 0.0, 0.0, "", {p, p, p, 0.0, 0.0}});
    }
    if (row.speed.speed_m_s)
      found.years.push_back({s.of, "critical_speed", "model " + speed.model, "m/s", row.speed.speed_m_s->value,
                             row.speed.speed_m_s->deviation()});
  };
  const aero::WindModel model = aero::prepare_wind_model(read.aerodynamics, s.bridge.loaded);
  if (s.of.dampers) {
    const aero::DampedModel damped = aero::with_dampers(model, s.bridge.loaded, read.aerodynamics.structural_damping);
    const reliability::VariedStructure varied(s.bridge.loaded, damped.structure, damped.motions, damped.vectors,
                                              read.parameters);
    return add(reliability::critical_speed(s.uncertain, read.aerodynamics, model, varied,
                                           buffeting::deployment_of(read.aerodynamics, config.response_model), true));
  }
  const reliability::VariedStructure varied(s.bridge.loaded, aero::bare_structure(model, read.aerodynamics.structural_damping),
                                            model.motions, model.modes.shapes, read.parameters);
  std::vector<reliability::CriticalSpeed> speeds(read.models.size());
  parallel_for(std::ssize(speeds), [&](Index i) {
    const auto at = static_cast<std::size_t>(i);
    speeds[at] = reliability::critical_speed(s.uncertain, read.aerodynamics, model, varied,
                                             buffeting::deployment_of(read.aerodynamics, read.models[at]), false);
  });
  for (const reliability::CriticalSpeed& speed : speeds) add(speed);
}

void add_responses(const ReliabilityConfig& config, const Structure& s, double speed,
                   const reliability::UncertainMoments& moments, Found& found) {
  const buffeting::Sensors& sensors = s.bridge.sensors;
  const auto add = [&](const std::string& channel, const std::string& direction, const std::string& unit, Index at) {
    found.responses.push_back(
        {config.response_model, s.of, speed, channel, direction, unit, moments.mean[static_cast<std::size_t>(at)]});
  };
  for (std::size_t point = 0; point < sensors.points.size(); ++point) {
    const Index vertical = sensors.vertical(point);
    add(sensors.points[point], "x", "m/s2", vertical - 2);
    add(sensors.points[point], "y", "m/s2", vertical - 1);
    add(sensors.points[point], "z", "m/s2", vertical);
  }
  for (std::size_t node = 0; node < sensors.nodes.size(); ++node) {
    add(node_name(s.bridge, node), "lateral", "m/s2", sensors.lateral_row(node));
    add(node_name(s.bridge, node), "vertical", "m/s2", sensors.vertical_row(node));
  }
  for (std::size_t i = 0; i < s.stays.names.size(); ++i)
    add(s.stays.names[i], "force", "N", static_cast<Index>(s.first_stay() + i));
  for (std::size_t i = 0; i < s.dampers.names.size(); ++i)
    add(s.dampers.names[i], "stroke", "m", static_cast<Index>(s.first_damper() + i));
}

/// [-] probabilities, at the medians of the inputs, between which FORM and subset simulation are used.
constexpr double kLeastRare = 1e-12, kLargestRare = 0.5;

/// Computes an excursion by FORM and by subset simulation, if its probability is in that range.
void add_rare(const ReliabilityConfig& config, const FragilityRow& row, const reliability::UncertainMoments& moments,
              std::size_t k, std::uint64_t seed, Found& found) {
  const double there = reliability::first_excursion(moments.mean[moments.varied[k]], row.limit, config.duration_s).vanmarcke;
  if (there < kLeastRare || there > kLargestRare) return;
  const reliability::LimitState g = reliability::excursion_limit_state(moments, k, row.limit, config.duration_s);
  const Index n = moments.variance_slope[k].size() + 1;
  reliability::FormOptions form_options;
  reliability::SubsetOptions subset_options;
  form_options.seed = subset_options.seed = seed;
  form_options.iterations = config.form_iterations;
  subset_options.largest_levels = config.subset_levels;
  const reliability::FormResult points = reliability::form(g, n, form_options);
  const reliability::SubsetResult subset = reliability::subset_simulation(g, n, subset_options);
  for (const Status& status : {points.status, subset.status})
    if (!status.converged)
      found.rare_status = {false,
                           fmt::format("{} at {:g} m/s: {}; raise form_iterations or subset_levels, or take it out of rare",
                                       row.limit_state, row.speed_m_s, status.message)};
  if (!points.status.converged || !subset.status.converged) return;
  const reliability::DesignPoint& nearest = points.points.front();
  found.rare.push_back({row.limit_state, row.model, row.of, row.speed_m_s, "form", points.probability, nearest.beta,
                        std::nullopt, points.calls,
                        points.strong_maximum ? "" : "a further point of like importance is not ruled out"});
  found.rare.push_back({row.limit_state, row.model, row.of, row.speed_m_s, "subset", subset.probability, std::nullopt,
                        subset.variation, subset.calls,
                        reliability::hidden_region(subset, g, nearest.u, seed) ? "below what FORM's region holds" : ""});
}

void add_limit_states(const ReliabilityConfig& config, const Structure& s, double speed,
                      const reliability::UncertainMoments& moments, std::uint64_t seed, Found& found) {
  const auto add = [&](const std::string& name, std::size_t k, double limit, const std::string& place,
                       const std::string& unit) {
    if (limit <= 0.0) return;
    found.fragility.push_back({name, config.response_model, s.of, speed, place, limit,
                               std::sqrt(moments.mean[moments.varied[k]].variance), unit,
                               reliability::excursion(moments, k, limit, config.duration_s, config.samples, seed)});
    if (contains(config.rare, name)) add_rare(config, found.fragility.back(), moments, k, seed, found);
  };
  const auto node = [&](std::size_t k) {
    return node_name(s.bridge, (moments.varied[k] - 3 * s.bridge.sensors.points.size()) / 2);
  };
  add("comfort_vertical", 1, s.settings.comfort_vertical_m_s2, node(1), "m/s2");
  add("comfort_lateral", 0, s.settings.comfort_lateral_m_s2, node(0), "m/s2");
  for (const StatedComfort& limit : config.comfort) {
    add(limit.name + " vertical", 1, limit.vertical_m_s2, node(1), "m/s2");
    add(limit.name + " lateral", 0, limit.lateral_m_s2, node(0), "m/s2");
  }
  std::size_t k = 2;
  if (!s.stays.names.empty()) {
    const std::size_t stay = moments.varied[k] - s.first_stay();
    add("stay_slack", k++, s.stays.pull_N[static_cast<Index>(stay)], s.stays.names[stay], "N");
  }
  if (!s.dampers.names.empty())
    add("damper_stroke", k, config.damper_stroke_m, s.dampers.names[moments.varied[k] - s.first_damper()], "m");
}

void add_fatigue(const ReliabilityConfig& config, const Structure& s, double speed,
                 const reliability::UncertainMoments& moments, Found& found) {
  reliability::FatigueCurve curve;
  curve.category_Pa = stay_category_Pa(config.stay_class);
  for (std::size_t i = 0; i < s.stays.names.size(); ++i) {
    const reliability::SpectralMoments stress =
        moments.mean[s.first_stay() + i].scaled(1.0 / s.stays.area_m2[static_cast<Index>(i)]);
    found.fatigue.push_back({s.stays.names[i], config.response_model, s.of, speed, std::sqrt(stress.variance),
                             kHour_s * reliability::damage_rate_Hz(stress, curve),
                             kHour_s * reliability::narrow_band_damage_rate_Hz(stress, curve)});
  }
}

/// Responses to turbulence at each mean speed at which the bridge is stable.
void find_responses(const ReliabilityConfig& config, const ReliabilityInputs& read, const Structure& s,
                    runner::StepContext& context, Found& found) {
  const auto critical = std::ranges::find_if(found.critical, [&](const CriticalRow& row) {
    return row.of.years == s.of.years && row.of.same_but_years(s.of) && row.speed.model == config.response_model;
  });
  const reliability::WindResponse response{s.bridge,
                                           s.varied,
                                           s.settings,
                                           read.turbulence,
                                           buffeting::deployment_of(read.aerodynamics, config.response_model),
                                           s.rows,
                                           s.bridge.sensors.motion.rows()};
  std::string left_out;
  for (const double speed : config.speed_m_s) {
    const bool nearby = critical == found.critical.end() || critical->speed.stable_nearby(speed);
    reliability::UncertainMoments moments;
    moments.stable = false;
    if (nearby)
      moments =
          reliability::uncertain_moments(s.uncertain, response, speed, [&](const auto& mean) { return largest_rows(s, mean); });
    if (!moments.stable) {
      left_out += fmt::format("{}{:.4g}", left_out.empty() ? "" : ", ", speed);
      if (nearby)
        context.warn(fmt::format(
            "in year {:g} {} at {:.4g} m/s {} among the modes of step 8, and no mode that step 7 follows loses its damping "
            "below that speed: critical.csv does not know of it; raise followed_modes and n_modes of step 7",
            s.of.years, s.of.words(), speed, moments.growth));
      continue;
    }
    for (const Found::First& first : found.first)
      if (first.of.same_but_years(s.of) && first.speed_m_s == speed)
        moments.add_corrosion(first.moments, s.uncertain.changes());
    add_responses(config, s, speed, moments, found);
    add_limit_states(config, s, speed, moments, context.seed, found);
    add_fatigue(config, s, speed, moments, found);
    if (s.of.years == 0.0) found.first.push_back({s.of, speed, std::move(moments)});
  }
  if (left_out.empty()) return;
  context.warn(
      fmt::format("in year {:g} {} at {} m/s the bridge is unstable, or one deviation of an input away from it: crossings.csv, "
                  "responses.csv and fatigue.csv have no rows of it",
                  s.of.years, s.of.words(), left_out));
}

/// Frequencies, forces and sections after some years. The spread of a frequency comes from the parameters and from the rate of
/// corrosion, in proportion to the change over the years.
void find_years(const ReliabilityInputs& read, const fe::Model& start, const Structure& s, Found& found) {
  const reliability::VariedStructure varied(s.bridge.loaded, aero::bare_structure(s.bridge.model, 0.0), s.bridge.model.motions,
                                            s.bridge.model.modes.shapes, read.parameters);
  const reliability::VariedStructure::Varied at =
      varied.at(s.uncertain.variation(Eigen::VectorXd::Zero(read.random.dimension())));
  const std::vector<reliability::UncertainBridge::Change> changes = s.uncertain.changes();
  for (Index mode = 0; mode < std::min(kModesOverYears, at.structure.size()); ++mode) {
    const double omega = at.structure.omega_rad_s[mode], frequency = omega / (2.0 * EIGEN_PI);
    const std::string place = fmt::format("mode {}", mode + 1);
    const auto first = std::ranges::find_if(found.years, [&](const YearRow& row) {
      return row.quantity == "frequency" && row.of.years == 0.0 && row.place == place;
    });
    double square = 0.0;
    for (const auto& change : changes) {
      const reliability::VariedStructure::Slope slope = varied.slope(at, change.parameters, 0.0);
      double log = 0.5 * (slope.stiffness(mode, mode) / (omega * omega) - slope.mass(mode, mode));
      if (first != found.years.end()) log += change.corrosion * std::log(frequency / first->value);
      square += log * log;
    }
    found.years.push_back({s.of, "frequency", place, "Hz", frequency, std::sqrt(square)});
  }
  for (std::size_t i = 0; i < s.stays.names.size(); ++i)
    found.years.push_back({s.of, "stay_force", s.stays.names[i], "N", s.stays.pull_N[static_cast<Index>(i)], std::nullopt});
  for (const reliability::Wall& wall : read.walls)
    for (const fe::Section& section : start.sections)
      if (contains(wall.sections, section.name))
        found.years.push_back({s.of, "remaining_area", section.name, "-", wall.remaining(section, s.of.years), std::nullopt});
}

/// Smallest loss of each wall that two measurements of the frequencies would show.
void find_visible(const ReliabilityInputs& read, const fe::Model& start, const Structure& s, runner::StepContext& context) {
  const aero::WindModel& model = s.bridge.model;
  std::vector<MonitoredName> known;
  std::vector<reliability::MonitoredMode> modes;
  for (const MonitoredName& monitored : read.monitored) {
    if (monitored.mode.mode >= model.modes.frequency_Hz.size()) continue;
    known.push_back(monitored);
    modes.push_back(monitored.mode);
  }
  write_visible(reliability::visible_losses(start, model.modes.shapes, model.modes.frequency_Hz, read.walls, modes), read.walls,
                known, context.out);
}

/// Annual hours, probabilities and damage under the user's wind law. A limit counts as exceeded above the last computed speed,
/// and where the bridge is unstable.
std::vector<AnnualRow> annual_rows(const reliability::WindLaw& law, const Found& found) {
  std::map<std::string, std::pair<AnnualRow, reliability::OverSpeed>> curves, bounds, damages;
  const auto add = [](auto& into, const AnnualRow& row, double speed, double value) {
    auto& [kept, curve] =
        into[fmt::format("{}|{}|{}|{:06.1f}|{}", row.quantity, row.of.dampers, row.of.fault, row.of.years, row.place)];
    kept = row;
    curve.speed_m_s.push_back(speed);
    curve.value.push_back(value);
  };
  const std::string unit = law.of_all_means() ? "hours per year" : "probability per year";
  for (const FragilityRow& row : found.fragility)
    add(curves, {row.limit_state, row.of, "model " + row.model, unit, 0.0, std::nullopt}, row.speed_m_s, row.excursion.mean);
  std::vector<AnnualRow> rows;
  for (auto& [key, entry] : curves) {
    AnnualRow row = entry.first;
    row.value = (law.of_all_means() ? kYear_h : 1.0) * law.average([&](double v) { return entry.second.probability(v, 1.0); });
    rows.push_back(row);
  }
  if (!law.of_all_means()) return rows;
  for (const FatigueRow& row : found.fatigue) {
    const AnnualRow annual{"fatigue_damage", row.of, row.stay, "per year", 0.0, std::nullopt};
    add(bounds, annual, row.speed_m_s, row.narrow_band_per_hour);
    add(damages, annual, row.speed_m_s, row.damage_per_hour);
  }
  for (auto& [key, entry] : damages) {
    if (entry.second.value.size() < 2) continue;
    AnnualRow row = entry.first;
    row.value = kYear_h * law.average([&](double v) { return entry.second.damage(v); });
    row.upper = kYear_h * law.average([&](double v) { return bounds.at(key).second.damage(v); });
    rows.push_back(row);
  }
  return rows;
}

/// The cases of a year: without dampers, with them, with each fault.
std::vector<std::pair<Case, fe::Model>> cases_of(const ReliabilityConfig& config, const fe::Model& model, double years) {
  std::vector<std::pair<Case, fe::Model>> out = {{{years, false, ""}, model}};
  if (aero::dampers_of(model).empty()) return out;
  out.push_back({{years, true, ""}, model});
  for (const StatedFault& fault : config.faults) {
    const auto kind = fault.kind == "lost" ? reliability::DamperFault::lost : reliability::DamperFault::held;
    out.push_back({{years, true, fault.damper + " " + fault.kind},
                   reliability::with_damper_fault(model, fault.damper, kind, config.held_stiffness_N_m)});
  }
  return out;
}

}  // namespace

Status run_reliability(const ReliabilityConfig& config, const ReliabilityInputs& read, runner::StepContext& context) {
  // 1. Every year and case: the bridge as it is then, its critical speeds, its responses.
  const fe::Model& start = *read.model.fe_model();
  Found found;
  double done = 0.0;
  for (const double years : config.years) {
    const auto cases = cases_of(config, reliability::worn_model(start, read.walls, years), years);
    for (const auto& [of, model] : cases) {
      const Structure structure(of, read, dynamics::valid_model(model));
      if (!structure.bridge.loaded.state.status.converged) return structure.bridge.loaded.state.status;
      if (!structure.bridge.model.modes.status.converged) return structure.bridge.model.modes.status;
      find_critical(config, read, structure, found);
      find_responses(config, read, structure, context, found);
      if (!of.dampers) find_years(read, start, structure, found);
      if (!of.dampers && years == 0.0 && !read.monitored.empty()) find_visible(read, start, structure, context);
      context.progress("years and cases", ++done, static_cast<double>(cases.size() * config.years.size()));
    }
  }

  if (!found.rare_status.converged) return found.rare_status;
  for (const std::string& name : config.rare)
    if (std::ranges::none_of(found.rare, [&](const RareRow& row) { return row.limit_state == name; }))
      throw InputError({"", 0, "rare"},
                       "names '" + name + "', which is exceeded always or never, or is no limit state, at all speeds",
                       "name a limit state of crossings.csv, and give speeds in which its probability lies between");

  // 2. Tables, and the outcome in words.
  write_random(read.random, context.out);
  write_critical(found.critical, read.random, read.aerodynamics.design_speed_m_s, context.out);
  write_fragility(found.fragility, context.out);
  write_responses(found.responses, context.out);
  write_years(found.years, context.out);
  if (!config.rare.empty()) write_rare(found.rare, context.out);
  write_fatigue(found.fatigue, context.out);
  if (read.law) write_annual(annual_rows(*read.law, found), context.out);
  for (const CriticalRow& row : found.critical) {
    if (!row.speed.speed_m_s) continue;
    context.say(fmt::format(
        "year {:g}, model {} {}: critical speed {:.2f} m/s, deviation {:.1f} %, below {:.1f} m/s with probability {:.3g}",
        row.of.years, row.speed.model, row.of.words(), row.speed.speed_m_s->value, 100.0 * row.speed.speed_m_s->deviation(),
        read.aerodynamics.design_speed_m_s, row.speed.probability_below(read.aerodynamics.design_speed_m_s)));
  }
  return {};
}

}  // namespace twindeck::steps
