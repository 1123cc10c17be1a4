/// Step 3 (paper section 3.2, Table 4, Figs. 10-13): modes with standard deviations from records of one or several setups.
#include <filesystem>

#include "records/inspect.hpp"
#include "steps/identification/outputs.hpp"
#include "steps/shared/run_step.hpp"

namespace {

using namespace twindeck;

/// data/<study>/campaign where somebody has put records of their own, else what s0_campaign wrote.
std::filesystem::path default_campaign(const steps::StepContext& context) {
  const std::filesystem::path own = std::filesystem::path("data") / context.study.lexically_normal().filename() / "campaign";
  const bool is_there = !context.study.empty() && std::filesystem::exists(own / "campaign.toml");
  return is_there ? own : context.results / "s0_campaign";
}

Status run(const steps::IdentificationConfig& config, steps::StepContext& context) {
  // 1. The campaign: a user's own, or what s0_campaign wrote. Read are its lists and records, and nothing else that lies there.
  const auto folder = context.campaign ? *context.campaign : default_campaign(context);
  if (!std::filesystem::exists(folder)) context.input(folder);
  const steps::Campaign campaign = steps::read_campaign(folder);
  for (const std::string& warning : campaign.warnings) context.say(warning);
  for (const char* name : {"campaign.toml", "channels.csv", "conditions.toml"}) {
    if (std::filesystem::exists(folder / name)) context.input(folder / name);
  }
  for (const steps::CampaignRecord& record : campaign.records) {
    if (std::filesystem::exists(record.file)) context.input(record.file);
  }

  // 2. Each condition: records chosen, judged, repaired as asked, detrended and decimated; spectra; subspace identification,
  // stabilisation,
  //    selection (Eqs. 3-4), standard deviations; setups merged.
  std::vector<steps::ConditionResult> results;
  for (const auto& groups :
       steps::by_condition(steps::record_groups(campaign, {config.setup, config.condition, config.kind, config.setups}))) {
    results.push_back(steps::identify_condition(campaign, groups, config, context));
    for (const std::string& line : steps::report_lines(results.back())) context.say(line);
  }

  // 3. Free decays by ERA, with frequency and damping by amplitude; stays as strings.
  const auto decays = steps::identify_free_decays(
      campaign, steps::record_groups(campaign, {"", config.condition, "free_decay", {}}, true), config, results, context.seed);
  const auto stays = steps::identify_stays(campaign, steps::record_groups(campaign, {"", "", "stay", {}}, true), config);
  for (const auto& decay : decays) {
    for (const std::string& note : decay.notes) context.say(note);
  }
  for (const auto& stay : stays) {
    for (const std::string& note : stay.notes) context.say(note);
  }

  // 4. Tables, exports, and the features that updating and diagnosis read. The first condition's stand at the top.
  steps::write_identification(campaign, results, decays, stays, config, context.out);
  if (results.front().modes.empty()) {
    return {false, "no mode is stable over the model orders; see poles.csv, and raise block_rows or the record's length"};
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  steps::IdentificationConfig config;
  steps::Step step;
  step.token = "s3_identification";
  step.summary =
      "Identifies modes with standard deviations from vibration records: ambient, free decays, stays, measured inputs.";
  step.examples = {
      "s3_identification --campaign my_campaign --out results/my_bridge/s3_identification --set setup=ST1 --set decimation=8",
      "s3_identification --inspect measurement.csv",
      "s3_identification --study workflows/ponte_del_mare --results results/ponte_del_mare --out "
      "results/ponte_del_mare/s3_identification"};
  step.flags = {{"inspect", true, "tell what a record file holds (CSV, NPY, MAT, HDF5, universal file) and end",
                 [](const std::string& file) { return records::describe(records::inspect(file)); }}};
  step.fields = config.fields();
  step.configured_inputs = {"campaign"};
  step.run = [&config](steps::StepContext& context) { return run(config, context); };
  return steps::run_step(argc, argv, std::move(step));
}
