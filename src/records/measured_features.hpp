#pragma once

#include <filesystem>
#include <vector>

#include "matching/measured.hpp"
#include "records/corrections.hpp"
#include "records/measured_tables.hpp"

namespace twindeck::records {

/// The part of a measurement that a step uses, and the corrections to apply to it.
struct MeasuredChoice {
  ConditionChoice conditions;
  std::vector<Correction> corrections;
};

/// Reads the modes of one condition out of a features folder (docs/my_records.md): rows.csv, conditions.toml and, where there
/// are shapes, channels.csv. Modes come in ascending frequency; held-out rows are not read.
/// @param choice  which condition (choose_condition), and the corrections to apply
/// @throws InputError  with file, line, column: an unknown type, condition, state or channel, a row without a standard
/// deviation, a mode without a frequency, a mode without a shape where others have one. Channels that one mode lacks are NaN
/// there
[[nodiscard]] matching::Measured read_measured_features(const std::filesystem::path& folder, const MeasuredChoice& choice);

}  // namespace twindeck::records
