#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/samples.hpp"
#include "records/campaign_channels.hpp"

namespace twindeck::records {

/// An entry [[record]] of campaign.toml.
struct CampaignRecord {
  std::string setup, kind, condition;
  std::filesystem::path file;  ///< with the campaign's folder before it
  double sampling_rate_Hz = 0.0;
  std::vector<std::string> channels;  ///< names of channels.csv
  std::vector<std::string> columns;   ///< what the file calls each of them; empty where it calls them so itself
  bool skip_stray_lines = false;      ///< leave out and count lines of a text file that are no rows, instead of refusing them
  std::string unit_from;              ///< "channels.csv" | "file": which is right where their units differ; "": refuse
  long line = 0;                      ///< of campaign.toml
  std::map<std::string, long> lines;  ///< of each key there
  [[nodiscard]] long line_of(const std::string& key) const;
};

struct Campaign {
  std::filesystem::path folder;
  std::vector<CampaignChannel> channels;
  std::vector<CampaignRecord> records;
  std::vector<std::string> conditions;  ///< tables of conditions.toml; empty if there is no such file
  std::vector<std::string> warnings;    ///< what was taken on trust in these files; for people
  [[nodiscard]] const CampaignChannel& channel(const std::string& name) const;
};

/// Reads campaign.toml, channels.csv and the names in conditions.toml; no record yet.
/// @throws InputError  with file, line, key: an unknown key, kind, channel or condition; a record without rate or channels
[[nodiscard]] Campaign read_campaign(const std::filesystem::path& folder);

/// What records are chosen by; "" means any.
struct RecordChoice {
  std::string setup, condition, kind = "ambient";
  std::vector<std::string> setups = {};  ///< one of these; empty means any
};
/// Records that are analysed together: one setup, condition, kind, rate and list of channels.
struct RecordGroup {
  std::string setup, condition;
  std::vector<CampaignRecord> records;
};
/// The records that answer to the choice, by condition and setup in the order of campaign.toml.
/// @param or_none  an empty list where none does; otherwise that is refused, naming what there is to choose from
/// @throws InputError  also if records of one setup and condition differ in rate or channels
[[nodiscard]] std::vector<RecordGroup> record_groups(const Campaign& campaign, const RecordChoice& choice,
                                                     bool or_none = false);

/// The groups of each condition together. @param groups  from record_groups
[[nodiscard]] std::vector<std::vector<RecordGroup>> by_condition(const std::vector<RecordGroup>& groups);

/// Samples of a record, and what the user should know of how they were read.
struct RecordSamples {
  Samples values;  ///< SI units, (n_samples × n_channels) in the order of record.channels; NaN where a sample is missing
  std::vector<std::string> notes;  ///< with the file's name; for people
};

/// The samples of a record, gains applied. A file's own names of its channels bind (records::match_columns); a key `columns` in
/// campaign.toml says otherwise. NaN where a sample is missing (an empty cell, a gap of the time stamps, NaN in the file).
/// @throws InputError  as records::read and match_columns; for a rate other than campaign.toml's by more than 0.1 % and
/// three standard deviations, a clock that runs backwards or at two rates, a unit that contradicts channels.csv, a value that
/// no sensor gives
[[nodiscard]] RecordSamples read_record(const Campaign& campaign, const CampaignRecord& record);

}  // namespace twindeck::records
