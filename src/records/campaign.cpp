#include "records/campaign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/config.hpp"
#include "io/regular_file.hpp"
#include "io/toml_value.hpp"
#include "records/column_match.hpp"
#include "records/record.hpp"
#include "records/recorded_unit.hpp"
#include "records/scan_universal.hpp"
#include "records/take_clock.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();
const std::vector<std::string> kKinds = {"ambient", "free_decay", "wind", "earthquake", "stay", kFrfKind};

std::vector<std::string> condition_names(const fs::path& file) {
  if (!fs::exists(file)) return {};
  std::vector<std::string> names;
  for (const io::TomlEntry& entry : io::read_toml(file)) {
    if (entry.value.as<io::TomlValue::Table>() == nullptr)
      throw InputError({file.string(), entry.line, entry.key}, fmt::format("is {}, expected a table", io::shown(entry.value)),
                       "write [" + entry.key + "], and below it what is known of the condition");
    names.push_back(entry.key);
  }
  return names;
}

/// Lines of the [[record]] tables and of their keys, for messages.
struct RecordLines {
  long table = 0;
  std::map<std::string, long> keys;
};

std::vector<RecordLines> record_lines(const fs::path& file) {
  std::vector<RecordLines> lines;
  for (const io::TomlEntry& entry : io::read_toml(file)) {
    const auto* records = entry.value.as<io::TomlValue::Array>();
    if (entry.key != "record" || records == nullptr) continue;
    for (const io::TomlValue& record : *records) {
      lines.push_back({record.line, {}});
      const auto* keys = record.as<io::TomlValue::Table>();
      if (keys == nullptr) continue;
      for (const io::TomlEntry& key : *keys) lines.back().keys[key.key] = key.line;
    }
  }
  return lines;
}

/// Frequency response functions are told from the file, and are records of their own kind; all others need a rate.
void settle_kind(CampaignRecord& record, const fs::path& file) {
  const auto at = [&](const std::string& key) { return Place{file.string(), record.line_of(key), key}; };
  const bool is_stated = record.lines.contains("kind"), holds = holds_frequency_responses(record.file);
  if (holds && is_stated && record.kind != kFrfKind)
    throw InputError(at("kind"),
                     fmt::format("is \"{}\", but {} holds frequency response functions", record.kind, record.file.string()),
                     "write kind = \"frf\", or give the file with the time series");
  if (holds) record.kind = kFrfKind;
  if (record.kind != kFrfKind && record.sampling_rate_Hz <= 0.0)
    throw InputError({file.string(), record.line, "sampling_rate_Hz"},
                     "is missing, expected the samples a second of each channel",
                     "write it into this [[record]]; only frequency response functions have none");
}

/// Refuses frequency response functions beside time series in one setup: their modes cannot be one result.
void refuse_mixed_setup(const std::vector<CampaignRecord>& records, const CampaignRecord& record, const fs::path& file) {
  for (const CampaignRecord& other : records) {
    if (other.setup != record.setup || other.condition != record.condition) continue;
    if ((other.kind == kFrfKind) == (record.kind == kFrfKind)) continue;
    throw InputError({file.string(), record.line_of("setup"), "setup"},
                     fmt::format("{} holds {}, but the record on line {}, of the same setup and condition, holds {}",
                                 record.setup, record.kind == kFrfKind ? "frequency response functions" : "time series",
                                 other.line, other.kind == kFrfKind ? "frequency response functions" : "time series"),
                     "give each kind a setup of its own");
  }
}

void check_record(const Campaign& campaign, const CampaignRecord& record, const fs::path& file) {
  const auto known = each_of(campaign.channels, &CampaignChannel::name);
  const auto at = [&](const std::string& key) { return Place{file.string(), record.line_of(key), key}; };
  if (record.channels.empty()) throw InputError(at("channels"), "is empty", "list the columns of the record");
  std::set<std::string> seen;
  for (const std::string& name : record.channels) {
    if (!contains(known, name))
      throw InputError(at("channels"), fmt::format("channel '{}' is not in channels.csv{}", name, did_you_mean(name, known)),
                       "add it there, or correct the name");
    if (!seen.insert(name).second) throw InputError(at("channels"), fmt::format("names '{}' twice", name), "");
  }
  if (!record.columns.empty() && record.columns.size() != record.channels.size())
    throw InputError(at("columns"),
                     fmt::format("has {} entries for {} channels", record.columns.size(), record.channels.size()),
                     "give each entry of `channels` its column in the file");
  if (const auto& conditions = campaign.conditions; !conditions.empty() && !contains(conditions, record.condition))
    throw InputError(
        at("condition"),
        fmt::format("'{}' is no table of conditions.toml{}", record.condition, did_you_mean(record.condition, conditions)),
        "add a table [" + record.condition + "] there");
}

/// The rate according to the time stamps. If their unit is not known, it is chosen to come nearest to the stated rate.
double rate_beside(const RecordInfo& info, double stated_Hz) {
  double nearest = info.rate_Hz;
  if (info.clock_unit_known || info.rate_Hz != info.clock.rate_Hz) return nearest;
  for (const double factor : {1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9}) {
    const double rate = info.rate_Hz * factor;
    if (std::abs(std::log(rate / stated_Hz)) < std::abs(std::log(nearest / stated_Hz))) nearest = rate;
  }
  return nearest;
}

/// Refuses an unusable clock, and a rate other than the stated one.
/// @return "", or a note on a difference of rates that is small enough
std::string check_rate(const Campaign& campaign, const CampaignRecord& record, const RecordInfo& info) {
  const RecordClock& clock = info.clock;
  const Place place{record.file.string(), line_of(info, std::max(clock.steps_back, clock.changes_rate)), ""};
  if (clock.reversed)
    throw InputError({record.file.string(), 0, ""}, "the time runs backwards throughout",
                     "turn the order of its rows round, so that the first sample comes first");
  if (clock.steps_back >= 0)
    throw InputError(place, "the time runs backwards at " + place_of(info, clock.steps_back),
                     "split the record there, or put its rows in the order of their time");
  if (clock.changes_rate >= 0)
    throw InputError(
        place, fmt::format("the time stamps run at different rates, at another from {} on", place_of(info, clock.changes_rate)),
        "give each rate its own record");
  for (const std::string& note : info.notes)
    for (const char* of_channels : {"different rates", "different starts", "sensors in turn"})
      if (note.find(of_channels) != std::string::npos)
        throw InputError({record.file.string(), 0, ""}, note, "give the channels of each a file and a [[record]] of their own");
  if (info.rate_Hz <= 0.0) return "";
  const double stated = record.sampling_rate_Hz, rate = rate_beside(info, stated);
  const double share = info.rate_Hz == clock.rate_Hz ? clock.deviation_Hz / info.rate_Hz : 0.0,
               off = std::abs(stated / rate - 1.0);
  const std::string said =
      fmt::format("{:.9g} Hz{} ({})", rate,
                  share > 0.0 ? fmt::format(" with a standard deviation of {:.2g} Hz", share * rate) : "", info.rate_source);
  if (off > std::max(kSameRate, kDeviationsOfARate * share))
    throw InputError({(campaign.folder / "campaign.toml").string(), record.line_of("sampling_rate_Hz"), "sampling_rate_Hz"},
                     fmt::format("is {}, but {} runs at {}", stated, record.file.string(), said),
                     fmt::format("write sampling_rate_Hz = {:.9g}, or correct the times in the file", rate));
  if (off <= std::max(kDeviationsOfARate * share, 1e-6)) return "";
  return fmt::format("{}: runs at {}; sampling_rate_Hz = {}, which differs by {:.2g} %, is used", record.file.string(), said,
                     stated, 100.0 * off);
}

/// Notes about the file, for people, and the warning about its channel names.
std::vector<std::string> notes_of(const CampaignRecord& record, const RecordInfo& info, const ColumnMatch& match) {
  auto notes = each_of(info.notes, [&](const std::string& note) { return record.file.string() + ": " + note; });
  if (!match.warning.empty()) notes.push_back(match.warning);
  return notes;
}

/// The options again with the rows of the asked channels alone, if other channels of the file stand on rows of their own.
/// @throws InputError  if the asked channels stand on different rows
std::optional<ReadOptions> with_own_rows(ReadOptions options, const CampaignRecord& record, const RecordInfo& info) {
  if (!info.apart) return {};
  options.rows_of = match_columns(info, record.channels, record.columns, record.file).columns;
  const auto group = [&](std::size_t c) { return info.channels[static_cast<std::size_t>(options.rows_of[c])].row_group; };
  for (std::size_t c = 1; c < options.rows_of.size(); ++c) {
    if (group(c) < 0 || group(0) < 0 || group(c) == group(0)) continue;
    throw InputError({record.file.string(), 0, record.channels[c]},
                     fmt::format("has values in no row in which {} has: they stand on rows of their own", record.channels[0]),
                     "write the rows of each clock into a file and a [[record]] with a setup of their own");
  }
  return options;
}

/// Refuses the same samples of the same channels in two records of a kind: they would count as two measurements.
void refuse_twice(const std::vector<CampaignRecord>& records, const CampaignRecord& record, const fs::path& file) {
  for (const CampaignRecord& other : records) {
    std::error_code gone;
    const bool same =
        other.kind == record.kind && other.channels == record.channels && other.columns == record.columns &&
        (other.file.lexically_normal() == record.file.lexically_normal() || fs::equivalent(other.file, record.file, gone));
    if (!same) continue;
    throw InputError({file.string(), record.line_of("file"), "file"},
                     fmt::format("lists {} again, which the record on line {} has too: counted twice, deviations are too small",
                                 record.file.lexically_relative(file.parent_path()).string(), other.line),
                     "remove one of the two [[record]] tables");
  }
}

/// Larger values are no motion or force in any unit, and their squares overflow. If no value of a channel exceeds the second
/// number, its squares vanish.
constexpr double kLargestValue = 1e100, kSmallestPeak = 1e-100;

void refuse_absurd(const RecordSamples& samples, const CampaignRecord& record) {
  for (Index c = 0; c < samples.values.cols(); ++c) {
    double peak = 0.0;
    for (Index t = 0; t < samples.values.rows(); ++t) {
      const double value = std::abs(samples.values(t, c));
      peak = std::fmax(peak, value);
      if (!(value > kLargestValue) || std::isnan(value)) continue;
      throw InputError({record.file.string(), 0, record.channels[static_cast<std::size_t>(c)]},
                       fmt::format("holds {:.6g} in sample {}, which no sensor gives", samples.values(t, c), t + 1),
                       "check the file and its type of numbers");
    }
    if (peak > 0.0 && peak < kSmallestPeak)
      throw InputError({record.file.string(), 0, record.channels[static_cast<std::size_t>(c)]},
                       fmt::format("holds nothing above {:.6g}, which no sensor gives", peak),
                       "check the file, its type of numbers and the channel's gain");
  }
}

/// Refuses a channel that lies at both ends of its range and never in the middle quarter: numbers with a sign that were written
/// without it (two's complement) jump from one end to the other where the motion passes 0.
void refuse_without_sign(const RecordSamples& samples, const CampaignRecord& record, const Campaign& campaign) {
  constexpr int often = 20;           // least number of jumps: an offset jumps once
  constexpr std::size_t levels = 16;  // least number of values at either end: a sensor of few bits toggles between two
  for (Index c = 0; c < samples.values.cols(); ++c) {
    if (campaign.channel(record.channels[static_cast<std::size_t>(c)]).is_input) continue;  // a shaker may be switched
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double value : samples.values.col(c)) low = std::fmin(low, value), high = std::fmax(high, value);
    const double apart = 3.0 / 8.0 * (high - low);  // of the middle quarter from either end
    int jumps = 0;
    bool was_at_top = false;
    std::set<double> lowest, highest;
    for (const double value : samples.values.col(c)) {
      if (std::isnan(value)) continue;
      if (value > low + apart && value < high - apart) {
        jumps = 0;
        break;
      }
      const bool at_top = value >= high - apart;
      jumps += at_top != was_at_top ? 1 : 0;
      was_at_top = at_top;
      if (auto& some = at_top ? highest : lowest; some.size() < levels) some.insert(value);
    }
    if (jumps < often || std::min(lowest.size(), highest.size()) < levels) continue;
    throw InputError(
        {record.file.string(), 0, record.channels[static_cast<std::size_t>(c)]},
        fmt::format("lies at both ends of its range from {:.6g} to {:.6g} and never in between: numbers with a sign "
                    "were written without it",
                    low, high),
        "export them with their sign, or subtract the full range (65536 of 16 bits) from those at the upper end");
  }
}

/// A table [[record]] as it stands.
struct ListedRecord {
  CampaignRecord record;
  std::string file;
};

io::FieldTable record_fields(ListedRecord& r) {
  r.record.condition = "as_measured";
  r.record.kind = "ambient";
  io::FieldTable table;
  table.path_name("setup", r.record.setup, "setup", "name of the setup", true)
      .choice("kind", r.record.kind, kKinds, "what was recorded")
      .text("file", r.file,
            "samples: CSV as loggers write it, NPY, MAT 4, 5 or 7.3, HDF5, universal file; relative to campaign.toml", true)
      .number("sampling_rate_Hz", r.record.sampling_rate_Hz, "Hz", {io::lowest_rate_Hz, kNoLimit},
              "samples a second of each channel; required but for frequency response functions")
      .texts("channels", r.record.channels,
             "what is recorded, names of channels.csv; the columns' order where the file has no names")
      .texts("columns", r.record.columns,
             "what the file calls each of `channels` (\"column 3\": the third); empty: it calls them so itself")
      .boolean("skip_stray_lines", r.record.skip_stray_lines,
               "leave out and count lines of a text file that are no rows of its table, instead of refusing them")
      .choice("unit_from", r.record.unit_from, {"", "channels.csv", "file"},
              "which is right where the file and channels.csv give a channel different units; empty: such a record is refused")
      .path_name("condition", r.record.condition, "condition", "table of conditions.toml");
  return table;
}

}  // namespace

long CampaignRecord::line_of(const std::string& key) const {
  const auto at = lines.find(key);
  return at == lines.end() ? line : at->second;
}

const CampaignChannel& Campaign::channel(const std::string& name) const {
  const auto at = std::ranges::find(channels, name, &CampaignChannel::name);
  TWINDECK_ASSERT(at != channels.end());
  return *at;
}

double gain_of(const Campaign& campaign, const CampaignRecord& record, std::size_t c, const std::string& unit,
               std::vector<std::string>& notes) {
  const CampaignChannel& channel = campaign.channel(record.channels[c]);
  const auto known = recorded_unit(unit);
  if (!known || known->si_factor <= 0.0) return channel.gain;
  constexpr double other_unit = 2.0;  // units of one quantity differ by a factor of 9.8 or more, a calibration by less than 2
  const double stated = known->si_factor, used = std::abs(channel.gain);
  const bool other_quantity = known->quantity != channel.quantity;
  if (!other_quantity && used <= other_unit * stated && used >= stated / other_unit) return channel.gain;
  const std::string says =
      fmt::format("says that {} is in {}, but channels.csv has the quantity {}, the unit {} and the gain {:.6g}", channel.name,
                  unit, channel.quantity, channel.unit, channel.gain);
  if (record.unit_from.empty() || (other_quantity && record.unit_from == "file"))
    throw InputError({record.file.string(), 0, channel.name}, says,
                     "correct the one that is wrong, or say that channels.csv is right: unit_from = \"channels.csv\" in its "
                     "[[record]] of campaign.toml (unit_from = \"file\" takes the file's unit)");
  notes.push_back(fmt::format("{}: {}; {} is taken, as unit_from says", record.file.string(), says, record.unit_from));
  if (record.unit_from == "channels.csv") return channel.gain;
  const double own = si_factor(channel.unit);
  return stated * (own > 0.0 ? channel.gain / own : channel.gain < 0.0 ? -1.0 : 1.0);
}

Campaign read_campaign(const fs::path& folder) {
  Campaign campaign;
  campaign.folder = folder;
  const fs::path file = folder / "campaign.toml";
  if (!fs::exists(file))
    throw InputError({file.string(), 0, ""}, "is not there, expected one table [[record]] for each record",
                     "write it as docs/my_records.md says");
  campaign.channels = read_campaign_channels(folder / "channels.csv", campaign.warnings);
  campaign.conditions = condition_names(folder / "conditions.toml");
  const std::vector<RecordLines> lines = record_lines(file);

  std::deque<ListedRecord> raw;  // the fields bound to an element stay where they are
  io::FieldTable fields;
  fields.tables(
      "record", [&raw] { return record_fields(raw.emplace_back()); }, "a record");
  fields.load(file);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    CampaignRecord record = raw[i].record;
    record.file = folder / raw[i].file;
    if (i < lines.size()) {
      record.line = lines[i].table;
      record.lines = lines[i].keys;
    }
    settle_kind(record, file);
    check_record(campaign, record, file);
    refuse_mixed_setup(campaign.records, record, file);
    refuse_twice(campaign.records, record, file);
    campaign.records.push_back(record);
  }
  if (campaign.records.empty()) throw InputError({file.string(), 0, "record"}, "lists no record", "add a table [[record]]");
  return campaign;
}

std::vector<RecordGroup> record_groups(const Campaign& campaign, const RecordChoice& choice, bool or_none) {
  std::vector<RecordGroup> groups;
  std::set<std::string> there;
  for (const CampaignRecord& record : campaign.records) {
    there.insert(fmt::format("{}/{}/{}", record.setup, record.condition, record.kind));
    const bool fits = (choice.setup.empty() || record.setup == choice.setup) &&
                      (choice.condition.empty() || record.condition == choice.condition) &&
                      (choice.kind.empty() || record.kind == choice.kind) &&
                      (choice.setups.empty() || contains(choice.setups, record.setup));
    if (!fits) continue;
    auto group = std::ranges::find_if(
        groups, [&](const RecordGroup& g) { return g.setup == record.setup && g.condition == record.condition; });
    if (group == groups.end()) group = groups.insert(groups.end(), {record.setup, record.condition, {}});
    if (!group->records.empty()) {
      const CampaignRecord& first = group->records.front();
      const bool differs = record.sampling_rate_Hz != first.sampling_rate_Hz || record.channels != first.channels;
      if (differs && record.kind != kFrfKind)
        throw InputError(
            {(campaign.folder / "campaign.toml").string(), record.line, "record"},
            fmt::format("differs in rate or channels from the record on line {} of the same setup and condition", first.line),
            "give it a setup of its own");
    }
    group->records.push_back(record);
  }
  if (groups.empty() && !or_none)
    throw InputError({(campaign.folder / "campaign.toml").string(), 0, "record"},
                     fmt::format("no record has setup '{}', condition '{}', kind '{}'; there are {}", choice.setup,
                                 choice.condition, choice.kind, fmt::join(there, ", ")),
                     "choose by --set setup=…, condition=…, kind=…");
  // Conditions stay together, in the order in which they first appear.
  std::vector<std::string> order;
  for (const RecordGroup& group : groups)
    if (!contains(order, group.condition)) order.push_back(group.condition);
  std::ranges::stable_sort(groups, [&](const RecordGroup& a, const RecordGroup& b) {
    return std::ranges::find(order, a.condition) < std::ranges::find(order, b.condition);
  });
  return groups;
}

std::vector<std::vector<RecordGroup>> by_condition(const std::vector<RecordGroup>& groups) {
  std::vector<std::vector<RecordGroup>> conditions;
  for (const RecordGroup& group : groups) {
    if (conditions.empty() || conditions.back().front().condition != group.condition) conditions.emplace_back();
    conditions.back().push_back(group);
  }
  return conditions;
}

RecordSamples read_record(const Campaign& campaign, const CampaignRecord& record) {
  ReadOptions options{record.skip_stray_lines};
  constexpr std::uintmax_t large = std::uintmax_t{64} << 20U;  // bytes
  RecordSamples samples;
  std::vector<double> gains;
  const auto match = [&](const RecordInfo& info) {
    const std::string rate = check_rate(campaign, record, info);
    const ColumnMatch found = records::match_columns(info, record.channels, record.columns, record.file);
    samples.notes = notes_of(record, info, found);
    for (std::size_t c = 0; c < found.columns.size(); ++c) {
      const std::string& unit = info.channels[static_cast<std::size_t>(found.columns[c])].unit;
      gains.push_back(gain_of(campaign, record, c, unit, samples.notes));
    }
    if (!rate.empty()) samples.notes.push_back(rate);
    return found.columns;
  };
  // The names of the columns are known only at the end of the file. A large file is read twice, so that columns that nobody
  // asked for are never in memory.
  if (io::require_regular_file(record.file) > large) {
    Index rows = 0;
    const auto scanned = [&] {
      rows = 0;
      return records::scan(
          record.file, [&](Index row, Index, const Eigen::MatrixXd& block) { rows = std::max(rows, row + block.rows()); },
          options);
    };
    RecordInfo info = scanned();
    if (const auto own = with_own_rows(options, record, info)) {
      options = *own;
      info = scanned();
    }
    const auto columns = match(info);
    samples.values = records::read(record.file, columns, rows, options);
  } else {
    Record file = records::read(record.file, options);
    if (const auto own = with_own_rows(options, record, file.info)) file = records::read(record.file, *own);
    samples.values = file.samples(Eigen::all, match(file.info));
  }
  refuse_absurd(samples, record);
  refuse_without_sign(samples, record, campaign);
  for (Index c = 0; c < samples.values.cols(); ++c) samples.values.col(c) *= gains[static_cast<std::size_t>(c)];
  return samples;
}

}  // namespace twindeck::records
