#include "diagnosis/files/feature_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/csv.hpp"
#include "io/spreadsheet.hpp"
#include "model_io/load_cases.hpp"
#include "records/feature_rows.hpp"
#include "records/measured_tables.hpp"

namespace twindeck::diagnosis {
namespace {

std::vector<Condition> all_of(const std::vector<records::MeasuredCondition>& measured) {
  std::vector<Condition> conditions;
  for (const records::MeasuredCondition& c : measured)
    conditions.push_back({c.name, c.state, c.dampers_on, c.amplitude_m, c.amplitude_channel, c.temperature_C, c.wind_m_s,
                          c.direction_deg, c.people, c.line, c.load});
  return conditions;
}

/// Position of a name that is known to be there.
int position(const std::vector<std::string>& names, const std::string& name) {
  const auto at = std::ranges::find(names, name);
  TWINDECK_ASSERT(at != names.end());
  return static_cast<int>(at - names.begin());
}

Row to_row(const records::FeatureRow& read, const std::vector<records::MeasuredCondition>& conditions,
           const FeatureSet& features) {
  Row row;
  row.line = read.line;
  row.type = static_cast<RowType>(position(row_type_names(), read.type));
  row.mode = read.mode;
  row.condition = static_cast<int>(
      std::ranges::find_if(conditions, [&](const records::MeasuredCondition& c) { return c.name == read.condition; }) -
      conditions.begin());
  row.value = read.value;
  row.std = read.std;
  row.held_out = read.held_out;
  if (row.type == RowType::stay_frequency)
    row.stay = read.channel;
  else if (row.type != RowType::frequency && row.type != RowType::damping)
    row.channel = position(features.channels, read.channel);
  return row;
}

void read_quality(const std::filesystem::path& file, const std::vector<records::Correction>& corrections,
                  FeatureSet& features) {
  if (!io::has_table(file)) return;
  const auto table = io::CsvTable::read(file, {"channel"}, {}, true);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string channel = corrected(corrections, table.text(row, "channel"), "").name;
    const double samples = table.number_or(row, "samples", 0.0);
    if (samples > 0.0)
      features.clipped[channel] = std::max(features.clipped[channel], table.number_or(row, "clipped", 0.0) / samples);
    features.drift[channel] = std::max(features.drift[channel], std::abs(table.number_or(row, "drift_rms", 0.0)));
  }
}

}  // namespace

FeatureSet read_all_features(const std::filesystem::path& folder, const records::MeasuredChoice& choice) {
  FeatureSet features;
  const std::vector<records::MeasuredCondition> listed = records::read_conditions(folder / "conditions.toml");
  std::vector<records::MeasuredCondition> conditions = chosen_conditions(folder / "conditions.toml", listed, choice.conditions);
  correct(choice.corrections, conditions);
  features.conditions = all_of(conditions);
  std::vector<matching::Channel> channels;
  if (io::has_table(folder / "channels.csv")) channels = records::read_channels(folder / "channels.csv");
  for (const matching::Channel& channel : channels) {
    features.channels.push_back(channel.name);
    features.direction.push_back(channel.direction);
  }
  refuse_unknown_channels(choice.corrections, features.channels, (folder / "channels.csv").string());
  for (const Condition& condition : features.conditions) {
    if (!condition.amplitude_channel.empty() && !contains(features.channels, condition.amplitude_channel))
      throw InputError({(folder / "conditions.toml").string(), 0, "amplitude_channel"},
                       fmt::format("'{}' of condition {} is not in channels.csv{}", condition.amplitude_channel, condition.name,
                                   did_you_mean(condition.amplitude_channel, features.channels)),
                       "");
  }
  records::FeatureRows read = read_feature_rows(folder, listed, channels);
  correct(choice.corrections, listed, read);
  std::vector<int> kept;
  for (std::size_t r = 0; r < read.rows.size(); ++r) {
    const auto is_its = [&](const records::MeasuredCondition& c) { return c.name == read.rows[r].condition; };
    if (std::ranges::none_of(conditions, is_its)) continue;
    kept.push_back(static_cast<int>(r));
    features.rows.push_back(to_row(read.rows[r], conditions, features));
  }
  if (features.rows.empty()) throw InputError({(folder / "rows.csv").string(), 0, ""}, "holds no row that can be used", "");
  if (read.covariance.size() > 0) features.covariance = read.covariance(kept, kept);
  read_quality(folder / "quality.csv", choice.corrections, features);
  return features;
}

void refuse_unknown_stays(const FeatureSet& features, const fe::Model* model, const std::filesystem::path& folder) {
  std::vector<std::string> names;
  if (model != nullptr)
    for (const fe::Element& element : model->elements)
      if (element.type == fe::ElementType::stay)
        names.push_back(element.name.empty() ? std::to_string(element.id) : element.name);
  std::sort(names.begin(), names.end());
  for (const Row& row : features.rows) {
    if (row.type == RowType::stay_frequency && !contains(names, row.stay))
      throw InputError({(folder / "rows.csv").string(), row.line, "channel"},
                       fmt::format("'{}' is no stay of the model{}", row.stay, did_you_mean(row.stay, names)),
                       names.empty() ? "the model has no stays; leave the row out, or stay_frequency_Hz as a whole (left_out)"
                                     : "name a stay of the model's elements.csv");
  }
}

void refuse_slack_stays(const FeatureSet& features, const Places& places, const std::filesystem::path& folder) {
  std::set<std::string> tensioned;
  if (const auto stays = places.sets.find("stays"); stays != places.sets.end())
    for (const Place& stay : stays->second)
      if (stay.attributes.contains("f_cable")) tensioned.insert(stay.id.substr(stay.id.find(':') + 1));
  for (const Row& row : features.rows) {
    if (row.type == RowType::stay_frequency && !tensioned.contains(row.stay))
      throw InputError({(folder / "rows.csv").string(), row.line, "channel"},
                       fmt::format("stay '{}' has no pull in the model, so that its frequency is not computed", row.stay),
                       "give its pull in elements.csv and a rule of prestress in model.toml, or leave the row out");
  }
}

void refuse_unknown_loads(const std::filesystem::path& folder, const std::filesystem::path& model) {
  const std::filesystem::path file = folder / "conditions.toml", loads = model / "loads.csv";
  const std::vector<std::string> known = model_io::load_case_names(model);
  for (const records::MeasuredCondition& condition : records::read_conditions(file)) {
    if (condition.load_line == 0 || contains(known, condition.load)) continue;
    throw InputError({file.string(), condition.load_line, "load"},
                     known.empty() ? fmt::format("names the load case '{}', but the model has none: {} is not there or empty",
                                                 condition.load, loads.string())
                                   : fmt::format("'{}' is no load case of {}{}", condition.load, loads.string(),
                                                 did_you_mean(condition.load, known)),
                     known.empty() ? "write the file with columns load,node,direction,value,unit, or leave the key out"
                                   : fmt::format("name one of {}, or add it there", fmt::join(known, ", ")));
  }
}

std::vector<Claim> read_claims(const std::filesystem::path& folder) {
  const auto file = folder / "claims.csv";
  std::vector<Claim> claims;
  if (!io::has_table(file)) return claims;
  const auto table = io::CsvTable::read(file, {"kind", "name", "record", "value", "lower", "upper", "source"}, {});
  const std::vector<std::string> kinds = {"parameter_change_pct", "mac", "frequency_error_pct", "rms_error_pct"};
  for (std::size_t r = 0; r < table.rows(); ++r) {
    Claim claim;
    const std::string kind = table.text(r, "kind");
    const auto at = std::ranges::find(kinds, kind);
    if (at == kinds.end()) table.fail(r, "kind", fmt::format("'{}' is no kind of claim; use {}", kind, fmt::join(kinds, ", ")));
    claim.kind = static_cast<Claim::Kind>(at - kinds.begin());
    claim.name = table.text(r, "name");
    claim.record = table.text(r, "record");
    claim.value = table.number(r, "value");
    claim.source = table.text(r, "source");
    if (claim.kind == Claim::Kind::parameter) {
      claim.lower = table.number(r, "lower");
      claim.upper = table.number(r, "upper");
      if (!(claim.lower < claim.upper)) table.fail(r, "lower", "is not below upper");
    }
    if (claim.kind == Claim::Kind::rms_error && claim.value <= -100.0)
      table.fail(r, "value", fmt::format("is {} %, but nothing computed is below zero", claim.value));
    claims.push_back(claim);
  }
  return claims;
}

}  // namespace twindeck::diagnosis
