#include "steps/validation/inputs.hpp"

#include <string>

#include "buffeting/bridge_in_wind.hpp"
#include "core/error.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/wind/deck_files.hpp"
#include "steps/wind/turbulence_files.hpp"

namespace twindeck::steps {

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

}  // namespace twindeck::steps
