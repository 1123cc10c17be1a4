#include "runner/run_step.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/refinement/refinement.hpp"

/// Step 4: as-built changes, comparison with the measured modes, pairing (paper section 4.1, Tables 6 and 7).
int main(int argc, char** argv) {
  using namespace twindeck;
  steps::RefinementConfig config;
  runner::Step step;
  step.token = "s4_refinement";
  step.summary =
      "As-built changes one by one, comparison of the initial and the refined model with the measured modes, and their "
      "pairing.";
  step.examples = {
      "s4_refinement --study workflows/ponte_del_mare --out results/ponte_del_mare/s4_refinement",
      "s4_refinement --model my_bridge/model --modes my_bridge/measured --out my_bridge/comparison",
      "s4_refinement --model my_bridge/model --features my_bridge/features --condition summer --out my_bridge/summer",
  };
  step.fields = config.fields();
  step.flags = steps::measured_flags();
  step.configured_inputs = {"model"};
  step.read = [&](runner::StepContext& context) { return steps::read_refinement(context, config); };
  return runner::run_step(argc, argv, std::move(step));
}
