#include "steps/aerodynamics/aerodynamics.hpp"

#include <fmt/format.h>

#include <optional>

#include "core/angle.hpp"
#include "io/csv.hpp"
#include "linalg/cholesky.hpp"
#include "steps/aerodynamics/outputs.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/wind/deck_files.hpp"

namespace twindeck::steps {
namespace {

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
  for (const aero::DampingCurves& curves : found.damping) {
    for (const aero::Branch& branch : curves.branches) {
      if (!branch.status.converged)
        context.say(curves.set + (curves.dampers ? ", with dampers: " : ": ") + branch.status.message);
    }
  }
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
  for (const aero::FittedSet& set : found.sets) {
    for (const aero::Deployment& deployment : config.deployments())
      found.statics.push_back(aero::static_response(config, set, deployment, model, loaded, factor));
  }

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
