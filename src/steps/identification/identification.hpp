#pragma once

#include <string>
#include <vector>

#include "core/samples.hpp"
#include "io/config.hpp"
#include "signal/welch.hpp"
#include "steps/campaign/campaign.hpp"
#include "steps/identification/quality.hpp"
#include "steps/shared/run_step.hpp"
#include "sysid/efdd.hpp"
#include "sysid/identify.hpp"

namespace twindeck::steps {

/// A stay whose records are read as those of a string.
struct StaySettings {
  std::string name;  ///< setup, point or channel of its records
  double length_m = 0.0;
};

/// Configuration of s3_identification.
struct IdentificationConfig {
  std::string setup, condition, kind = "ambient", method = "covariance", selection = "automatic", merge = "poser";
  std::vector<std::string> setups, references, exclude;
  long decimation = 1, block_rows = 30, minimum_order = 2, maximum_order = 60, order_step = 2, blocks = 20, longest_gap = 0;
  long welch_segment = 2048;
  double largest_clipping = 1e-3;
  double lowest_Hz = 0.0;
  double highest_Hz = 0.0;  ///< 0: left open, at most 0.8 of the Nyquist frequency after decimation, the filter's passband
  sysid::StabilisationCriteria criteria;
  double largest_damping = 0.20;
  double largest_deviation = 0.01, largest_law_ratio = 10.0, largest_shape_deviation = 0.6;
  sysid::CleaningRule cleaning;
  sysid::AutomaticRule automatic;
  sysid::PeriodicRule periodic;
  // Free decays (ERA).
  long decay_decimation = 0, decay_block_rows = 60, decay_maximum_order = 40;
  double decay_start_s = 0.3, decay_length_s = 20.0, decay_band_Hz = 0.08;
  long decay_bands = 4;
  // Stays.
  long stay_decimation = 4, stay_block_rows = 100, stay_maximum_order = 40, stay_harmonics = 5;
  double stay_lowest_Hz = 0.3, stay_highest_Hz = 3.0, stay_level = 0.95;
  std::vector<StaySettings> stays;

  io::FieldTable fields();
  /// Settings of the subspace identification for records of this rate (after decimation) and these responses.
  [[nodiscard]] sysid::IdentifyOptions options(double rate_Hz, const std::vector<CampaignChannel>& channels) const;
};

/// Records of one setup and condition made ready for identification.
struct Conditioned {
  std::vector<CampaignChannel> channels;  ///< response columns that are used
  std::vector<CampaignChannel> inputs;    ///< input columns
  std::vector<Eigen::Index> references;   ///< positions among channels
  std::vector<Samples> records;           ///< detrended, decimated, SI units
  std::vector<Samples> excitation;        ///< of the inputs, one a record
  double rate_Hz = 0.0;                   ///< after decimation
  std::string setup, condition;
  std::vector<std::string> files;       ///< one a record, relative to the campaign's folder
  std::vector<ChannelQuality> quality;  ///< of the records as read, every channel
  std::vector<std::string> notes;       ///< what the user should know of how the records were read
};

/// Reads, judges, repairs as asked, detrends and decimates. A record that cannot be used is left out with a note, as long as
/// another of the group is left.
/// @throws UnusableRecord  if none is left: a gap that is not to be filled, a dead or clipped channel
/// @throws InputError  for an unknown reference, no response channel, a band beyond the records'
[[nodiscard]] Conditioned condition_records(const Campaign& campaign, const RecordGroup& group,
                                            const IdentificationConfig& config, Eigen::Index decimation);

/// Identification of one setup by the method asked for: covariance-driven or data-driven of responses alone, input-output where
/// the group has measured inputs. Records are pooled. Shapes are brought to the first channel's quantity: with lambda the pole,
/// a velocity is lambda times a displacement.
/// @throws InputError  if the records are too short or the orders too large
[[nodiscard]] sysid::Identification identify_modes(const Conditioned& conditioned, const IdentificationConfig& config);

/// A shape over scaled channels (value = recorded / scale) as a physical one of the first channel's quantity, unit norm.
[[nodiscard]] Eigen::VectorXcd physical_shape(const Eigen::VectorXcd& shape, const std::vector<CampaignChannel>& channels,
                                              const Eigen::VectorXd& scale, double frequency_Hz, double damping_ratio);
/// Brings shapes of scaled channels (value = recorded / scale) to physical ones of the first channel's quantity, deviations
/// with them.
void to_physical_shapes(sysid::Identification& found, const std::vector<CampaignChannel>& channels,
                        const Eigen::VectorXd& scale);

/// 2 for an acceleration, 1 for a velocity, 0 for a displacement.
[[nodiscard]] int derivative(const std::string& quantity);

/// RMS of each channel over the records.
[[nodiscard]] Eigen::VectorXd channel_rms(const std::vector<Samples>& records);

/// Power spectra averaged over the records, of accelerations [m²/s³]: those of other quantities are multiplied by (2 pi f)².
[[nodiscard]] signal::PowerSpectra average_spectra(const Conditioned& conditioned, const IdentificationConfig& config);

/// Singular values of the cross spectral matrix, channels scaled to unit RMS: [1/Hz].
[[nodiscard]] sysid::SingularSpectra singular_spectra(const Conditioned& conditioned, const IdentificationConfig& config);

}  // namespace twindeck::steps
