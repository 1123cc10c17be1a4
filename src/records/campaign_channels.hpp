#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace twindeck::records {

/// A row of a campaign's channels.csv (docs/my_records.md).
struct CampaignChannel {
  std::string name, point;
  Eigen::Vector3d position_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());  ///< NaN where not given
  Eigen::Vector3d direction = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());   ///< cosines dx, dy, dz
  std::string quantity = "acceleration";  ///< acceleration | velocity | displacement; of an input also force
  std::string unit;                       ///< unit of the recorded values, as the table has it
  double gain = 1.0;                      ///< physical value in SI units = gain · recorded value
  bool reference = false;                 ///< stays at its place in every setup
  bool is_input = false;                  ///< role "input": a measured excitation
};

/// Reads channels.csv. `gain` alone converts to SI; `unit` says what is recorded and must not contradict it.
/// @param warnings  gets a line for channels in volts or counts without a gain: modes need no scale, anything else does
/// @throws InputError  with file, line and column: a channel twice, a direction that is none, a unit that is empty, not known,
/// of another quantity, or contradicted by the gain
[[nodiscard]] std::vector<CampaignChannel> read_campaign_channels(const std::filesystem::path& file,
                                                                  std::vector<std::string>& warnings);

/// Why a channel is not the vertical acceleration at a point, in words; empty where it is.
[[nodiscard]] std::string other_than_vertical_acceleration(const CampaignChannel& channel, const Eigen::Vector3d& point_m,
                                                           double tolerance_m);

}  // namespace twindeck::records
