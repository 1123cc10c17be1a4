#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "identification/condition.hpp"
#include "identification/decays.hpp"
#include "identification/stays.hpp"

namespace twindeck::steps {

/// The first condition's files at the top and each further condition's under conditions/<condition>/, decays.csv and
/// amplitude.csv, stays.csv and stay_tensions.csv, features/. Files of a condition:
/// modes.csv   as docs/my_records.md has it, and `frequency_scatter_Hz,damping_ratio_scatter_pct` (standard deviation of the
///             poles over the model orders, of setups where there are several), `orders` (at how many orders the mode was
///             found, the most of its setups), `setups`, `partial` (1: some channels did not see it),
///             `efdd_frequency_Hz,efdd_damping_ratio_pct` (cross-check of the first setup that has it, empty where its bell is
///             too short)
/// shapes.csv  direction = channel
/// poles.csv   `setup,order,frequency_Hz,damping_ratio_pct,stable_frequency,stable_damping,stable_shape,mode,condition` (mode
///             empty where the pole belongs to none; of the merged list)
/// psd.csv     `channel,frequency_Hz,psd_m2_s3,setup,condition`
/// singular_values.csv  `setup,frequency_Hz,sv1,sv2,sv3,condition` of channels scaled to unit RMS [1/Hz]
/// merging.csv `mode,frequency_Hz,preger_frequency_Hz,damping_ratio_pct,preger_damping_ratio_pct,mac,setups` where there are
///             several setups
/// channels.csv  rows of the campaign's channels.csv that the shapes are known at
///
/// features/: rows.csv of all conditions, conditions.toml and channels.csv of the campaign (channels.csv as it is;
/// conditions.toml with an empty table a condition where the campaign has none), quality.csv
/// `setup,record,channel,samples,missing,longest_gap,clipped,mean,rms,drift_rms,dead,left_out,lag_s,lag_std_s`. Shapes have
/// unit norm there, so that every entry has a standard deviation.
void write_identification(const records::Campaign& campaign, const std::vector<identification::ConditionResult>& results,
                          const std::vector<identification::DecayResult>& decays,
                          const std::vector<identification::StayResult>& stays,
                          const identification::IdentificationSettings& config, const std::filesystem::path& folder);

/// Limits that were lowered because decays or stays are short.
[[nodiscard]] std::vector<std::string> notes_of(const std::vector<identification::DecayResult>& decays,
                                                const std::vector<identification::StayResult>& stays);

/// What was found, for people.
[[nodiscard]] std::vector<std::string> report_lines(const identification::ConditionResult& result);

/// Sentence for a condition without modes.
[[nodiscard]] std::string why_no_mode(const identification::ConditionResult& result);

/// Force, harmonics and ends of each stay, and advice for wide intervals; for people.
[[nodiscard]] std::vector<std::string> stay_lines(const std::vector<identification::StayResult>& stays, double level);

}  // namespace twindeck::steps
