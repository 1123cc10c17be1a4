#include "steps/model/channels_on_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "matching/shapes_at_sensors.hpp"
#include "records/campaign_channels.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;

namespace {

constexpr double kSensorTolerance_m = 0.5;    ///< from a sensor to its node: the default of step 4
constexpr std::size_t kMostChannelsTold = 3;  ///< a wrong unit of length moves all of them

/// What step 4 would say of a channel; "" where it would take it.
std::string refusal_of(const records::CampaignChannel& channel, const dynamics::ReadModel& model, const fs::path& file) {
  matching::Measured measured;
  matching::Channel& at = measured.channels.emplace_back();
  at.name = channel.name;
  at.point = channel.point;
  if (channel.position_m.allFinite()) at.x_m = channel.position_m;
  if (channel.direction.allFinite()) at.direction = channel.direction;
  measured.modes.dofs.push_back({at.point, at.name});
  measured.source = file.string();
  try {
    matching::refuse_unplaced_channels(measured, model, kSensorTolerance_m);
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "";
}

}  // namespace

void warn_of_channels_off_the_model(runner::StepContext& context, const dynamics::ReadModel& model) {
  const fs::path file = fs::path("data") / context.study.lexically_normal().filename() / "campaign/channels.csv";
  if (context.study.empty() || context.model || !fs::exists(file)) return;
  context.input(file);
  std::vector<records::CampaignChannel> channels;
  try {
    std::vector<std::string> ignored;
    channels = records::read_campaign_channels(file, ignored);
  } catch (const InputError&) {
    return;  // step 3 says what is wrong with the table
  }
  std::vector<std::string> refusals;
  for (const records::CampaignChannel& channel : channels)
    if (!channel.is_input)
      if (std::string refusal = refusal_of(channel, model, file); !refusal.empty()) refusals.push_back(std::move(refusal));
  const std::size_t told = std::min(refusals.size(), kMostChannelsTold);
  for (std::size_t i = 0; i < told; ++i) context.warn(refusals[i]);
  if (refusals.size() > told) context.warn(fmt::format("{} more channels lie on no node either", refusals.size() - told));
}

}  // namespace twindeck::steps
