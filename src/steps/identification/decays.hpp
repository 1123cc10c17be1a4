#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "steps/identification/condition.hpp"
#include "sysid/amplitude.hpp"

namespace twindeck::steps {

/// Free decays of one setup and condition.
struct DecayResult {
  std::string setup, condition;
  std::vector<CampaignChannel> channels;
  std::vector<ChannelQuality> quality;
  sysid::Identification found;  ///< ERA
  /// A mode's frequency and damping by amplitude.
  struct ByAmplitude {
    std::string mode;  ///< of the condition's modes.csv, empty where it has none
    std::string record;
    double frequency_Hz = 0.0;  ///< ERA's, that the filter was set to
    std::vector<sysid::AmplitudePoint> points;
  };
  std::vector<ByAmplitude> by_amplitude;
};

/// First sample after the release: where the motion's running RMS over half a second is largest. @param data (n_samples ×
/// n_channels)
[[nodiscard]] Eigen::Index release_sample(const Samples& data, double rate_Hz);

/// ERA of the records of kind free_decay, and frequency and damping by amplitude of the modes that it finds.
/// @param results  conditions identified from ambient records, for the names of modes
[[nodiscard]] std::vector<DecayResult> identify_free_decays(const std::vector<Conditioned>& records,
                                                            const IdentificationConfig& config,
                                                            const std::vector<ConditionResult>& results, std::uint64_t seed);

/// decays.csv: `condition,setup,mode,frequency_Hz,frequency_std_Hz,damping_ratio_pct,damping_ratio_std_pct,orders` and the
/// ambient mode it agrees with, `ambient_mode,ambient_frequency_Hz,ambient_frequency_std_Hz,mac` (empty for none).
/// amplitude.csv: `source,condition,setup,record,mode,amplitude,quantity,frequency_Hz,frequency_std_Hz,damping_ratio_pct,
/// damping_ratio_std_pct,seconds`: source free_decay (bands of the envelope) and ambient (one row a mode, amplitude sqrt(2)
/// times the modal RMS), at the channel of the shape's largest component.
void write_decays(const std::vector<DecayResult>& decays, const std::vector<ConditionResult>& results,
                  const IdentificationConfig& config, const std::filesystem::path& folder);

}  // namespace twindeck::steps
