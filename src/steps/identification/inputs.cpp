#include "steps/identification/inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/error.hpp"
#include "identification/stays.hpp"
#include "io/csv.hpp"
#include "model_io/modes_io.hpp"
#include "records/universal_modes.hpp"

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
    if (std::filesystem::exists(record.file)) context.record(record.file);
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
                                                   runner::StepContext& context, LeftOut& left_out) {
  std::vector<identification::Conditioned> records;
  for (const records::RecordGroup& group : records::record_groups(campaign, choice, true)) {
    left_out.attempt("setup " + group.setup, [&] {
      records.push_back(identification::condition_records(campaign, group, config));
      for (const std::string& note : records.back().notes) context.say(note);
      for (const std::string& warning : records.back().warnings) context.warn(warning);
    });
  }
  return records;
}

/// Kind of the records whose modes are those of the structure: as configured. A campaign without ambient records has its free
/// decays, or else its stays, to show.
std::string main_kind(const records::Campaign& campaign, const identification::IdentificationSettings& config) {
  const auto has = [&](const std::string& kind) {
    return std::any_of(campaign.records.begin(), campaign.records.end(),
                       [&](const records::CampaignRecord& record) { return record.kind == kind; });
  };
  const bool others = std::any_of(campaign.records.begin(), campaign.records.end(), [](const records::CampaignRecord& record) {
    return record.kind != "stay" && record.kind != "free_decay";
  });
  if (config.kind != "ambient" || others) return config.kind;
  return has("free_decay") ? "free_decay" : has("stay") ? "stay" : config.kind;
}

identification::IdentificationSettings decay_settings(const identification::IdentificationSettings& config) {
  identification::IdentificationSettings own = config;
  if (config.decay_decimation > 0) own.decimation = config.decay_decimation;
  own.block_rows = config.decay_block_rows;
  return own;
}

}  // namespace

std::vector<identification::ModeChoice> read_mode_choices(const std::string& file, runner::StepContext& context) {
  std::vector<identification::ModeChoice> choices;
  if (file.empty()) return choices;
  const auto table = io::CsvTable::read(context.input(context.resolved(file)),
                                        {"setup", "order", "frequency_Hz", "damping_ratio_pct", "action"}, {}, true);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string action = table.text(row, "action");
    if (action != "keep" && action != "delete")
      table.fail(row, "action", "is '" + action + "', expected keep or delete", "write one of them");
    identification::ModeChoice choice;
    choice.setup = table.text(row, "setup");
    choice.order = static_cast<int>(table.integer(row, "order"));
    choice.frequency_Hz = table.number(row, "frequency_Hz");
    choice.damping_ratio = 0.01 * table.number(row, "damping_ratio_pct");
    choice.keep = action == "keep";
    choice.file = table.file().string();
    choice.line = table.line(row);
    if (!(choice.frequency_Hz > 0.0))
      table.fail(row, "frequency_Hz", "is " + table.text(row, "frequency_Hz") + ", expected a frequency above 0",
                 "take it from poles.csv");
    choices.push_back(std::move(choice));
  }
  return choices;
}

IdentificationInputs read_identification_inputs(const identification::IdentificationSettings& config,
                                                runner::StepContext& context) {
  IdentificationInputs read;
  read.campaign = read_lists(context);
  LeftOut left_out;
  const std::string kind = main_kind(read.campaign, config);
  read.decays_are_main = kind == "free_decay";
  const records::RecordChoice chosen{config.setup, config.condition, kind, config.setups};
  const bool stays_alone = kind == "stay";
  if (stays_alone) {
    static_cast<void>(records::record_groups(read.campaign, {"", "", "stay", {}}));  // refuses where there is none
    context.say("stays alone are identified: stays.csv and stay_tensions.csv; modes.csv stays empty");
  } else {
    const std::vector<records::RecordGroup> groups = records::record_groups(read.campaign, chosen);
    if (read.decays_are_main) context.say("the modes are those of the free decays, by ERA");
    for (const std::vector<records::RecordGroup>& one : records::by_condition(groups)) {
      if (read.decays_are_main) break;
      left_out.attempt("condition " + one.front().condition,
                       [&] { read.conditions.push_back(identification::read_condition(read.campaign, one, config, context)); });
    }
  }
  const records::RecordChoice all_decays{"", config.condition, "free_decay", {}};
  read.decays = read_kind(read.campaign, read.decays_are_main ? chosen : all_decays, decay_settings(config), context, left_out);
  read.stays = read_kind(read.campaign, {"", "", "stay", {}}, identification::stay_settings(config), context, left_out);
  const bool nothing_left = stays_alone            ? read.stays.empty()
                            : read.decays_are_main ? read.decays.empty()
                                                   : read.conditions.empty();
  left_out.report(context, nothing_left);
  return read;
}

std::optional<runner::Computation> imported_modes(double std_pct, runner::StepContext& context) {
  if (!context.modes) return std::nullopt;
  if (std::filesystem::is_directory(*context.modes)) {
    throw InputError({context.modes->string(), 0, ""}, "is a folder, expected a universal file with modes",
                     "give the folder to the step that compares with it: s4_refinement --modes DIR");
  }
  records::UniversalModes read = records::read_universal_modes(context.record(*context.modes), std_pct);
  for (const std::string& note : read.notes) context.say(context.modes->string() + ": " + note);
  if (std_pct == 0.0) {
    context.warn(context.modes->string() +
                 ": has no standard deviations, and steps 4, 6 and 9 refuse modes without them; state what you assume, for "
                 "example --set imported_std_pct=0.5");
  }
  return [read = std::move(read), &context]() -> Status {
    model_io::write_modes(read.modes, context.out);
    records::write_channels(read.channels, context.out / "channels.csv");
    return {};
  };
}

}  // namespace twindeck::steps
