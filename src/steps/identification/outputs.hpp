#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "identification/condition.hpp"
#include "identification/decays.hpp"
#include "identification/stays.hpp"

namespace twindeck::steps {

/// The first condition's files at the top and each further condition's under conditions/<condition>/, decays.csv and
/// amplitude.csv, stays.csv and stay_tensions.csv, features/. Files of a condition (paper/twindeck_reference/columns.toml says
/// what each column holds):
/// modes.csv   EFDD is a cross-check of the first setup that has the mode
/// shapes.csv  direction = channel
/// poles.csv   mode of the merged list, empty where the pole belongs to none
/// psd.csv, singular_values.csv, and merging.csv where there are several setups
/// channels.csv  rows of the campaign's channels.csv that the shapes are known at
///
/// features/: rows.csv of all conditions, conditions.toml and channels.csv of the campaign (channels.csv as it is;
/// conditions.toml with an empty table a condition where the campaign has none), quality.csv. Shapes have unit norm there, so
/// that every entry has a standard deviation.
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
