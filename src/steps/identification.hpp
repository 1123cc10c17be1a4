#pragma once

#include <string>
#include <vector>

#include "io/config.hpp"
#include "signal/welch.hpp"
#include "steps/campaign.hpp"
#include "steps/quality.hpp"
#include "steps/run_step.hpp"
#include "sysid/identify.hpp"

namespace twindeck::steps {

/// Configuration of s3_identification.
struct IdentificationConfig {
  std::string setup, condition, kind = "ambient";
  std::vector<std::string> references, exclude;
  long decimation = 1, block_rows = 30, minimum_order = 2, maximum_order = 60, order_step = 2, blocks = 20, longest_gap = 0;
  long welch_segment = 2048;
  double lowest_Hz = 0.0, highest_Hz = 0.0;  ///< highest 0: 0.8 of the Nyquist frequency after decimation, the filter's passband
  sysid::StabilisationCriteria criteria;
  double largest_damping = 0.20;
  double largest_deviation = 0.01;
  sysid::CleaningRule cleaning;

  io::FieldTable fields();
};

/// Records made ready for identification.
struct Conditioned {
  std::vector<CampaignChannel> channels;     ///< columns that are used
  std::vector<Eigen::Index> references;      ///< positions among them
  std::vector<Eigen::MatrixXd> records;      ///< detrended, decimated, SI units
  double rate_Hz = 0.0;                      ///< after decimation
  std::string setup, condition;
  std::vector<ChannelQuality> quality;       ///< of the records as read, every channel
};

/// Chooses, reads, judges, repairs as asked, detrends and decimates.
/// @throws InputError  for a gap that is not to be filled, a dead channel, an unknown reference, a band beyond the Nyquist frequency
[[nodiscard]] Conditioned condition_records(const Campaign& campaign, const IdentificationConfig& config);

/// Correlations pooled over the records, then sysid::identify. Shapes are brought to the first channel's quantity: with lambda the
/// pole, a velocity is lambda times a displacement.
/// @throws InputError  if the records are too short or the orders too large
[[nodiscard]] sysid::Identification identify_modes(const Conditioned& conditioned, const IdentificationConfig& config);

/// Power spectra averaged over the records, of accelerations [m²/s³]: those of other quantities are multiplied by (2 pi f)².
[[nodiscard]] signal::PowerSpectra average_spectra(const Conditioned& conditioned, const IdentificationConfig& config);

}  // namespace twindeck::steps
