#include "steps/aerodynamics/aerodynamics.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "aero/wind_study.hpp"
#include "core/units.hpp"
#include "io/csv.hpp"
#include "linalg/cholesky.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/wind/deck_files.hpp"

namespace twindeck::steps {
namespace {

struct WindOutcome {
  std::vector<aero::FittedSet> sets;
  aero::Instabilities instabilities;
  std::vector<aero::StaticResponse> statics;
};

const char* on_off(bool on) { return on ? "on" : "off"; }

std::string status_of(const aero::CriticalRow& row, double max_speed_m_s) {
  const std::string found = row.point ? "unstable" : "stable up to " + io::format_number(max_speed_m_s) + " m/s";
  return row.lost.empty() ? found : found + "; " + row.lost;
}

/// critical.csv. V_cr is empty if no mode becomes unstable up to `max_speed`. `ratio_to_A` and `f_cr_over_f1` are relative to
/// model A of the same set without dampers at `structural_damping`, and empty if `models` has no A.
void write_critical(const std::vector<aero::CriticalRow>& rows, const AerodynamicsConfig& config,
                    const std::filesystem::path& file) {
  std::map<std::string, double> speed_of_A;
  for (const aero::CriticalRow& row : rows)
    if (row.model == "A" && !row.dampers && row.structural_damping == config.structural_damping && row.point)
      speed_of_A.emplace(row.set, row.point->speed_m_s);
  io::CsvWriter csv({"set", "model", "group", "description", "dampers", "structural_damping_pct", "mode", "V_cr_m_s", "f_cr_Hz",
                     "ratio_to_A", "f_cr_over_f1", "deck", "theta_rms_deg", "deck_share", "exponent", "V_cr_single_mode_m_s",
                     "V_den_hartog_m_s", "V_divergence_m_s", "status"});
  for (const aero::CriticalRow& row : rows) {
    const auto a = speed_of_A.find(row.set);
    const aero::CriticalPoint at = row.point.value_or(aero::CriticalPoint{});
    const auto found = [&](double value) { return row.point ? std::optional<double>(value) : std::nullopt; };
    csv.row({row.set, row.model, row.group, row.description, on_off(row.dampers), 100.0 * row.structural_damping,
             row.point ? io::Cell(at.mode) : "", found(at.speed_m_s), found(at.frequency_Hz),
             a != speed_of_A.end() ? found(at.speed_m_s / a->second) : std::nullopt,
             found(at.frequency_Hz / at.still_air_frequency_Hz), row.character.deck,
             found(row.character.theta_rms_rad * degrees), found(row.character.deck_share), found(row.character.exponent),
             row.single_mode_m_s, row.den_hartog_m_s, row.divergence_m_s, status_of(row, config.max_speed_m_s)});
  }
  csv.save(file);
}

/// damping.csv: total damping of each mode over the wind speed (Fig. 20).
void write_damping(const std::vector<aero::DampingCurves>& curves, const std::filesystem::path& file) {
  io::CsvWriter csv(
      {"set", "model", "dampers", "structural_damping_pct", "mode", "V_m_s", "frequency_Hz", "damping_ratio_pct"});
  for (const aero::DampingCurves& curve : curves)
    for (const aero::Branch& branch : curve.branches)
      for (std::size_t i = 0; i < branch.points.size(); ++i)
        csv.row({curve.set, curve.model, on_off(curve.dampers), 100.0 * curve.structural_damping, branch.mode,
                 branch.speed_m_s[i], branch.points[i].frequency_Hz(), 100.0 * branch.points[i].damping_ratio()});
  csv.save(file);
}

/// nodes.csv: where and how each strip stands in the wind (Figs 16, 17, 21): yaw, B, B', L, L', angle of attack.
void write_nodes(const std::vector<aero::Strip>& strips, const std::vector<aero::SectionAero>& sections,
                 const std::filesystem::path& file) {
  io::CsvWriter csv({"deck", "node", "station_m", "x_m", "y_m", "z_m", "yaw_deg", "angle_of_attack_deg", "chord_m", "length_m",
                     "oblique_chord_m", "oblique_length_m"});
  std::map<std::string, int> number;
  for (const aero::Strip& strip : strips) {
    const double c = std::cos(strip.yaw_rad), chord = sections[static_cast<std::size_t>(strip.section)].chord_m;
    csv.row({strip.deck, ++number[strip.deck], strip.station_m, strip.x_m.x(), strip.x_m.y(), strip.x_m.z(),
             strip.yaw_rad * degrees, strip.alpha_rad * degrees, chord, strip.length_m, chord / c, strip.length_m * c});
  }
  csv.save(file);
}

void write_static(const std::vector<aero::StaticResponse>& responses, const std::vector<aero::Strip>& strips,
                  const std::filesystem::path& file) {
  io::CsvWriter csv({"set", "model", "deck", "node", "station_m", "yaw_deg", "drag_N", "lift_N", "moment_N_m", "x_m", "y_m",
                     "z_m", "rotation_deg"});
  for (const aero::StaticResponse& response : responses) {
    std::map<std::string, int> number;
    for (std::size_t i = 0; i < strips.size(); ++i) {
      const Eigen::Vector3d &f = response.force[i], &u = response.displacement[i];
      csv.row({response.set, response.model, strips[i].deck, ++number[strips[i].deck], strips[i].station_m,
               strips[i].yaw_rad * degrees, f(0), f(1), f(2), u.x(), u.y(), u.z(), response.rotation_rad[i] * degrees});
    }
  }
  csv.save(file);
}

/// rules.csv: the rules of Tables 11 and 14 as data, from which the text cells of the tables are made.
void write_rules(const AerodynamicsConfig& config, const std::filesystem::path& file) {
  io::CsvWriter csv({"deployment", "deck", "beyond_deg", "model", "group", "description", "statics", "lookup_cos_power",
                     "block_inverse_cos_power_force", "block_inverse_cos_power_cross", "block_inverse_cos_power_moment",
                     "axes"});
  const auto put = [&](const std::string& deployment, const std::string& deck, std::optional<double> beyond,
                       const aero::YawRule& rule) {
    csv.row({deployment, deck, beyond, rule.name, rule.group, rule.description, name_of(rule.statics), rule.lookup_power,
             rule.inverse_power(0, 0), rule.inverse_power(0, 2), rule.inverse_power(2, 2),
             rule.axes == aero::ForceAxes::deck ? "deck" : "wind"});
  };
  for (const aero::Deployment& deployment : config.deployments()) {
    put(deployment.name, "", std::nullopt, deployment.everywhere);
    for (const aero::Deployment::Zone& zone : deployment.zones)
      put(deployment.name, zone.deck, zone.beyond_rad * degrees, zone.rule);
  }
  csv.save(file);
}

/// equations.csv: equations of the paper that cannot hold as printed.
void write_equations(const std::filesystem::path& file) {
  io::CsvWriter csv({"equation", "printed", "taken", "reason", "as_printed_can_be_chosen"});
  for (const aero::EquationDifference& d : aero::equation_differences())
    csv.row({d.equation, d.printed, d.taken, d.reason, d.selectable ? 1 : 0});
  csv.save(file);
}

/// galloping.csv: Den Hartog's sum C_L' + C_D of each deck over the polar's angles, and h1* over reduced velocity (Fig. 19).
/// Angles go from -4 to 4 degrees and reduced velocities from 1 to 20, as far as polar and table reach.
void write_galloping(const std::vector<aero::FittedSet>& sets, const std::filesystem::path& file) {
  io::CsvWriter csv({"set", "deck", "angle_of_attack_deg", "V_over_fB", "h1", "den_hartog"});
  for (const aero::FittedSet& set : sets) {
    for (const aero::SectionAero& section : set.sections) {
      for (const double alpha : {-4.0, -2.0, 0.0, 2.0, 4.0}) {
        if (!section.polar.covers(alpha / degrees)) continue;
        for (double v = 1.0; v <= 20.0; v += 0.5) {
          const double v_omega = v / (2.0 * std::numbers::pi);
          if (!section.derivatives->covers(alpha / degrees, v_omega)) continue;
          const aero::StaticCoefficients c = section.polar.at(alpha / degrees);
          const auto zasso =
              aero::from_block(aero::Convention::zasso, section.derivatives->at(alpha / degrees, v_omega), v_omega);
          csv.row({set.name, section.name, alpha, v, zasso[0], c.lift_slope + c.drag});
        }
      }
    }
  }
  csv.save(file);
}

void write_polars(const std::vector<aero::FittedSet>& sets, const std::filesystem::path& file) {
  io::CsvWriter csv({"set", "deck", "angle_of_attack_deg", "C_D", "C_L", "C_M"});
  for (const aero::FittedSet& set : sets) {
    for (const aero::SectionAero& section : set.sections) {
      for (const double alpha : section.polar.alpha_rad()) {
        const aero::StaticCoefficients c = section.polar.at(alpha);
        csv.row({set.name, section.name, alpha * degrees, c.drag, c.lift, c.moment});
      }
    }
  }
  csv.save(file);
}

void write_summary(const AerodynamicsConfig& config, const aero::WindModel& model, const WindOutcome& found,
                   const std::filesystem::path& file) {
  const std::optional<aero::StaticDifference> difference = aero::static_difference(found.statics, "G", "H");
  io::CsvWriter summary({"quantity", "value", "unit"});
  summary.row({"still_air_frequency_1", model.modes.frequency_Hz(0), "Hz"});
  summary.row({"design_speed", config.design_speed_m_s, "m/s"});
  if (difference) {
    summary.row({"static_displacement_G_H", difference->displacement_m, "m"});
    summary.row({"static_rotation_G_H", difference->rotation_rad * degrees, "deg"});
  }
  for (const aero::DampingCurves& curves : found.instabilities.damping)
    if (curves.dampers)
      summary.row(
          {"least_damping_with_dampers_" + curves.set, 100.0 * aero::least_damping(curves, config.design_speed_m_s), "%"});
  summary.save(file);
}

/// Quantity that the level of a set multiplies, in words.
std::string fitted_quantity(const std::string& set) { return set == "standin" ? "self-excited forces" : "lift slope"; }

void write_tables(const AerodynamicsConfig& config, const aero::WindModel& model, const WindOutcome& found,
                  const std::filesystem::path& folder) {
  io::CsvWriter levels({"set", "level", "fitted_quantity", "fitted_model", "fitted_speed_m_s"});
  for (const aero::FittedSet& set : found.sets)
    levels.row({set.name, set.level, fitted_quantity(set.name), config.fit_model, config.fit_speed_m_s});
  levels.save(folder / "sets.csv");
  write_critical(found.instabilities.critical, config, folder / "critical.csv");
  write_damping(found.instabilities.damping, folder / "damping.csv");
  write_nodes(model.strips, found.sets.front().sections, folder / "nodes.csv");
  write_static(found.statics, model.strips, folder / "static.csv");
  write_rules(config, folder / "rules.csv");
  write_equations(folder / "equations.csv");
  write_galloping(found.sets, folder / "galloping.csv");
  write_polars(found.sets, folder / "polars.csv");
  write_summary(config, model, found, folder / "summary.csv");
}

void say_outcome(const runner::StepContext& context, const AerodynamicsConfig& config, const aero::Instabilities& found) {
  for (const aero::CriticalRow& row : found.critical) {
    if (row.point) {
      context.say(fmt::format(
          "{:<13} {:<9} {} {:.2f} %: mode {} at {:.2f} m/s, {:.4f} Hz, theta_rms {:.1f} deg on {}, exponent {:.2f}", row.set,
          row.model, row.dampers ? "damped" : "bare", 100.0 * row.structural_damping, row.point->mode, row.point->speed_m_s,
          row.point->frequency_Hz, row.character.theta_rms_rad * degrees, row.character.deck, row.character.exponent));
    } else {
      context.say(fmt::format("{:<13} {:<9} {} {:.2f} %: stable up to {:.0f} m/s", row.set, row.model,
                              row.dampers ? "damped" : "bare", 100.0 * row.structural_damping, config.max_speed_m_s));
    }
  }
  for (const aero::DampingCurves& curves : found.damping)
    for (const aero::Branch& branch : curves.branches)
      if (!branch.status.converged)
        context.say(curves.set + (curves.dampers ? ", with dampers: " : ": ") + branch.status.message);
}

Status run_aerodynamics(runner::StepContext& context, const AerodynamicsConfig& config,
                        const std::vector<aero::DeckAerodynamics>& data, const dynamics::ReadModel& read) {
  // 1. The updated model with its aerodynamic nodes, modes, and the angles of attack of its shape under dead load.
  const dynamics::LoadedModel loaded = dynamics::solvable(read);
  if (!loaded.state.status.converged) return loaded.state.status;
  const aero::WindModel model = aero::prepare_wind_model(config, loaded);
  if (!model.modes.status.converged) return model.modes.status;

  // 2. The aerodynamic sets, their level fitted to one critical speed.
  WindOutcome found;
  for (const std::string& name : config.sets) {
    const std::optional<double> level = aero::fit_level(config, data, name, model);
    if (!level)
      return {false, "set " + name + ": no level makes mode 1 critical at " + io::format_number(config.fit_speed_m_s) + " m/s"};
    found.sets.push_back({name, *level, aero::sections_of(config, data, name, *level)});
    context.say(fmt::format("set {}: {} times {:.4f}", name, fitted_quantity(name), *level));
  }

  // 3. Critical speeds and damping over the wind speed; static wind (Eq. 7) at the design speed.
  found.instabilities =
      aero::find_instabilities(config, found.sets, model, aero::with_dampers(model, loaded, config.structural_damping));
  linalg::Cholesky factor;
  const Status factored = factor.factorize(loaded.system.stiffness(loaded.theta));
  if (!factored.converged) return factored;
  for (const aero::FittedSet& set : found.sets)
    for (const aero::Deployment& deployment : config.deployments())
      found.statics.push_back(aero::static_response(config, set, deployment, model, loaded, factor));

  // 4. Tables, and the outcome in words.
  write_tables(config, model, found, context.out);
  say_outcome(context, config, found.instabilities);
  return {};
}

}  // namespace

runner::Computation read_aerodynamics(runner::StepContext& context, const AerodynamicsConfig& config) {
  const std::vector<aero::DeckAerodynamics> data = read_deck_aerodynamics(config, context);
  const dynamics::ReadModel model = load_model(context, context.results / "s6_updating" / "model");
  static_cast<void>(aero::aero_nodes_of(config, model.fe_model(), model.source));
  if (const std::string untaken = aero::untaken_in_words(*model.fe_model()); !untaken.empty()) context.warn(untaken);
  if (config.sets.empty()) throw InputError({"", 0, "sets"}, "is empty", "name at least one of standin, quasi_steady");
  for (const std::string& set : config.sets) static_cast<void>(aero::sections_of(config, data, set, 1.0));
  return [&context, &config, data, model] { return run_aerodynamics(context, config, data, model); };
}

}  // namespace twindeck::steps
