#include "steps/validation/inputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "aero_io/turbulence_sets.hpp"
#include "buffeting/bridge_in_wind.hpp"
#include "core/error.hpp"
#include "io/csv.hpp"
#include "steps/shared/model_source.hpp"
#include "steps/wind/deck_files.hpp"

namespace twindeck::steps {

namespace {

AerodynamicsConfig read_step_7(const ValidationConfig& config, runner::StepContext& context) {
  if (config.aerodynamics.empty() && context.study.empty()) {
    throw InputError({"", 0, "aerodynamics"}, "neither a study nor a configuration of step 7 was given",
                     "give --study, or --set aerodynamics=s7_aerodynamics.toml");
  }
  AerodynamicsConfig out;
  io::FieldTable fields = out.fields();
  fields.load(context.input(config.aerodynamics.empty() ? context.study / "s7_aerodynamics.toml"
                                                        : std::filesystem::path(config.aerodynamics)));
  fields.require();
  return out;
}

/// The level that step 7 fitted for a set.
double fitted_level(runner::StepContext& context, const std::string& set) {
  const std::filesystem::path file = context.input(context.results / "s7_aerodynamics" / "sets.csv");
  const io::CsvTable table = io::CsvTable::read(file, {"set", "level"}, {}, true);
  std::vector<std::string> known;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "set") == set) {
      const double level = table.number(row, "level");
      if (level > 0.0) return level;
      table.fail(row, "level", fmt::format("is {}, expected a factor above 0", table.text(row, "level")),
                 "run step 7 again, which writes this file");
    }
    known.push_back(table.text(row, "set"));
  }
  throw InputError({file.string(), 0, "set"}, "has no set '" + set + "'" + did_you_mean(set, known),
                   fmt::format("choose one of {}", fmt::join(known, ", ")));
}

}  // namespace

ValidationInputs read_validation_inputs(const ValidationConfig& config, runner::StepContext& context) {
  if (config.events.empty() || config.runs.empty()) {
    throw InputError({"", 0, config.events.empty() ? "event" : "run"}, "none is given", "add [[event]] and [[run]] tables");
  }
  ValidationInputs read;
  read.turbulence = aero_io::read_turbulence_set(context.input(config.turbulence_file), config.turbulence_set);
  read.aerodynamics = read_step_7(config, context);
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
