/// Step 6 (paper section 4.2, Tables 8 to 10): parameters updated within their bounds to the measured frequencies.
#include "dynamics/unit_slips.hpp"
#include "model_io/any_model_folder.hpp"
#include "model_io/modes_io.hpp"
#include "steps/measured/comparison_tables.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/updating/inputs.hpp"
#include "steps/updating/outputs.hpp"
#include "updating/paired_modes.hpp"
#include "updating/weighing_words.hpp"

namespace {
using namespace twindeck;
Status run(const steps::UpdatingConfig& asked, const steps::UpdatingInputs& read, runner::StepContext& context) {
  // 1. The refined model and the measured modes.
  const auto& [model, measured, active, selected, published] = read;
  const dynamics::LoadedModel before = dynamics::solvable(model);
  if (!before.state.status.converged) return before.state.status;
  const steps::UpdatingConfig config = asked.for_band_of(measured, before);

  // 2. Pairs of measured and computed modes.
  const auto modes_before = dynamics::available_modes(before.system, before.theta, config.n_modes);
  if (!modes_before.status.converged) return modes_before.status;
  judge_units(context, before, modes_before.frequency_Hz, steps::frequencies_of(measured, config, before, modes_before));
  const auto pairing = updating::pair_for_updating(context, config, before, modes_before, measured);
  const auto rows = updating::weighed_rows(config, measured, pairing, before, modes_before);
  if (!rows.given())
    updating::warn_of_twins(context, updating::indistinct_parameters(before, modes_before, active, measured, pairing),
                            measured.modes.has_shapes());

  // 3. The update.
  const auto targets = updating::frequency_targets(measured, pairing);
  const auto progress = [&](int done, int of) { context.progress("starts", done, of); };
  const auto update = [&](const std::vector<int>& chosen, const std::vector<Eigen::VectorXd>& elsewhere) {
    return updating::update(before.system, updating::prestress_refresh(before), chosen, targets,
                            config.options(context.seed, elsewhere, chosen == active), progress, rows);
  };
  const updating::UpdatingResult result = update(active, published);
  if (result.starts.empty() || result.mode_after.empty()) return result.status;

  // 4. The updated model, in balance, with its modes and the same pairs.
  const dynamics::LoadedModel after = dynamics::with_values(before, result.theta);
  const auto modes_after = dynamics::available_modes(after.system, after.theta, config.n_modes);
  const matching::Pairing followed = updating::followed_pairing(config, pairing, result, after, modes_after, measured);
  const matching::PairingAccount account = updating::account_after(context, followed, modes_after, measured);
  std::vector<matching::ComparisonRow> comparison = matching::compare("before", measured, modes_before.frequency_Hz, pairing);
  for (auto& row : matching::compare("after", measured, modes_after.frequency_Hz, followed)) comparison.push_back(row);

  // 5. Tables, the model, and the outcome in words.
  steps::write_updating({before.system.parameters, active, result}, comparison, config.common_pairs, context);
  if (!selected.empty()) steps::write_selected({before.system.parameters, selected, update(selected, {})}, comparison, context);
  steps::write_mac(measured, followed, context.out);
  model_io::write_modes(model_io::published_modes(after.fe_model(), after.system, modes_after), context.out);
  model_io::save_model(before, result.theta, context.out / "model");
  if (result.regularised) model_io::save_model(before, result.regularised->theta, context.out / "regularised_model");
  for (const std::string& line : steps::report_lines({before.system.parameters, active, result})) context.say(line);
  steps::report_weighing(context, {before, active, measured, pairing, rows, result});
  steps::warn_of_fit(context, measured, comparison, {before.system.parameters, active, result});
  context.say(updating::summary_line(comparison, account));
  return result.status.converged ? matching::outcome(modes_after.status, account) : result.status;
}

}  // namespace

int main(int argc, char** argv) {
  steps::UpdatingConfig config;
  runner::Step step;
  step.token = "s6_updating";
  step.summary = "Updates parameters within their bounds to the measured frequencies (dogleg, several starts).";
  step.examples = {"s6_updating --study workflows/ponte_del_mare --out results/ponte_del_mare/s6_updating",
                   "s6_updating --model my_bridge/model --features my_bridge/features --correct "
                   "my_bridge/diagnosis/corrections.toml --out my_bridge/updated"};
  step.fields = config.fields();
  step.flags = steps::measured_flags();
  step.configured_inputs = {"model"};
  step.read = [&config](runner::StepContext& context) -> runner::Computation {
    return [&config, &context, read = steps::read_updating(config, context)] { return run(config, read, context); };
  };
  return runner::run_step(argc, argv, std::move(step));
}
