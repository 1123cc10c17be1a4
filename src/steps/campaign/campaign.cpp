#include "steps/campaign/campaign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "io/config.hpp"
#include "io/csv.hpp"
#include "records/record.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

const std::vector<std::string> kKinds = {"ambient", "free_decay", "wind", "earthquake", "stay"};
const std::vector<std::string> kQuantities = {"acceleration", "velocity", "displacement"};

std::string one_of(const io::CsvTable& table, std::size_t row, const std::string& column,
                   const std::vector<std::string>& allowed) {
  const std::string text = table.text(row, column).empty() ? allowed.front() : table.text(row, column);
  if (std::find(allowed.begin(), allowed.end(), text) == allowed.end()) {
    table.fail(row, column, fmt::format("is '{}', expected {}{}", text, fmt::join(allowed, ", "), did_you_mean(text, allowed)));
  }
  return text;
}

std::vector<CampaignChannel> read_channels(const fs::path& file) {
  const auto table = io::CsvTable::read(
      file, {"channel"}, {"point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role"});
  std::vector<CampaignChannel> channels;
  std::set<std::string> names;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    CampaignChannel channel;
    channel.name = table.text(row, "channel");
    if (channel.name.empty()) table.fail(row, "channel", "is empty", "name the channel");
    if (!names.insert(channel.name).second)
      table.fail(row, "channel", fmt::format("'{}' appears twice", channel.name), "remove one row");
    channel.point = table.text(row, "point").empty() ? channel.name : table.text(row, "point");
    for (Index k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      channel.position_m[k] = table.number_or(row, std::array{"x_m", "y_m", "z_m"}[axis], channel.position_m[k]);
      channel.direction[k] = table.number_or(row, std::array{"dx", "dy", "dz"}[axis], channel.direction[k]);
    }
    channel.quantity = one_of(table, row, "quantity", kQuantities);
    channel.gain = table.number_or(row, "gain", 1.0);
    if (channel.gain == 0.0)
      table.fail(row, "gain", "is 0, expected the factor from recorded to physical values", "leave it empty for 1");
    channel.reference = table.number_or(row, "reference", 0.0) != 0.0;
    channel.is_input = one_of(table, row, "role", {"response", "input"}) == "input";
    channels.push_back(channel);
  }
  return channels;
}

std::vector<std::string> condition_names(const fs::path& file) {
  if (!fs::exists(file)) return {};
  try {
    std::vector<std::string> names;
    for (const auto& [name, node] : toml::parse_file(file.string())) names.emplace_back(name.str());
    return names;
  } catch (const toml::parse_error& error) {
    throw InputError({file.string(), static_cast<long>(error.source().begin.line), ""}, std::string(error.description()),
                     "mend the TOML");
  }
}

/// Lines of the [[record]] tables, for messages.
std::vector<long> record_lines(const fs::path& file) {
  std::vector<long> lines;
  try {
    const toml::table root = toml::parse_file(file.string());
    if (const toml::array* records = root["record"].as_array()) {
      for (const toml::node& node : *records) lines.push_back(static_cast<long>(node.source().begin.line));
    }
  } catch (const toml::parse_error& error) {
    throw InputError({file.string(), static_cast<long>(error.source().begin.line), ""}, std::string(error.description()),
                     "mend the TOML");
  }
  return lines;
}

void check_record(const Campaign& campaign, const CampaignRecord& record, const fs::path& file) {
  std::vector<std::string> known;
  for (const CampaignChannel& channel : campaign.channels) known.push_back(channel.name);
  if (record.channels.empty())
    throw InputError({file.string(), record.line, "channels"}, "is empty", "list the columns of the record");
  std::set<std::string> seen;
  for (const std::string& name : record.channels) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError({file.string(), record.line, "channels"},
                       fmt::format("channel '{}' is not in channels.csv{}", name, did_you_mean(name, known)),
                       "add it there, or correct the name");
    }
    if (!seen.insert(name).second)
      throw InputError({file.string(), record.line, "channels"}, fmt::format("names '{}' twice", name), "");
  }
  const auto& conditions = campaign.conditions;
  if (!conditions.empty() && std::find(conditions.begin(), conditions.end(), record.condition) == conditions.end()) {
    throw InputError(
        {file.string(), record.line, "condition"},
        fmt::format("'{}' is no table of conditions.toml{}", record.condition, did_you_mean(record.condition, conditions)),
        "add a table [" + record.condition + "] there");
  }
}

void check_rate(const Campaign& campaign, const CampaignRecord& record, const records::RecordInfo& info);

/// Columns of the record's channels: by name where the file names its channels so, by position where it names none of them.
std::vector<Index> columns_in_file(const CampaignRecord& record, const records::RecordInfo& info) {
  std::vector<Index> columns;
  std::vector<std::string> known;
  for (const records::ChannelInfo& channel : info.channels) known.push_back(channel.name);
  std::string missing;
  for (const std::string& name : record.channels) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at != known.end()) {
      columns.push_back(static_cast<Index>(at - known.begin()));
    } else if (missing.empty()) {
      missing = name;
    }
  }
  if (!columns.empty() && !missing.empty()) {
    throw InputError({record.file.string(), 0, missing},
                     fmt::format("is no channel of the file{}", did_you_mean(missing, known)),
                     "correct `channels` in campaign.toml; the file has " + fmt::format("{}", fmt::join(known, ", ")));
  }
  if (!columns.empty()) return columns;
  if (known.size() != record.channels.size()) {
    throw InputError({record.file.string(), 0, ""},
                     fmt::format("has {} columns, but campaign.toml names {} channels", known.size(), record.channels.size()),
                     "an array of samples x channels is expected");
  }
  for (Index c = 0; c < std::ssize(known); ++c) columns.push_back(c);
  return columns;
}

/// The record's channels and no others. What the file's columns are called is known at its end only: a large file is walked
/// through twice, so that columns that nobody asked for never lie in memory.
Eigen::MatrixXd in_order(const Campaign& campaign, const CampaignRecord& record) {
  constexpr std::uintmax_t kLarge = std::uintmax_t{64} << 20U;
  if (fs::exists(record.file) && fs::file_size(record.file) > kLarge) {
    const records::RecordInfo info = records::scan(record.file, [](Index, Index, const Eigen::MatrixXd&) {});
    check_rate(campaign, record, info);
    return records::read(record.file, columns_in_file(record, info)).samples;
  }
  records::Record file = records::read(record.file);
  check_rate(campaign, record, file.info);
  const std::vector<Index> columns = columns_in_file(record, file.info);
  return file.samples(Eigen::all, columns);
}

void check_rate(const Campaign& campaign, const CampaignRecord& record, const records::RecordInfo& info) {
  if (info.rate_Hz > 0.0 && std::abs(info.rate_Hz / record.sampling_rate_Hz - 1.0) > 1e-3) {
    throw InputError({(campaign.folder / "campaign.toml").string(), record.line, "sampling_rate_Hz"},
                     fmt::format("is {}, but {} runs at {:.6g} Hz ({})", record.sampling_rate_Hz, record.file.string(),
                                 info.rate_Hz, info.rate_source),
                     "correct one of them; two clocks or a mixed rate show so");
  }
  for (const std::string& note : info.notes) {
    if (note.find("backwards") != std::string::npos || note.find("different rates") != std::string::npos) {
      throw InputError({record.file.string(), 0, ""}, note,
                       "split the record where its clock jumps, or give each rate its own record");
    }
  }
}

}  // namespace

const CampaignChannel& Campaign::channel(const std::string& name) const {
  const auto at = std::find_if(channels.begin(), channels.end(), [&](const CampaignChannel& c) { return c.name == name; });
  TWINDECK_ASSERT(at != channels.end());
  return *at;
}

Campaign read_campaign(const fs::path& folder) {
  Campaign campaign;
  campaign.folder = folder;
  const fs::path file = folder / "campaign.toml";
  if (!fs::exists(file)) {
    throw InputError({file.string(), 0, ""}, "is not there, expected one table [[record]] for each record",
                     "write it as docs/my_records.md says");
  }
  campaign.channels = read_channels(folder / "channels.csv");
  campaign.conditions = condition_names(folder / "conditions.toml");
  const std::vector<long> lines = record_lines(file);

  // The list is reserved, so that the fields bound to an element stay where they are.
  struct Raw {
    CampaignRecord record;
    std::string file;
  };
  std::vector<Raw> raw;
  raw.reserve(lines.size() + 1);
  io::FieldTable fields;
  fields.tables(
      "record",
      [&raw] {
        raw.push_back({});
        Raw& r = raw.back();
        r.record.condition = "as_measured";
        r.record.kind = "ambient";
        io::FieldTable table;
        table.path_name("setup", r.record.setup, "setup", "name of the setup", true)
            .choice("kind", r.record.kind, kKinds, "what was recorded")
            .text("file", r.file,
                  "samples: CSV as loggers write it, NPY, MAT 5 or 7.3, HDF5, universal file; relative to campaign.toml", true)
            .number("sampling_rate_Hz", r.record.sampling_rate_Hz, "Hz", io::positive(), "samples a second of each channel",
                    true)
            .texts("channels", r.record.channels, "columns, names of channels.csv")
            .path_name("condition", r.record.condition, "condition", "table of conditions.toml");
        return table;
      },
      "a record");
  fields.load(file);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    CampaignRecord record = raw[i].record;
    record.file = folder / raw[i].file;
    record.line = i < lines.size() ? lines[i] : 0;
    check_record(campaign, record, file);
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
    const bool fits =
        (choice.setup.empty() || record.setup == choice.setup) &&
        (choice.condition.empty() || record.condition == choice.condition) &&
        (choice.kind.empty() || record.kind == choice.kind) &&
        (choice.setups.empty() || std::find(choice.setups.begin(), choice.setups.end(), record.setup) != choice.setups.end());
    if (!fits) continue;
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const RecordGroup& g) { return g.setup == record.setup && g.condition == record.condition; });
    if (group == groups.end()) group = groups.insert(groups.end(), {record.setup, record.condition, {}});
    if (!group->records.empty()) {
      const CampaignRecord& first = group->records.front();
      if (record.sampling_rate_Hz != first.sampling_rate_Hz || record.channels != first.channels) {
        throw InputError(
            {(campaign.folder / "campaign.toml").string(), record.line, "record"},
            fmt::format("differs in rate or channels from the record on line {} of the same setup and condition", first.line),
            "give it a setup of its own");
      }
    }
    group->records.push_back(record);
  }
  if (groups.empty() && !or_none) {
    throw InputError({(campaign.folder / "campaign.toml").string(), 0, "record"},
                     fmt::format("no record has setup '{}', condition '{}', kind '{}'; there are {}", choice.setup,
                                 choice.condition, choice.kind, fmt::join(there, ", ")),
                     "choose by --set setup=…, condition=…, kind=…");
  }
  // Conditions stay together, in the order in which they first appear.
  std::vector<std::string> order;
  for (const RecordGroup& group : groups) {
    if (std::find(order.begin(), order.end(), group.condition) == order.end()) order.push_back(group.condition);
  }
  std::stable_sort(groups.begin(), groups.end(), [&](const RecordGroup& a, const RecordGroup& b) {
    return std::find(order.begin(), order.end(), a.condition) < std::find(order.begin(), order.end(), b.condition);
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

Eigen::MatrixXd read_record(const Campaign& campaign, const CampaignRecord& record) {
  Eigen::MatrixXd data = in_order(campaign, record);
  for (Index c = 0; c < data.cols(); ++c) data.col(c) *= campaign.channel(record.channels[static_cast<std::size_t>(c)]).gain;
  return data;
}

}  // namespace twindeck::steps
