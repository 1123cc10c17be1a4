#include "steps/aerodynamics/aerodynamics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "io/csv.hpp"
#include "steps/aerodynamics/outputs.hpp"
#include "transient/reduced_basis.hpp"

namespace twindeck::steps {
namespace {

// A set of aerodynamic data at its fitted level.
struct FittedSet {
  std::string name;
  double level;
  std::vector<aero::SectionAero> sections;
};

// What a set's level multiplies, in words.
std::string fitted_quantity(const std::string& set) { return set == "standin" ? "self-excited forces" : "lift slope"; }

std::vector<double> speeds_up_to(const AerodynamicsConfig& config, double limit) {
  std::vector<double> speeds;
  for (int i = 1; speeds.empty() || speeds.back() < limit; ++i) speeds.push_back(std::min(i * config.speed_step_m_s, limit));
  return speeds;
}

// The lowest instability of the first modes, and what is to be said of modes that could not be followed so far. A later mode
// only matters below what was found.
struct Instability {
  std::optional<aero::CriticalPoint> point;
  std::string lost;
};
Instability first_instability(const AerodynamicsConfig& config, const aero::AeroelasticSystem& system) {
  Instability lowest;
  int mode = 0;
  for (const aero::ComplexMode& start : aero::still_air_modes(system.structure())) {
    if (++mode > config.followed_modes) break;
    const double limit = lowest.point ? lowest.point->speed_m_s : config.max_speed_m_s;
    const aero::Branch branch = aero::follow_mode(system, start, mode, speeds_up_to(config, limit));
    const auto found = aero::critical_point(system, branch);
    if (found && (!lowest.point || found->speed_m_s < lowest.point->speed_m_s)) lowest.point = found;
    if (!branch.status.converged && !found) lowest.lost += (lowest.lost.empty() ? "" : "; ") + branch.status.message;
  }
  return lowest;
}

CriticalRow critical_row(const AerodynamicsConfig& config, const std::string& set, const aero::AeroelasticSystem& system,
                         bool dampers, double structural_damping) {
  CriticalRow row;
  const aero::Deployment& deployment = system.deployment();
  row.set = set;
  row.model = deployment.name;
  row.group = deployment.zones.empty() ? deployment.everywhere.group : "Hybrid";
  row.description = deployment.zones.empty() ? deployment.everywhere.description : "Table 14";
  row.dampers = dampers;
  row.structural_damping = structural_damping;
  const Instability instability = first_instability(config, system);
  row.point = instability.point;
  row.lost = instability.lost;
  if (row.point) row.character = aero::galloping_character(system, row.point->motion, row.point->speed_m_s);
  row.divergence_m_s = aero::divergence_speed(system);
  if (!dampers) {
    const aero::AeroelasticSystem alone = system.restricted({0});
    const auto start = aero::still_air_modes(alone.structure());
    const auto point =
        aero::critical_point(alone, aero::follow_mode(alone, start.front(), 1, speeds_up_to(config, config.max_speed_m_s)));
    if (point) row.single_mode_m_s = point->speed_m_s;
    row.den_hartog_m_s = aero::den_hartog_speed(system, 0);
  }
  return row;
}

DampingCurves damping_curves(const AerodynamicsConfig& config, const std::string& set, const aero::AeroelasticSystem& system,
                             bool dampers, double structural_damping, long modes) {
  DampingCurves curves{set, system.deployment().name, dampers, structural_damping, {}};
  int mode = 0;
  for (const aero::ComplexMode& start : aero::still_air_modes(system.structure())) {
    if (++mode > modes) break;
    curves.branches.push_back(aero::follow_mode(system, start, mode, speeds_up_to(config, config.max_speed_m_s)));
  }
  return curves;
}

StaticResponse static_response(const AerodynamicsConfig& config, const FittedSet& set, const aero::Deployment& deployment,
                               const WindModel& model, const LoadedModel& loaded, const linalg::Cholesky& factor) {
  StaticResponse response{set.name, deployment.name, {}, {}, {}};
  Eigen::VectorXd at_nodes(6 * static_cast<Eigen::Index>(model.strips.size()));
  for (std::size_t i = 0; i < model.strips.size(); ++i) {
    const aero::Strip& strip = model.strips[i];
    const aero::YawRule& rule = deployment.at(strip.deck, strip.yaw_rad);
    const Eigen::Vector3d force = aero::static_force(set.sections[static_cast<std::size_t>(strip.section)], strip, rule,
                                                     config.density_kg_m3, config.design_speed_m_s, config.equation_choice());
    response.force.push_back(force);
    at_nodes.segment<6>(6 * static_cast<Eigen::Index>(i)) =
        aero::kinematics(strip, rule.axes, config.wind()).transpose() * force;
  }
  const Eigen::VectorXd nodal = model.nodes.motion.transpose() * at_nodes;
  const Eigen::MatrixXd free = loaded.system.expansion.transpose() * nodal;
  const auto motions = motions_of(model.nodes, loaded.system.expand(factor.solve(free)));
  for (std::size_t i = 0; i < motions.size(); ++i) {
    response.displacement.emplace_back(motions[i].col(0).head<3>());
    response.rotation_rad.push_back(aero::nose_up(model.strips[i], motions[i].col(0).tail<3>()));
  }
  return response;
}

// Largest differences between two rules' static responses: what the paper states of NS #1 and NS #2 (Eq. 7).
struct StaticDifference {
  double displacement_m = 0.0, rotation_rad = 0.0;
};
StaticDifference static_difference(const std::vector<StaticResponse>& responses, const std::string& a, const std::string& b) {
  const StaticResponse *first = nullptr, *second = nullptr;
  for (const StaticResponse& response : responses) {
    if (response.model == a && first == nullptr) first = &response;
    if (response.model == b && second == nullptr) second = &response;
  }
  StaticDifference largest;
  if (first == nullptr || second == nullptr) return largest;
  for (std::size_t i = 0; i < first->displacement.size(); ++i) {
    largest.displacement_m = std::max(largest.displacement_m, (first->displacement[i] - second->displacement[i]).norm());
    largest.rotation_rad = std::max(largest.rotation_rad, std::abs(first->rotation_rad[i] - second->rotation_rad[i]));
  }
  return largest;
}

// Least damping of any followed mode up to a speed.
double least_damping(const DampingCurves& curves, double up_to_m_s) {
  double least = 1.0;
  for (const aero::Branch& branch : curves.branches) {
    for (std::size_t i = 0; i < branch.points.size(); ++i) {
      if (branch.speed_m_s[i] <= up_to_m_s) least = std::min(least, branch.points[i].damping_ratio());
    }
  }
  return least;
}

Status run_aerodynamics(StepContext& context, const AerodynamicsConfig& config, const std::vector<DeckAerodynamics>& data,
                        const ReadModel& read) {
  // 1. The updated model with its aerodynamic nodes, modes, and the angles of attack of its shape under dead load.
  const LoadedModel loaded = solvable(read);
  if (!loaded.state.status.converged) return loaded.state.status;
  const WindModel model = prepare_wind_model(config, loaded);
  if (!model.modes.status.converged) return model.modes.status;
  const aero::ReducedStructure bare = bare_structure(model, config.structural_damping);
  const DampedModel damped = with_dampers(model, loaded, config.structural_damping);

  // 2. The aerodynamic sets, their level fitted to one critical speed.
  std::vector<FittedSet> sets;
  for (const std::string& name : config.sets) {
    const std::optional<double> level = fit_level(config, data, name, model);
    if (!level)
      return {false, "set " + name + ": no level makes mode 1 critical at " + io::format_number(config.fit_speed_m_s) + " m/s"};
    sets.push_back({name, *level, sections_of(config, data, name, *level)});
    context.say(fmt::format("set {}: {} times {:.4f}", name, fitted_quantity(name), *level));
  }

  // 3. Critical speeds of every set and rule; damping over the wind speed; with the identified damping; with dampers.
  const aero::Wind wind = config.wind();
  const auto system = [&](const FittedSet& set, const aero::Deployment& deployment) {
    return aero::AeroelasticSystem(bare, set.sections, model.strips, model.motions, wind, deployment);
  };
  const std::vector<aero::Deployment> deployments = config.deployments();
  std::vector<CriticalRow> critical;
  std::vector<DampingCurves> damping;
  for (const FittedSet& set : sets) {
    for (const aero::Deployment& deployment : deployments) {
      critical.push_back(critical_row(config, set.name, system(set, deployment), false, config.structural_damping));
    }
    const aero::Deployment fitted = aero::everywhere(aero::published_yaw_rule(config.fit_model));
    damping.push_back(
        damping_curves(config, set.name, system(set, fitted), false, config.structural_damping, config.followed_modes));
    aero::ReducedStructure identified = bare;
    identified.damping_ratio.setConstant(config.identified_damping);
    const aero::AeroelasticSystem as_identified(identified, set.sections, model.strips, model.motions, wind, fitted);
    critical.push_back(critical_row(config, set.name, as_identified, false, config.identified_damping));
    damping.push_back(damping_curves(config, set.name, as_identified, false, config.identified_damping, 1));
    if (damped.dampers > 0) {
      const aero::AeroelasticSystem with(damped.structure, set.sections, model.strips, damped.motions, wind, fitted);
      critical.push_back(critical_row(config, set.name, with, true, config.structural_damping));
      damping.push_back(damping_curves(config, set.name, with, true, config.structural_damping, config.damped_modes));
    }
  }

  // 4. Static wind (Eq. 7) at the design speed.
  linalg::Cholesky factor;
  const Status factored = factor.factorize(loaded.system.stiffness(loaded.theta));
  if (!factored.converged) return factored;
  std::vector<StaticResponse> statics;
  for (const FittedSet& set : sets) {
    for (const aero::Deployment& deployment : deployments)
      statics.push_back(static_response(config, set, deployment, model, loaded, factor));
  }
  const StaticDifference difference = static_difference(statics, "G", "H");

  // 5. Tables, and the outcome in words.
  std::vector<std::string> names;
  std::vector<std::vector<aero::SectionAero>> sections;
  io::CsvWriter levels({"set", "level", "fitted_quantity", "fitted_model", "fitted_speed_m_s"});
  for (const FittedSet& set : sets) {
    names.push_back(set.name);
    sections.push_back(set.sections);
    levels.row({set.name, set.level, fitted_quantity(set.name), config.fit_model, config.fit_speed_m_s});
  }
  levels.save(context.out / "sets.csv");
  write_critical(critical, config.max_speed_m_s, context.out / "critical.csv");
  write_damping(damping, context.out / "damping.csv");
  write_nodes(model.strips, sets.front().sections, context.out / "nodes.csv");
  write_static(statics, model.strips, context.out / "static.csv");
  write_rules(config, context.out / "rules.csv");
  write_equations(context.out / "equations.csv");
  write_galloping(names, sections, context.out / "galloping.csv");
  write_polars(names, sections, context.out / "polars.csv");
  io::CsvWriter summary({"quantity", "value", "unit"});
  summary.row({"still_air_frequency_1", model.modes.frequency_Hz(0), "Hz"});
  summary.row({"design_speed", config.design_speed_m_s, "m/s"});
  summary.row({"static_displacement_G_H", difference.displacement_m, "m"});
  summary.row({"static_rotation_G_H", difference.rotation_rad * degrees, "deg"});
  for (const DampingCurves& curves : damping) {
    if (curves.dampers) {
      summary.row({"least_damping_with_dampers_" + curves.set, 100.0 * least_damping(curves, config.design_speed_m_s), "%"});
    }
  }
  summary.save(context.out / "summary.csv");
  Status status;
  for (const CriticalRow& row : critical) {
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
  for (const DampingCurves& curves : damping) {
    for (const aero::Branch& branch : curves.branches) {
      if (!branch.status.converged)
        context.say(curves.set + (curves.dampers ? ", with dampers: " : ": ") + branch.status.message);
    }
  }
  return status;
}

}  // namespace

Computation read_aerodynamics(StepContext& context, const AerodynamicsConfig& config) {
  const std::vector<DeckAerodynamics> data = read_deck_aerodynamics(config, context);
  const ReadModel model = load_model(context, context.results / "s6_updating" / "model");
  static_cast<void>(aero_nodes_of(config, model.fe_model(), model.source));
  if (config.sets.empty()) throw InputError({"", 0, "sets"}, "is empty", "name at least one of standin, quasi_steady");
  for (const std::string& set : config.sets) static_cast<void>(sections_of(config, data, set, 1.0));
  return [&context, &config, data, model] { return run_aerodynamics(context, config, data, model); };
}

}  // namespace twindeck::steps
