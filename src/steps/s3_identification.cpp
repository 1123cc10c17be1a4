/// Step 3 (paper section 3.2, Table 4, Figs. 10-13): modes with standard deviations from output-only records of one setup.
#include "steps/identification.hpp"
#include "steps/identification_outputs.hpp"
#include "steps/run_step.hpp"

namespace {

using namespace twindeck;

Status run(const steps::IdentificationConfig& config, steps::StepContext& context) {
  // 1. The campaign: a user's own, or what s0_campaign wrote.
  const auto folder = context.input(context.campaign ? *context.campaign : context.results / "s0_campaign");
  const steps::Campaign campaign = steps::read_campaign(folder);

  // 2. Records chosen, judged, repaired as asked, detrended and decimated.
  const steps::Conditioned conditioned = steps::condition_records(campaign, config);

  // 3. Welch spectra; subspace identification, stabilisation, cleaning (Eqs. 3-4), clusters, standard deviations.
  const signal::PowerSpectra spectra = steps::average_spectra(conditioned, config);
  const sysid::Identification found = steps::identify_modes(conditioned, config);
  for (const std::string& line : steps::report_lines(found)) context.say(line);

  // 4. Tables, and the features that updating and diagnosis read.
  steps::write_identified_modes(conditioned, found, context.out);
  steps::write_poles(conditioned, found, context.out);
  steps::write_spectra(conditioned, spectra, context.out);
  steps::write_features(campaign, conditioned, found, context.out / "features");
  if (found.modes.empty()) return {false, "no mode is stable over the model orders; see poles.csv, and raise block_rows or the record's length"};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  steps::IdentificationConfig config;
  steps::Step step;
  step.token = "s3_identification";
  step.summary = "Identifies modes with standard deviations from ambient records (covariance-driven subspace identification).";
  step.examples = {"s3_identification --campaign my_campaign --out results/my_bridge/s3_identification --set setup=ST1 --set decimation=8",
                   "s3_identification --study workflows/ponte_del_mare --results results/ponte_del_mare --out results/ponte_del_mare/s3_identification"};
  step.fields = config.fields();
  step.run = [&config](steps::StepContext& context) { return run(config, context); };
  return steps::run_step(argc, argv, std::move(step));
}
