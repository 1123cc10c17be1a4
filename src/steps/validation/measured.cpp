#include "steps/validation/measured.hpp"

#include <algorithm>
#include <filesystem>

#include "buffeting/response.hpp"
#include "core/error.hpp"
#include "records/campaign.hpp"
#include "signal/condition.hpp"

namespace twindeck::steps {

MeasuredRms measured_rms(runner::StepContext& context, const ValidationConfig& config) {
  MeasuredRms out;
  const bool wanted = std::any_of(config.events.begin(), config.events.end(),
                                  [](const buffeting::WindEvent& e) { return !e.condition.empty(); });
  const std::filesystem::path folder = context.campaign.value_or(context.results / "s0_campaign");
  if (!wanted) return out;
  if (!std::filesystem::exists(folder)) {
    if (context.campaign)
      throw InputError({folder.string(), 0, ""}, "is not there, expected a campaign's folder",
                       "give --campaign the folder that holds campaign.toml");
    context.say("no campaign: the simulations stand alone, without a measured side");
    return out;
  }
  context.input(folder / "campaign.toml");
  context.input(folder / "channels.csv");
  const records::Campaign campaign = records::read_campaign(folder);
  for (const std::string& warning : campaign.warnings) context.say(warning);
  for (const buffeting::WindEvent& event : config.events) {
    if (event.condition.empty()) continue;
    records::RecordChoice choice;
    choice.condition = event.condition;
    choice.kind = "wind";
    double samples = 0.0;
    std::map<std::string, double> sum;
    for (const records::RecordGroup& group : records::record_groups(campaign, choice)) {
      for (const records::CampaignRecord& record : group.records) {
        context.input(record.file);
        const records::RecordSamples recorded = records::read_record(campaign, record);
        for (const std::string& note : recorded.notes) context.say(note);
        const Eigen::MatrixXd data = signal::detrended(recorded.values);
        if (!data.allFinite())
          throw InputError({record.file.string(), 0, ""}, "has gaps, which an RMS cannot have", "take a record without gaps");
        samples += static_cast<double>(data.rows());
        for (std::size_t c = 0; c < record.channels.size(); ++c)
          sum[record.channels[c]] += data.col(static_cast<Eigen::Index>(c)).squaredNorm();
      }
    }
    for (const auto& [channel, square] : sum) out[{event.name, channel}] = std::sqrt(square / samples);
  }
  return out;
}

}  // namespace twindeck::steps
