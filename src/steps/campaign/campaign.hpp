#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace twindeck::steps {

/// A row of a campaign's channels.csv (docs/my_records.md).
struct CampaignChannel {
  std::string name, point;
  Eigen::Vector3d position_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());  ///< NaN where not given
  Eigen::Vector3d direction = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());   ///< cosines dx, dy, dz
  std::string quantity = "acceleration";  ///< acceleration | velocity | displacement
  double gain = 1.0;                      ///< physical value in SI units = gain · recorded value
  bool reference = false;                 ///< stays at its place in every setup
  bool is_input = false;                  ///< role "input": a measured excitation
};

/// An entry [[record]] of campaign.toml.
struct CampaignRecord {
  std::string setup, kind, condition;
  std::filesystem::path file;  ///< with the campaign's folder before it
  double sampling_rate_Hz = 0.0;
  std::vector<std::string> channels;  ///< columns
  long line = 0;                      ///< of campaign.toml
};

struct Campaign {
  std::filesystem::path folder;
  std::vector<CampaignChannel> channels;
  std::vector<CampaignRecord> records;
  std::vector<std::string> conditions;  ///< tables of conditions.toml; empty if there is no such file
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

/// The samples of a record in SI units, gains applied, in the order of record.channels: by name where the file names its
/// channels so, by position otherwise. NaN where a sample is missing (an empty cell, a gap of the time stamps, NaN in the
/// file).
/// @return (n_samples × n_channels)
/// @throws InputError  as records::read; for another number of columns, a missing column, a rate other than campaign.toml's by
/// more
///                     than 0.1 %, a clock that runs backwards
[[nodiscard]] Eigen::MatrixXd read_record(const Campaign& campaign, const CampaignRecord& record);

}  // namespace twindeck::steps
