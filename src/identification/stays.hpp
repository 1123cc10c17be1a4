#pragma once

#include <string>
#include <vector>

#include "identification/identification.hpp"
#include "identification/tension.hpp"

namespace twindeck::identification {

/// A stay's record, identified.
struct StayResult {
  std::string stay, condition;
  double length_m = 0.0;  ///< 0 where not configured
  std::vector<ChannelQuality> quality;
  std::string note;  ///< limits that were lowered because the record is short; empty for none
  struct Mode {
    int harmonic = 0;
    double frequency_Hz = 0.0, frequency_std_Hz = 0.0, damping_ratio = 0.0, damping_ratio_std = 0.0;
  };
  std::vector<Mode> modes;  ///< ascending in harmonic
  bool fitted = false;      ///< two harmonics or more
  StayFit fit;              ///< without tension if the length is unknown; c and lambda² are valid anyway
};

/// Settings for the records of stays.
[[nodiscard]] IdentificationSettings stay_settings(const IdentificationSettings& config);

/// Identifies records of kind stay, numbers their modes as harmonics and fits a tensioned beam to them
/// (identification/tension.hpp). A stay is named as in [[stay_length]] by its setup, point or channel; otherwise by its setup.
/// @param records  of one stay each
[[nodiscard]] std::vector<StayResult> identify_stays(const std::vector<Conditioned>& records,
                                                     const IdentificationSettings& config);

}  // namespace twindeck::identification
