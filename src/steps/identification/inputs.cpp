#include "steps/identification/inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "identification/stays.hpp"

namespace twindeck::steps {

namespace {

/// data/<study>/campaign where somebody has put records of their own, else what s0_campaign wrote.
std::filesystem::path default_campaign(const runner::StepContext& context) {
  const std::filesystem::path own = std::filesystem::path("data") / context.study.lexically_normal().filename() / "campaign";
  const bool is_there = !context.study.empty() && std::filesystem::exists(own / "campaign.toml");
  if (is_there) return own;
  const std::filesystem::path simulated = context.results / "s0_campaign";
  if (!context.study.empty() && !std::filesystem::exists(simulated)) {
    throw InputError({own.string() + "/campaign.toml", 0, ""}, "does not exist, nor does " + simulated.string(),
                     "put your records there (docs/my_records.md), or run s0_campaign; whoever has modes and no records takes "
                     "s3_identification out of the steps in study.toml");
  }
  return simulated;
}

/// Registered are the lists and records, and nothing else that lies there.
records::Campaign read_lists(runner::StepContext& context) {
  const auto folder = context.campaign ? *context.campaign : default_campaign(context);
  if (!std::filesystem::exists(folder)) context.input(folder);
  records::Campaign campaign = records::read_campaign(folder);
  for (const std::string& warning : campaign.warnings) context.say(warning);
  for (const char* name : {"campaign.toml", "channels.csv", "conditions.toml"}) {
    if (std::filesystem::exists(folder / name)) context.input(folder / name);
  }
  for (const records::CampaignRecord& record : campaign.records) {
    if (std::filesystem::exists(record.file)) context.input(record.file);
  }
  return campaign;
}

/// Goes on without what cannot be used, and keeps why.
class LeftOut {
 public:
  template <typename Read>
  void attempt(const std::string& what, const Read& read) {
    try {
      read();
    } catch (const identification::UnusableRecord& problem) {
      if (!first_) first_ = problem;
      warnings_.push_back(what + " is left out: " + problem.what());
    }
  }
  /// Warns of each, or refuses with the first where nothing else is left to identify.
  void report(runner::StepContext& context, bool nothing_left) const {
    if (nothing_left && first_) throw *first_;
    for (const std::string& warning : warnings_) context.warn(warning);
  }

 private:
  std::optional<identification::UnusableRecord> first_;
  std::vector<std::string> warnings_;
};

std::vector<identification::Conditioned> read_kind(const records::Campaign& campaign, const records::RecordChoice& choice,
                                                   const identification::IdentificationSettings& config,
                                                   Eigen::Index decimation, runner::StepContext& context, LeftOut& left_out) {
  std::vector<identification::Conditioned> records;
  for (const records::RecordGroup& group : records::record_groups(campaign, choice, true)) {
    left_out.attempt("setup " + group.setup, [&] {
      records.push_back(identification::condition_records(campaign, group, config, decimation));
      for (const std::string& note : records.back().notes) context.say(note);
      for (const std::string& warning : records.back().warnings) context.warn(warning);
    });
  }
  return records;
}

/// The records whose modes are those of the structure. None where the configuration asks for stays alone, or the campaign has
/// nothing else than stays and free decays: then the stays are all there is to identify.
std::vector<records::RecordGroup> ambient_groups(const records::Campaign& campaign,
                                                 const identification::IdentificationSettings& config) {
  const auto is_stay = [](const records::CampaignRecord& record) { return record.kind == "stay"; };
  const auto is_beside = [&](const records::CampaignRecord& record) { return is_stay(record) || record.kind == "free_decay"; };
  const bool stays_alone = std::any_of(campaign.records.begin(), campaign.records.end(), is_stay) &&
                           std::all_of(campaign.records.begin(), campaign.records.end(), is_beside);
  if (config.kind == "stay" || (config.kind == "ambient" && stays_alone)) {
    static_cast<void>(records::record_groups(campaign, {"", "", "stay", {}}));  // refuses where there is none
    return {};
  }
  return records::record_groups(campaign, {config.setup, config.condition, config.kind, config.setups});
}

}  // namespace

IdentificationInputs read_identification_inputs(const identification::IdentificationSettings& config,
                                                runner::StepContext& context) {
  IdentificationInputs read;
  read.campaign = read_lists(context);
  LeftOut left_out;
  const std::vector<records::RecordGroup> ambient = ambient_groups(read.campaign, config);
  if (ambient.empty()) context.say("stays alone are identified: stays.csv and stay_tensions.csv; modes.csv stays empty");
  for (const std::vector<records::RecordGroup>& groups : records::by_condition(ambient)) {
    left_out.attempt("condition " + groups.front().condition, [&] {
      read.conditions.push_back(identification::read_condition(read.campaign, groups, config, context));
    });
  }
  read.decays = read_kind(read.campaign, {"", config.condition, "free_decay", {}}, config,
                          config.decay_decimation > 0 ? config.decay_decimation : config.decimation, context, left_out);
  read.stays = read_kind(read.campaign, {"", "", "stay", {}}, identification::stay_settings(config), config.stay_decimation,
                         context, left_out);
  left_out.report(context, ambient.empty() ? read.stays.empty() : read.conditions.empty());
  return read;
}

}  // namespace twindeck::steps
