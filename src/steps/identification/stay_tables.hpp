#pragma once

#include <filesystem>
#include <vector>

#include "identification/stays.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {

/// stays.csv: `stay,condition,harmonic,frequency_Hz,frequency_std_Hz,damping_ratio_pct,damping_ratio_std_pct`.
/// stay_tensions.csv: `stay,condition,length_m,c_Hz,c_low_Hz,c_high_Hz,tension_per_mass_m2_s2,tension_per_mass_low_m2_s2,
/// tension_per_mass_high_m2_s2,lambda_squared,lambda_squared_low,lambda_squared_high,bending,bending_std,harmonics,level`
/// (tension empty without a length, lambda² without the first harmonic, bending where it was not tried).
void write_stays(const std::vector<identification::StayResult>& stays, double level, const std::filesystem::path& folder);

/// Rows `stay_frequency_Hz` of features/rows.csv: channel = the stay, mode = the harmonic.
[[nodiscard]] std::vector<std::vector<io::Cell>> stay_rows(const std::vector<identification::StayResult>& stays);

}  // namespace twindeck::steps
