/// Step 10: probabilities for the updated bridge in a given mean wind: comfort limits, loss of stability, and the influence of
/// each input.
#include "steps/reliability/inputs.hpp"
#include "steps/reliability/reliability.hpp"

int main(int argc, char** argv) {
  using namespace twindeck;
  steps::ReliabilityConfig config;
  runner::Step step;
  step.token = "s10_reliability";
  step.summary =
      "Probabilities that the bridge exceeds comfort limits or loses its stability in a given mean wind, with the scatter of "
      "all inputs.";
  step.examples = {
      "s10_reliability --study workflows/ponte_del_mare --results results/ponte_del_mare --out "
      "results/ponte_del_mare/s10_reliability",
      "s10_reliability --study workflows/ponte_del_mare --results results/ponte_del_mare --out calm --set 'speeds=[\"8 "
      "m/s\"]'"};
  step.fields = config.fields();
  step.configured_inputs = {"model"};
  step.read = [&config](runner::StepContext& context) -> runner::Computation {
    return [&config, &context, read = steps::read_reliability_inputs(config, context)] {
      return steps::run_reliability(config, read, context);
    };
  };
  return runner::run_step(argc, argv, std::move(step));
}
