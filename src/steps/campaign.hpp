#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace twindeck::steps {

/// A row of a campaign's channels.csv (DESIGN section 3).
struct CampaignChannel {
  std::string name, point;
  std::string quantity = "acceleration";  ///< acceleration | velocity | displacement
  double gain = 1.0;                      ///< physical value in SI units = gain · recorded value
  bool reference = false;                 ///< stays at its place in every setup
  bool is_input = false;                  ///< role "input": a measured excitation
};

/// An entry [[record]] of campaign.toml.
struct CampaignRecord {
  std::string setup, kind, condition;
  std::filesystem::path file;             ///< with the campaign's folder before it
  double sampling_rate_Hz = 0.0;
  std::vector<std::string> channels;      ///< columns
  long line = 0;                          ///< of campaign.toml
};

struct Campaign {
  std::filesystem::path folder;
  std::vector<CampaignChannel> channels;
  std::vector<CampaignRecord> records;
  std::vector<std::string> conditions;    ///< tables of conditions.toml; empty if there is no such file
  [[nodiscard]] const CampaignChannel& channel(const std::string& name) const;
};

/// Reads campaign.toml, channels.csv and the names in conditions.toml; no record yet.
/// @throws InputError  with file, line, key: an unknown key, kind, channel or condition; a record without rate or channels
[[nodiscard]] Campaign read_campaign(const std::filesystem::path& folder);

/// What a record is chosen by; "" means any.
struct RecordChoice {
  std::string setup, condition, kind = "ambient";
};
/// The records that answer to the choice: one or several of one setup, condition, rate and list of channels.
/// @throws InputError  if there is none, or if they differ in one of these, naming what there is to choose from
[[nodiscard]] std::vector<CampaignRecord> choose_records(const Campaign& campaign, const RecordChoice& choice);

/// The samples of a record in SI units, gains applied; NaN where a sample is missing (an empty cell or a gap of the time stamps in a
/// CSV file, NaN in an NPY file).
/// @return (n_samples × n_channels) columns as in record.channels
/// @throws InputError  for an unknown format, another number of columns, a missing column, time stamps that run backwards or
///                     at another rate than campaign.toml says
[[nodiscard]] Eigen::MatrixXd read_record(const Campaign& campaign, const CampaignRecord& record);

}  // namespace twindeck::steps
