#include "steps/validation/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "buffeting/bridge_in_wind.hpp"
#include "core/error.hpp"
#include "records/campaign.hpp"
#include "records/vertical_channel.hpp"
#include "signal/condition.hpp"

namespace twindeck::steps {
namespace {

/// Channels that are the vertical acceleration at the monitoring point of their name. Warns of those that are not.
std::set<std::string> vertical_channels(runner::StepContext& context, const records::Campaign& campaign, const fe::Model& model,
                                        double tolerance_m) {
  const std::vector<std::string> points = buffeting::accelerometers(model);
  std::set<std::string> vertical;
  for (const records::CampaignChannel& channel : campaign.channels) {
    if (std::find(points.begin(), points.end(), channel.name) == points.end()) continue;
    const Eigen::Vector3d& x_m = model.nodes[static_cast<std::size_t>(model.monitoring_points.at(channel.name))].x_m;
    const std::string other = records::other_than_vertical_acceleration(channel, x_m, tolerance_m);
    if (other.empty())
      vertical.insert(channel.name);
    else
      context.warn(fmt::format("channel {} is not the vertical acceleration at the point {}: {}; it is left out", channel.name,
                               channel.name, other));
  }
  return vertical;
}

/// Mean squares of the channels of one event.
class MeanSquares {
 public:
  void add(const std::string& channel, const Eigen::Ref<const Eigen::VectorXd>& values) {
    Sum& sum = sums_[channel];
    sum.square += values.squaredNorm();
    sum.samples += static_cast<double>(values.size());
  }
  void write(const std::string& event, buffeting::MeasuredRms& out) const {
    for (const auto& [channel, sum] : sums_) out[{event, channel}] = std::sqrt(sum.square / sum.samples);
  }

 private:
  struct Sum {
    double square = 0.0, samples = 0.0;
  };
  std::map<std::string, Sum> sums_;
};

/// The campaign's folder; empty where there is none to read.
std::optional<std::filesystem::path> folder_of(const runner::StepContext& context) {
  const std::filesystem::path folder = context.campaign.value_or(context.results / "s0_campaign");
  if (std::filesystem::exists(folder)) return folder;
  if (context.campaign)
    throw InputError({folder.string(), 0, ""}, "is not there, expected a campaign's folder",
                     "give --campaign the folder that holds campaign.toml");
  context.say("no campaign: the simulations stand alone, without a measured side");
  return std::nullopt;
}

}  // namespace

buffeting::MeasuredRms measured_rms(runner::StepContext& context, const ValidationConfig& config, const fe::Model& model) {
  buffeting::MeasuredRms out;
  const bool wanted = std::any_of(config.events.begin(), config.events.end(),
                                  [](const buffeting::WindEvent& e) { return !e.condition.empty(); });
  if (!wanted) return out;
  const std::optional<std::filesystem::path> folder = folder_of(context);
  if (!folder) return out;
  context.input(*folder / "campaign.toml");
  context.input(*folder / "channels.csv");
  const records::Campaign campaign = records::read_campaign(*folder);
  for (const std::string& warning : campaign.warnings) context.say(warning);
  const std::set<std::string> vertical = vertical_channels(context, campaign, model, config.sensor_tolerance_m);
  for (const buffeting::WindEvent& event : config.events) {
    if (event.condition.empty()) continue;
    records::RecordChoice choice;
    choice.condition = event.condition;
    choice.kind = "wind";
    MeanSquares squares;
    for (const records::RecordGroup& group : records::record_groups(campaign, choice)) {
      for (const records::CampaignRecord& record : group.records) {
        context.record(record.file);
        const records::RecordSamples recorded = records::read_record(campaign, record);
        for (const std::string& note : recorded.notes) context.say(note);
        const Eigen::MatrixXd data = signal::detrended(recorded.values);
        if (!data.allFinite())
          throw InputError({record.file.string(), 0, ""}, "has gaps, which an RMS cannot have", "take a record without gaps");
        for (std::size_t c = 0; c < record.channels.size(); ++c) {
          if (vertical.contains(record.channels[c])) squares.add(record.channels[c], data.col(static_cast<Eigen::Index>(c)));
        }
      }
    }
    squares.write(event.name, out);
  }
  return out;
}

}  // namespace twindeck::steps
