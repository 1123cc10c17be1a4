#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "steps/identification/identification.hpp"
#include "sysid/tension.hpp"

namespace twindeck::steps {

/// A stay's record, identified.
struct StayResult {
  std::string stay, condition;
  double length_m = 0.0;  ///< 0 where not configured
  std::vector<ChannelQuality> quality;
  struct Mode {
    int harmonic = 0;
    double frequency_Hz = 0.0, frequency_std_Hz = 0.0, damping_ratio = 0.0, damping_ratio_std = 0.0;
  };
  std::vector<Mode> modes;  ///< ascending in harmonic
  bool fitted = false;      ///< two harmonics or more
  sysid::StayFit fit;       ///< with length 1 m where the length is not known: c and lambda² hold all the same
};

/// The settings that records of stays are read and identified with.
[[nodiscard]] IdentificationConfig stay_settings(const IdentificationConfig& config);

/// Identifies records of kind stay and numbers their modes as harmonics. A stay is named as in [[stay_length]] by its setup,
/// point or channel; otherwise by its setup. @param records  of one stay each
[[nodiscard]] std::vector<StayResult> identify_stays(const std::vector<Conditioned>& records,
                                                     const IdentificationConfig& config);

/// stays.csv: `stay,condition,harmonic,frequency_Hz,frequency_std_Hz,damping_ratio_pct,damping_ratio_std_pct`.
/// stay_tensions.csv: `stay,condition,length_m,c_Hz,c_low_Hz,c_high_Hz,tension_per_mass_m2_s2,tension_per_mass_low_m2_s2,
/// tension_per_mass_high_m2_s2,lambda_squared,lambda_squared_low,lambda_squared_high,bending,bending_std,harmonics,level`
/// (tension empty without a length, lambda² without the first harmonic, bending where it was not tried).
void write_stays(const std::vector<StayResult>& stays, double level, const std::filesystem::path& folder);

/// Rows `stay_frequency_Hz` of features/rows.csv: channel = the stay, mode = the harmonic.
[[nodiscard]] std::vector<std::vector<io::Cell>> stay_rows(const std::vector<StayResult>& stays);

}  // namespace twindeck::steps
