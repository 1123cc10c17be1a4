#pragma once

#include <filesystem>
#include <vector>

#include "diagnosis/evidence.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "records/measured_features.hpp"

namespace twindeck::diagnosis {

/// All rows of a features folder (docs/my_records.md) with their conditions and channels, quality.csv and covariance.npy where
/// they are there.
/// @param choice  the conditions to keep, with their rows; corrections are applied first
/// @throws InputError  with file, line, column: see records/feature_rows.hpp, measured_tables.hpp and corrections.hpp
[[nodiscard]] FeatureSet read_all_features(const std::filesystem::path& folder, const records::MeasuredChoice& choice = {});

/// @param model  null for a matrix model, which has no stays @param folder  of the features
/// @throws InputError  naming the line of rows.csv, for a frequency of a stay that the model lacks
void refuse_unknown_stays(const FeatureSet& features, const fe::Model* model, const std::filesystem::path& folder);
/// @throws InputError  naming the line of rows.csv, for a frequency of a stay that has no pull in the model
void refuse_slack_stays(const FeatureSet& features, const Places& places, const std::filesystem::path& folder);

/// @param folder  of the features
/// @param model   folder of the model, or another source, which has no load cases
/// @throws InputError  naming the line of conditions.toml, for a condition whose `load` is no load case of the model's
/// loads.csv
void refuse_unknown_loads(const std::filesystem::path& folder, const std::filesystem::path& model);

/// Claims of a features folder; none where the file is not there.
/// @throws InputError with file, line and column
[[nodiscard]] std::vector<Claim> read_claims(const std::filesystem::path& folder);

}  // namespace twindeck::diagnosis
