#pragma once

#include <string>
#include <vector>

#include "core/samples.hpp"
#include "identification/efdd.hpp"
#include "identification/identification_settings.hpp"
#include "identification/identify.hpp"
#include "identification/quality.hpp"
#include "records/campaign.hpp"
#include "records/frequency_responses.hpp"
#include "signal/welch.hpp"

/// Records of a campaign to modes with standard deviations: judged, made ready, identified setup by setup, merged; free decays
/// and stays beside them. It takes records as the campaign's reader gives them; it gives modes, spectra and the quality of the
/// channels.
namespace twindeck::identification {

/// Data about the records of one setup and condition, without their samples.
struct ConditionedInfo {
  std::vector<records::CampaignChannel> channels;  ///< response columns that are used
  std::vector<records::CampaignChannel> inputs;    ///< input columns
  std::vector<Eigen::Index> references;            ///< positions among channels
  double rate_Hz = 0.0;                            ///< after decimation
  double reach_Hz = 0.0;                           ///< highest frequency of the motion of free decays; 0: not known
  bool filtered = false;                           ///< decimation removed everything above 0.8 of the Nyquist frequency
  long block_rows = 0;                             ///< as configured, or chosen (sampling.hpp)
  std::string setup, condition;
  std::vector<std::string> files;       ///< one a record, relative to the campaign's folder
  std::vector<ChannelQuality> quality;  ///< of the records as read, every channel
  std::vector<std::string> notes;       ///< notes for the user on how the records were read
};

/// Records of one setup and condition, prepared for identification.
struct Conditioned : ConditionedInfo {
  std::vector<Samples> records;     ///< detrended, decimated, SI units
  std::vector<Samples> excitation;  ///< of the inputs, one a record
  /// Of a hammer test, which has no records (response_modes.hpp); without lines for any other setup.
  records::FrequencyResponses responses;
  std::vector<std::string> warnings;  ///< channels that are left out, and why
  [[nodiscard]] bool has_responses() const { return responses.frequency_Hz.size() > 0; }
};

/// @throws InputError  with the key, if one of the names that were asked for is no channel of the record
void require_known(const std::vector<std::string>& asked, const std::vector<std::string>& known, const std::string& key);

/// Sets the references: those asked for, else those marked in channels.csv, else all.
/// @throws InputError  for a name that is no channel
void choose_references(Conditioned& conditioned, const std::vector<std::string>& asked);

/// Reads the records, judges the channels, fills gaps if asked, detrends and decimates. The factor of decimation is chosen if
/// the configuration has 0. A record that cannot be used is left out with a note, as long as another of the group is left. A
/// channel that is dead, stuck or a copy in all of them (judge_channels) is left out with a warning, unless it is a reference
/// or the only response.
/// @throws UnusableRecord  if none is left: a gap that is not to be filled, a dead or clipped channel
/// @throws InputError  for two records of the same samples, an unknown reference, no response channel, a band above that of the
///         records
[[nodiscard]] Conditioned condition_records(const records::Campaign& campaign, const records::RecordGroup& group,
                                            const IdentificationSettings& config);

/// Identification of one setup by the method asked for: covariance-driven or data-driven of responses alone, input-output where
/// the group has measured inputs. Records are pooled. Shapes are converted to the quantity of the first channel: with lambda
/// the pole, a velocity is lambda times a displacement.
/// @throws InputError  if the records are too short or the orders too large
[[nodiscard]] Identification identify_modes(const Conditioned& conditioned, const IdentificationSettings& config);

/// Converts a shape of scaled channels (value = recorded / scale) to the first channel's quantity, with unit norm.
[[nodiscard]] Eigen::VectorXcd physical_shape(const Eigen::VectorXcd& shape,
                                              const std::vector<records::CampaignChannel>& channels,
                                              const Eigen::VectorXd& scale, double frequency_Hz, double damping_ratio);
/// Converts shapes of scaled channels (value = recorded / scale) and their deviations to the first channel's quantity.
void to_physical_shapes(Identification& found, const std::vector<records::CampaignChannel>& channels,
                        const Eigen::VectorXd& scale);

/// Samples of the shortest record. @param records  at least one
[[nodiscard]] Eigen::Index shortest_record(const std::vector<Samples>& records);

/// RMS of each channel over the records.
[[nodiscard]] Eigen::VectorXd channel_rms(const std::vector<Samples>& records);

/// Power spectra averaged over the records, of accelerations [m²/s³]: those of other quantities are multiplied by (2 pi f)².
[[nodiscard]] signal::PowerSpectra average_spectra(const Conditioned& conditioned, const IdentificationSettings& config);

/// Singular values of the cross spectral matrix, channels scaled to unit RMS: [1/Hz].
[[nodiscard]] SingularSpectra singular_spectra(const Conditioned& conditioned, const IdentificationSettings& config);

}  // namespace twindeck::identification
