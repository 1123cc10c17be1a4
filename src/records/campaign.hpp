#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/samples.hpp"
#include "records/campaign_channels.hpp"

namespace twindeck::records {

/// The kind of a record of frequency response functions (frequency_responses.hpp).
inline constexpr const char* kFrfKind = "frf";

/// An entry [[record]] of campaign.toml.
struct CampaignRecord {
  std::string setup, kind, condition;
  std::filesystem::path file;         ///< with the campaign's folder before it
  double sampling_rate_Hz = 0.0;      ///< 0 for frequency response functions
  std::vector<std::string> channels;  ///< names of channels.csv
  std::vector<std::string> columns;   ///< names of these channels in the file; empty if it uses the same names
  bool skip_stray_lines = false;      ///< leave out and count lines of a text file that are no rows, instead of refusing them
  std::string unit_from;              ///< "channels.csv" | "file": which one is right if their units differ; "": refuse
  long line = 0;                      ///< of campaign.toml
  std::map<std::string, long> lines;  ///< of each key there
  [[nodiscard]] long line_of(const std::string& key) const;
};

struct Campaign {
  std::filesystem::path folder;
  std::vector<CampaignChannel> channels;
  std::vector<CampaignRecord> records;
  std::vector<std::string> conditions;  ///< tables of conditions.toml; empty if there is no such file
  std::vector<std::string> warnings;    ///< unchecked assumptions about these files; for people
  [[nodiscard]] const CampaignChannel& channel(const std::string& name) const;
};

/// Reads campaign.toml, channels.csv and the names in conditions.toml; of the records only whether a universal file begins with
/// a frequency response function, which makes the record one of kind "frf".
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
/// The records that match the choice, by condition and setup in the order of campaign.toml.
/// @param or_none  true: returns an empty list if no record matches; false: refuses and names the possible choices
/// @throws InputError  also if records of time series of one setup and condition differ in rate or channels
[[nodiscard]] std::vector<RecordGroup> record_groups(const Campaign& campaign, const RecordChoice& choice,
                                                     bool or_none = false);

/// The gain of a record's channel number `c`. A unit in the file that contradicts channels.csv is refused, unless unit_from
/// says which is right. @param unit  as the file has it @param notes  gets a line where the two contradict each other
/// @throws InputError  with the file and the channel
[[nodiscard]] double gain_of(const Campaign& campaign, const CampaignRecord& record, std::size_t c, const std::string& unit,
                             std::vector<std::string>& notes);

/// The groups of each condition together. @param groups  from record_groups
[[nodiscard]] std::vector<std::vector<RecordGroup>> by_condition(const std::vector<RecordGroup>& groups);

/// Samples of a record, with notes on how they were read.
struct RecordSamples {
  Samples values;  ///< SI units, (n_samples × n_channels) in the order of record.channels; NaN where a sample is missing
  std::vector<std::string> notes;  ///< with the file's name; for people
};

/// The samples of a record, gains applied. Channels are found by their names in the file (records::match_columns), unless the
/// key `columns` of campaign.toml names the columns. NaN where a sample is missing (an empty cell, a gap of the time stamps,
/// NaN in the file).
/// @throws InputError  as records::read and match_columns; for a rate other than campaign.toml's by more than 0.1 % and three
///         standard deviations, a clock that runs backwards or at two rates, a unit that contradicts channels.csv, an
///         impossible value
[[nodiscard]] RecordSamples read_record(const Campaign& campaign, const CampaignRecord& record);

}  // namespace twindeck::records
