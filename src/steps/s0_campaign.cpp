#include "runner/run_step.hpp"
#include "steps/campaign/test_campaign.hpp"

/// Step 0: the virtual test campaign (paper sections 3.1 and 3.2): records of a bridge whose truth is known.
int main(int argc, char** argv) {
  using namespace twindeck;
  steps::CampaignConfig settings;
  runner::Step step;
  step.token = "s0_campaign";
  step.summary = "Simulates the test campaign on the virtual bridge and writes its records as loggers would.";
  step.examples = {
      "s0_campaign --study workflows/ponte_del_mare_virtual --out results/ponte_del_mare_virtual/s0_campaign",
      "s0_campaign --study workflows/ponte_del_mare_virtual --out results/calibration/s0_campaign --set 'corrections=\"\"' "
      "--calibrate",
  };
  step.fields = settings.fields();
  step.flags = {{"calibrate", false, "only find the corrections that bring the named frequencies about: corrections.csv"}};
  step.read = [&](runner::StepContext& context) { return steps::read_test_campaign(context, settings); };
  return runner::run_step(argc, argv, std::move(step));
}
