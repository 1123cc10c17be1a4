/// Step 5 (paper section 4.2, Eq. 6): sensitivity of the modes to the parameters, and the parameters that the measurement
/// determines.

#include "dynamics/unit_slips.hpp"
#include "runner/run_step.hpp"
#include "sensitivity/frequency_sensitivities.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/sensitivity/outputs.hpp"
#include "steps/shared/model_source.hpp"

namespace {

using namespace twindeck;

Status run(const steps::SensitivityConfig& config, const dynamics::ReadModel& read,
           const std::optional<matching::Measured>& measured, runner::StepContext& context) {
  // 1. The refined model, with the prestress of its own parameter values, frozen.
  const dynamics::LoadedModel loaded = dynamics::solvable(read);
  if (!loaded.state.status.converged) return loaded.state.status;

  // 2. Sensitivities three ways: exact, by extrapolated central differences, by Eq. (6).
  const sensitivity::Sensitivities found = sensitivity::frequency_sensitivities(
      loaded.system, loaded.theta, config, [&](int done, int of) { context.progress("differences", done, of); });
  if (found.frequency_Hz.size() == 0) return found.status;
  if (measured) {
    const auto modes = dynamics::available_modes(loaded.system, loaded.theta, config.n_modes);
    dynamics::judge_units(context, loaded, modes.frequency_Hz, steps::frequencies_of(measured, {}, loaded, modes));
  } else {
    dynamics::warn_of_unit_slips(context, loaded, found.frequency_Hz, {});
  }
  sensitivity::refuse_rigid_bodies(found, loaded.source);
  if (!found.richardson.allFinite() || !found.forward.allFinite())
    return {false, found.status.converged ? "a difference of frequencies is no number" : found.status.message};

  // 3. Which parameters to update: the rule of selection.hpp on the compared modes, beside the paper's choice.
  const Eigen::MatrixXd scaled =
      sensitivity::scaled_sensitivity(config.compared_modes, config.frequency_std_pct, loaded.system.parameters, found);
  const std::vector<std::string> names = steps::parameter_names(loaded.system.parameters);
  const auto selection = sensitivity::select_parameters(scaled, names, config.selection_threshold);
  const sensitivity::Identifiability identified = sensitivity::identifiability(scaled, config.singular_value_cutoff);

  // 4. Tables, and the outcome in words.
  const steps::SensitivityOutcome outcome{loaded.system.parameters, found, selection, identified};
  steps::write_tables(outcome, config, context.out);
  for (const std::string& line : steps::sensitivity_report(outcome, config)) context.say(line);
  return found.status;
}

runner::Computation read(steps::SensitivityConfig& config, runner::StepContext& context) {
  const dynamics::ReadModel model = steps::load_model(context, context.results / "s4_refinement" / "model");
  if (config.compared_modes_from == "s4_refinement")
    config.compared_modes = steps::paired_modes(context.input(context.results / "s4_refinement" / "pairs.csv"));
  steps::check_sensitivity_config(config, model.parameters(), model.source);
  // Measured modes are not needed here. If they are given, they can show a slip of units in the model.
  std::optional<matching::Measured> measured;
  if (context.features || context.modes) measured = steps::find_measured(context, "");
  return [&config, &context, model, measured] { return run(config, model, measured, context); };
}

}  // namespace

int main(int argc, char** argv) {
  steps::SensitivityConfig config;
  runner::Step step;
  step.token = "s5_sensitivity";
  step.summary = "Sensitivity of the modes to the parameters, selection of parameters, identifiability.";
  step.examples = {"s5_sensitivity --study workflows/ponte_del_mare --out results/ponte_del_mare/s5_sensitivity",
                   "s5_sensitivity --model my_bridge --out results/my_bridge/s5_sensitivity --set n_modes=8"};
  step.fields = config.fields();
  step.configured_inputs = {"model"};
  step.read = [&config](runner::StepContext& context) { return read(config, context); };
  return runner::run_step(argc, argv, std::move(step));
}
