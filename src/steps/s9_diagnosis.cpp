/// Step 9: errors that remain after the model was fitted within its bounds, their cause out of the catalogue, the model with
/// the cause, and the gain on held-out rows (docs/diagnosis.md).
#include "steps/diagnosis/run.hpp"
#include "steps/measured/measured_input.hpp"

int main(int argc, char** argv) {
  using namespace twindeck;
  steps::DiagnosisConfig config;
  runner::Step step;
  step.token = "s9_diagnosis";
  step.summary = "Finds what the model gets wrong, names the cause, extends the model, measures the gain on held-out rows.";
  step.examples = {"s9_diagnosis --study workflows/ponte_del_mare --out results/ponte_del_mare/s9_diagnosis",
                   "s9_diagnosis --model my_bridge/model --features my_bridge/features --out my_bridge/diagnosis",
                   "s9_diagnosis --model my_bridge/model --features my_bridge/features --correct "
                   "my_bridge/diagnosis/corrections.toml --out my_bridge/corrected",
                   "s9_diagnosis --model my_bridge/model --features planned/features --plan --out my_bridge/plan"};
  step.fields = config.fields();
  step.configured_inputs = {"model"};
  step.flags = {{"catalogue", true, "folder of hypotheses, one TOML file each"},
                {"plan", false, "only say what these rows would see: plan.csv"}};
  for (const runner::Flag& flag : steps::measured_flags()) step.flags.push_back(flag);
  step.read = [&config](runner::StepContext& context) { return steps::read_diagnosis(config, context); };
  return runner::run_step(argc, argv, std::move(step));
}
