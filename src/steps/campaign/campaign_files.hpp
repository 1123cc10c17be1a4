#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "ponte/virtual_bridge/simulated_records.hpp"
#include "ponte/virtual_bridge/stay_records.hpp"
#include "sensors/layout.hpp"

/// What s0_campaign writes beside the records themselves.
namespace twindeck::steps {

/// An entry of campaign.toml.
struct RecordFile {
  std::string setup, kind, condition, file;
  std::vector<std::string> channels;
};
/// The records of the decks, then those of the stays, in the order of the settings. Files are numbered within a setup and
/// condition.
[[nodiscard]] std::vector<RecordFile> record_files(const ponte::CampaignSettings& settings,
                                                   const std::vector<sensors::LayoutChannel>& layout);

/// RMS displacement at a channel, for conditions.toml.
struct Amplitude {
  std::string channel;
  double rms_m = 0.0;
};

/// campaign.toml, channels.csv, conditions.toml. A channel counts as a reference if every setup of the tests has it.
void write_campaign_files(const ponte::CampaignSettings& settings, const std::vector<sensors::LayoutChannel>& layout,
                          const std::vector<ponte::StayRecord>& stays, const std::vector<RecordFile>& files,
                          const std::map<std::string, Amplitude>& amplitudes, const std::filesystem::path& folder);

/// Tables of the true values. Only scorers read them.
class TruthTables {
 public:
  TruthTables();
  void add(const std::string& condition, const ponte::CampaignSettings& settings, const ponte::ConditionModel& model,
           const ponte::TrueModes& modes, const std::vector<sensors::LayoutChannel>& layout,
           const Eigen::MatrixXd& damper_force_N);
  /// modes.csv, shapes.csv, dampers.csv, stays.csv
  void save(const ponte::CampaignSettings& settings, const std::vector<ponte::StayRecord>& stays,
            const std::filesystem::path& folder) const;

 private:
  io::CsvWriter modes_, participation_, shapes_, dampers_;
};

}  // namespace twindeck::steps
