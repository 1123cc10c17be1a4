#include "steps/campaign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <toml++/toml.h>

#include "core/error.hpp"
#include "io/config.hpp"
#include "io/csv.hpp"
#include "io/npy.hpp"

namespace twindeck::steps {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

const std::vector<std::string> kKinds = {"ambient", "free_decay", "wind", "earthquake", "stay"};
const std::vector<std::string> kQuantities = {"acceleration", "velocity", "displacement"};

std::string one_of(const io::CsvTable& table, std::size_t row, const std::string& column, const std::vector<std::string>& allowed) {
  const std::string text = table.text(row, column).empty() ? allowed.front() : table.text(row, column);
  if (std::find(allowed.begin(), allowed.end(), text) == allowed.end()) {
    table.fail(row, column, fmt::format("is '{}', expected {}{}", text, fmt::join(allowed, ", "), did_you_mean(text, allowed)));
  }
  return text;
}

std::vector<CampaignChannel> read_channels(const fs::path& file) {
  const auto table = io::CsvTable::read(file, {"channel"}, {"point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain",
                                                            "reference", "role"});
  std::vector<CampaignChannel> channels;
  std::set<std::string> names;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    CampaignChannel channel;
    channel.name = table.text(row, "channel");
    if (channel.name.empty()) table.fail(row, "channel", "is empty", "name the channel");
    if (!names.insert(channel.name).second) table.fail(row, "channel", fmt::format("'{}' appears twice", channel.name), "remove one row");
    channel.point = table.text(row, "point").empty() ? channel.name : table.text(row, "point");
    channel.quantity = one_of(table, row, "quantity", kQuantities);
    channel.gain = table.number_or(row, "gain", 1.0);
    if (channel.gain == 0.0) table.fail(row, "gain", "is 0, expected the factor from recorded to physical values", "leave it empty for 1");
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
    throw InputError({file.string(), static_cast<long>(error.source().begin.line), ""}, std::string(error.description()), "mend the TOML");
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
    throw InputError({file.string(), static_cast<long>(error.source().begin.line), ""}, std::string(error.description()), "mend the TOML");
  }
  return lines;
}

void check_record(const Campaign& campaign, const CampaignRecord& record, const fs::path& file) {
  std::vector<std::string> known;
  for (const CampaignChannel& channel : campaign.channels) known.push_back(channel.name);
  if (record.channels.empty()) throw InputError({file.string(), record.line, "channels"}, "is empty", "list the columns of the record");
  std::set<std::string> seen;
  for (const std::string& name : record.channels) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InputError({file.string(), record.line, "channels"}, fmt::format("channel '{}' is not in channels.csv{}", name, did_you_mean(name, known)),
                       "add it there, or correct the name");
    }
    if (!seen.insert(name).second) throw InputError({file.string(), record.line, "channels"}, fmt::format("names '{}' twice", name), "");
  }
  const auto& conditions = campaign.conditions;
  if (!conditions.empty() && std::find(conditions.begin(), conditions.end(), record.condition) == conditions.end()) {
    throw InputError({file.string(), record.line, "condition"},
                     fmt::format("'{}' is no table of conditions.toml{}", record.condition, did_you_mean(record.condition, conditions)),
                     "add a table [" + record.condition + "] there");
  }
}

/// Names what there is to choose from.
template <typename Get>
void require_one(const Campaign& campaign, const std::vector<CampaignRecord>& records, const std::string& key, Get get) {
  std::set<std::string> values;
  for (const CampaignRecord& record : records) values.insert(get(record));
  if (values.size() == 1) return;
  throw InputError({(campaign.folder / "campaign.toml").string(), 0, key}, fmt::format("the chosen records have several: {}", fmt::join(values, ", ")),
                   fmt::format("choose one, for example --set {}={}", key, *values.begin()));
}

/// Places the samples by their time stamps; what is missing in between is NaN.
Eigen::MatrixXd read_csv_record(const CampaignRecord& record) {
  std::vector<std::string> required = record.channels;
  required.insert(required.begin(), "time_s");
  const auto table = io::CsvTable::read(record.file, required, {}, true);
  if (table.rows() == 0) throw InputError({record.file.string(), 0, ""}, "has no samples", "check the record");
  const double start = table.number(0, "time_s");
  std::vector<Index> at(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double position = (table.number(row, "time_s") - start) * record.sampling_rate_Hz;
    at[row] = std::lround(position);
    if (std::abs(position - static_cast<double>(at[row])) > 0.25 || (row > 0 && at[row] <= at[row - 1]) ||
        (row > 0 && at[row] > 100 * static_cast<Index>(table.rows()))) {
      table.fail(row, "time_s", fmt::format("does not fit a sampling rate of {} Hz from {} s on", record.sampling_rate_Hz, start),
                 "correct sampling_rate_Hz in campaign.toml, or the time stamps");
    }
  }
  const auto n = static_cast<Index>(record.channels.size());
  Eigen::MatrixXd data = Eigen::MatrixXd::Constant(at.back() + 1, n, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (Index c = 0; c < n; ++c) {
      data(at[row], c) = table.number_or(row, record.channels[static_cast<std::size_t>(c)], std::numeric_limits<double>::quiet_NaN());
    }
  }
  return data;
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
    throw InputError({file.string(), 0, ""}, "is not there, expected one table [[record]] for each record", "write it (DESIGN, campaign folder)");
  }
  campaign.channels = read_channels(folder / "channels.csv");
  campaign.conditions = condition_names(folder / "conditions.toml");
  const std::vector<long> lines = record_lines(file);

  // The list is reserved, so that the fields bound to an element stay where they are.
  struct Raw { CampaignRecord record; std::string file; };
  std::vector<Raw> raw;
  raw.reserve(lines.size() + 1);
  io::FieldTable fields;
  fields.tables("record", [&raw] {
    raw.push_back({});
    Raw& r = raw.back();
    r.record.condition = "as_measured";
    r.record.kind = "ambient";
    io::FieldTable table;
    table.text("setup", r.record.setup, "name of the setup", true)
        .choice("kind", r.record.kind, kKinds, "what was recorded")
        .text("file", r.file, "samples x channels (.npy), or time_s and a column a channel (.csv); relative to campaign.toml", true)
        .number("sampling_rate_Hz", r.record.sampling_rate_Hz, "Hz", io::positive(), "samples a second of each channel", true)
        .texts("channels", r.record.channels, "columns, names of channels.csv")
        .text("condition", r.record.condition, "table of conditions.toml");
    return table;
  }, "a record");
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

std::vector<CampaignRecord> choose_records(const Campaign& campaign, const RecordChoice& choice) {
  std::vector<CampaignRecord> chosen;
  std::set<std::string> there;
  for (const CampaignRecord& record : campaign.records) {
    there.insert(fmt::format("{}/{}/{}", record.setup, record.condition, record.kind));
    const bool fits = (choice.setup.empty() || record.setup == choice.setup) && (choice.condition.empty() || record.condition == choice.condition) &&
                      (choice.kind.empty() || record.kind == choice.kind);
    if (fits) chosen.push_back(record);
  }
  if (chosen.empty()) {
    throw InputError({(campaign.folder / "campaign.toml").string(), 0, "record"},
                     fmt::format("no record has setup '{}', condition '{}', kind '{}'; there are {}", choice.setup, choice.condition, choice.kind,
                                 fmt::join(there, ", ")),
                     "choose by --set setup=…, condition=…, kind=…");
  }
  require_one(campaign, chosen, "setup", [](const CampaignRecord& r) { return r.setup; });
  require_one(campaign, chosen, "condition", [](const CampaignRecord& r) { return r.condition; });
  require_one(campaign, chosen, "kind", [](const CampaignRecord& r) { return r.kind; });
  for (const CampaignRecord& record : chosen) {
    if (record.sampling_rate_Hz != chosen.front().sampling_rate_Hz || record.channels != chosen.front().channels) {
      throw InputError({(campaign.folder / "campaign.toml").string(), record.line, "record"},
                       fmt::format("differs in rate or channels from the record on line {} of the same setup and condition", chosen.front().line),
                       "give it a setup of its own");
    }
  }
  return chosen;
}

Eigen::MatrixXd read_record(const Campaign& campaign, const CampaignRecord& record) {
  const std::string extension = record.file.extension().string();
  if (extension != ".npy" && extension != ".csv") {
    throw InputError({(campaign.folder / "campaign.toml").string(), record.line, "file"},
                     fmt::format("'{}' has the ending '{}', expected .npy or .csv", record.file.string(), extension), "convert the record");
  }
  Eigen::MatrixXd data = extension == ".npy" ? io::read_npy(record.file) : read_csv_record(record);
  if (data.cols() != static_cast<Index>(record.channels.size())) {
    throw InputError({record.file.string(), 0, ""}, fmt::format("has {} columns, but campaign.toml names {} channels", data.cols(), record.channels.size()),
                     "an array of samples x channels is expected");
  }
  for (Index c = 0; c < data.cols(); ++c) data.col(c) *= campaign.channel(record.channels[static_cast<std::size_t>(c)]).gain;
  return data;
}

}  // namespace twindeck::steps
