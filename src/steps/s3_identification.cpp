/// Step 3 (paper section 3.2, Table 4, Figs. 10-13): modes with standard deviations from records of one or several setups.
#include <algorithm>

#include "identification/mode_choices.hpp"
#include "identification/stays.hpp"
#include "records/inspect.hpp"
#include "runner/run_step.hpp"
#include "steps/identification/inputs.hpp"
#include "steps/identification/outputs.hpp"

namespace {

using namespace twindeck;

Status run(const steps::IdentificationConfig& config, steps::IdentificationInputs& read, runner::StepContext& context) {
  // 1. Each condition: spectra, subspace identification, stabilisation, selection (Eqs. 3-4), standard deviations; setups
  // merged.
  std::vector<identification::ConditionResult>& results = read.conditions;
  for (identification::ConditionResult& result : results) {
    identification::identify_condition(result, config, context);
    for (const std::string& line : steps::report_lines(result)) context.say(line);
  }

  // 2. Free decays by ERA, with frequency and damping by amplitude; stays as tensioned beams. Without ambient records the
  // decays give the modes.
  auto decays = identification::identify_free_decays(read.decays, config, results, context.seed);
  if (read.decays_are_main) {
    results = identification::decay_conditions(decays);
    for (const identification::ConditionResult& result : results)
      for (const std::string& line : steps::report_lines(result)) context.say(line);
  }
  identification::require_poles(config.choices, results);
  const auto stays = identification::identify_stays(read.stays, config);
  for (const std::string& line : steps::stay_lines(stays, config.stay_level)) context.say(line);
  for (const std::string& note : steps::notes_of(decays, stays)) context.warn(note);

  // 3. Tables, exports, and the features that updating and diagnosis read. The first condition's stand at the top.
  steps::write_identification(read.campaign, results, decays, stays, config, context.out);
  if (results.empty()) {
    const bool found = std::ranges::any_of(stays, [](const auto& stay) { return !stay.modes.empty(); });
    if (!found) return {false, "no stay shows harmonics; see stay.lowest and stay.highest, or record for longer"};
  } else if (results.front().modes.empty()) {
    return {false, steps::why_no_mode(results.front())};
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  steps::IdentificationConfig config;
  runner::Step step;
  step.token = "s3_identification";
  step.summary =
      "Identifies modes with standard deviations from vibration records (ambient, free decays, stays, measured inputs) or "
      "frequency response functions.";
  step.examples = {
      "s3_identification --campaign my_campaign --out results/my_bridge/s3_identification --set setup=ST1 --set decimation=8",
      "s3_identification --inspect measurement.csv",
      "s3_identification --modes modes.unv --out results/my_bridge/s3_identification --set imported_std_pct=0.5",
      "s3_identification --study workflows/ponte_del_mare_virtual --results results/ponte_del_mare_virtual --out "
      "results/ponte_del_mare_virtual/s3_identification"};
  step.flags = {{"inspect", true, "tell what a record file holds (CSV, NPY, MAT, HDF5, universal file) and end",
                 [](const std::string& file) { return records::describe(records::inspect(file)); }}};
  step.fields = config.fields();
  step.configured_inputs = {"campaign"};
  step.read = [&config, fields = step.fields](runner::StepContext& context) -> runner::Computation {
    const auto order = fields.place_of("maximum_order");
    config.order_is_default = !order || order->file.empty();
    config.choices = steps::read_mode_choices(config.keep, context);
    if (auto imported = steps::imported_modes(config.imported_std_pct, context)) return *imported;
    auto read = steps::read_identification_inputs(config, context);
    return [&config, &context, read = std::move(read)]() mutable { return run(config, read, context); };
  };
  return runner::run_step(argc, argv, std::move(step));
}
