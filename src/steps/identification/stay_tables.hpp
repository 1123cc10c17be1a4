#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "identification/stays.hpp"
#include "io/csv.hpp"

namespace twindeck::steps {

/// stays.csv: `stay,condition,harmonic,frequency_Hz,frequency_std_Hz,damping_ratio_pct,damping_ratio_std_pct`.
/// stay_tensions.csv: `stay,condition,length_m,c_Hz,c_low_Hz,c_high_Hz,tension_per_mass_m2_s2,tension_per_mass_low_m2_s2,
/// tension_per_mass_high_m2_s2,lambda_squared,lambda_squared_low,lambda_squared_high,xi,xi_low,xi_high,hinged_probability,
/// clamped_probability,numbering_probability,residual,harmonics,level` (tension empty without a length, lambda² without the
/// first harmonic).
void write_stays(const std::vector<identification::StayResult>& stays, double level, const std::filesystem::path& folder);

/// Force, harmonics and ends of each stay, and what would narrow a wide interval; for people.
[[nodiscard]] std::vector<std::string> stay_lines(const std::vector<identification::StayResult>& stays, double level);

/// Rows `stay_frequency_Hz` of features/rows.csv: channel = the stay, mode = the harmonic.
[[nodiscard]] std::vector<std::vector<io::Cell>> stay_rows(const std::vector<identification::StayResult>& stays);

}  // namespace twindeck::steps
