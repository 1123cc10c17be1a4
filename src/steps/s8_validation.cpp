/// Step 8 (paper sections 5.2 and 6, Tables 13, 14, Fig. 21): turbulent wind, accelerations with dampers, hybrid deployment.
#include "steps/validation/validation.hpp"

int main(int argc, char** argv) {
  using namespace twindeck;
  steps::ValidationConfig config;
  runner::Step step;
  step.token = "s8_validation";
  step.summary =
      "Simulates turbulent wind on the updated bridge and its accelerations in wind events, with intervals over seeds.";
  step.examples = {"s8_validation --study workflows/ponte_del_mare --out results/ponte_del_mare/s8_validation",
                   "s8_validation --study workflows/ponte_del_mare --out calm --results results/ponte_del_mare --set seeds=4 "
                   "--set turbulence_set='\"EN 0\"'"};
  step.fields = config.fields();
  step.configured_inputs = {"model", "campaign"};
  step.read = [&config](runner::StepContext& context) { return steps::read_validation(config, context); };
  return runner::run_step(argc, argv, std::move(step));
}
