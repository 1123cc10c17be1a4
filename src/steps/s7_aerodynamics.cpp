/// Step 7 (paper section 5.1, Tables 11 and 12, Figs 16 to 20): the updated model in mean wind, damping and critical speeds.
#include "steps/aerodynamics/aerodynamics.hpp"

int main(int argc, char** argv) {
  using namespace twindeck;
  steps::AerodynamicsConfig config;
  runner::Step step;
  step.token = "s7_aerodynamics";
  step.summary =
      "Static wind forces, damping over the wind speed and critical speeds of the models of Table 11, with and without "
      "dampers.";
  step.examples = {"s7_aerodynamics --study workflows/ponte_del_mare --out results/ponte_del_mare/s7_aerodynamics",
                   "s7_aerodynamics --study workflows/ponte_del_mare --model my_bridge/model --out my_bridge/s7_aerodynamics "
                   "--set nodes_per_deck=60"};
  step.fields = config.fields();
  step.configured_inputs = {"model"};
  step.read = [&](runner::StepContext& context) { return steps::read_aerodynamics(context, config); };
  return runner::run_step(argc, argv, std::move(step));
}
