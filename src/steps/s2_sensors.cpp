#include "runner/run_step.hpp"
#include "steps/sensors/sensors.hpp"

/// Step 2: sensor setups, how well they tell the modes apart, and the blind test (paper section 3.1, Table 3).
int main(int argc, char** argv) {
  using namespace twindeck;
  steps::SensorsConfig config;
  runner::Step step;
  step.token = "s2_sensors";
  step.summary = "Scores sensor setups by AutoMAC, searches for better ones and tests them blindly on simulated records.";
  step.examples = {
      "s2_sensors --study workflows/ponte_del_mare_virtual --out results/ponte_del_mare_virtual/s2_sensors",
      "s2_sensors --model my_bridge/model --out my_bridge/sensors --set points=my_points.csv --set setups=my_setups.csv",
  };
  step.fields = config.fields();
  step.configured_inputs = {"model"};
  step.read = [&](runner::StepContext& context) { return steps::read_sensors(context, config); };
  return runner::run_step(argc, argv, std::move(step));
}
