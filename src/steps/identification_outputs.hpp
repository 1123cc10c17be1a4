#pragma once

#include <filesystem>

#include "steps/identification.hpp"

namespace twindeck::steps {

/// modes.csv (DESIGN section 3, with `frequency_scatter_Hz,damping_ratio_scatter_pct,orders`: standard deviation of the poles over
/// the model orders, and at how many orders the mode was found) and shapes.csv (direction = channel).
void write_identified_modes(const Conditioned& conditioned, const sysid::Identification& found, const std::filesystem::path& folder);

/// poles.csv: `setup,order,frequency_Hz,damping_ratio_pct,stable_frequency,stable_damping,stable_shape,mode` (mode empty where the
/// pole belongs to none).
void write_poles(const Conditioned& conditioned, const sysid::Identification& found, const std::filesystem::path& folder);

/// psd.csv: `channel,frequency_Hz,psd_m2_s3`.
void write_spectra(const Conditioned& conditioned, const signal::PowerSpectra& spectra, const std::filesystem::path& folder);

/// features/: rows.csv, conditions.toml and channels.csv of the campaign (channels.csv as it is; conditions.toml with an empty
/// table where the campaign has none), quality.csv. Shapes have unit norm there, so that every entry has a standard deviation.
void write_features(const Campaign& campaign, const Conditioned& conditioned, const sysid::Identification& found,
                    const std::filesystem::path& folder);

/// What was found, for people.
[[nodiscard]] std::vector<std::string> report_lines(const sysid::Identification& found);

}  // namespace twindeck::steps
