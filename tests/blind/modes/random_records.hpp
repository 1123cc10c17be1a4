#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

/// Records of random structures whose modes are known. Oracle of the identification: nothing here is taken from it.
namespace twindeck::blind::modes {

struct TrueMode {
  double frequency_Hz = 0.0, damping_ratio = 0.0;
  Eigen::VectorXd shape;  ///< [-] at all channels of all setups
};

/// One measurement: which of all channels, and what they recorded.
struct TrueSetup {
  std::vector<Eigen::Index> channels;
  Eigen::MatrixXd record;  ///< [m/s²] (n_samples × n_channels), with sensor noise
};

/// What one seed makes.
struct RandomRecords {
  std::uint64_t seed = 0;
  double rate_Hz = 0.0;
  std::vector<TrueMode> modes;           ///< ascending in frequency
  std::vector<Eigen::Index> references;  ///< channels that every setup has; empty for one setup
  Eigen::Index n_channels = 0;           ///< of all setups
  std::vector<TrueSetup> setups;
  std::vector<double> machine_Hz;  ///< lines of a machine: its speed and multiples; empty without one
  bool machine_wanders = false;
  double minutes = 0.0;    ///< of one setup
  double noise_dB = 0.0;   ///< signal to noise, powers, mean over the channels
  double moving = 0.0;     ///< strength of loads that cross the structure, against those that stay
  std::string excitation;  ///< colour of the forces: white, red or hump
  double closest_pct = 0.0;
};

/// 6 to 20 modes between 0.5 and 7.6 Hz, one to four pairs 0.3 to 7 % apart, damping 0.3 to 4 %, 4 to 24 channels, 5 to 60
/// minutes (short records more often), signal to noise 10 to 40 dB; every second structure carries a machine, every fourth is
/// measured in two or three setups of 5 to 20 minutes. Forces on eight points are coloured noise whose level varies as gusts
/// do; loads cross the structure. Each mode is one exact recursion (piecewise constant force); channels are sums over modes
/// plus white noise. A machine's line lies at least 2 % and two half bandwidths from every mode, and moves the channels by 0.2
/// to 1.5 times what the other forces do; in half of the cases its speed wanders by 0.03 %.
[[nodiscard]] RandomRecords random_records(std::uint64_t seed);

}  // namespace twindeck::blind::modes
