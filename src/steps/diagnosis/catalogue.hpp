#pragma once

#include <filesystem>
#include <vector>

#include "diagnosis/catalogue.hpp"
#include "diagnosis/features.hpp"
#include "diagnosis/structure.hpp"
#include "steps/measured/measured_choice.hpp"

/// What s9_diagnosis reads.
namespace twindeck::steps {

/// Every *.toml of a folder as a hypothesis, in the order of their ids.
/// @throws InputError  with file and line: an unknown key or primitive, a number that a primitive lacks, an unknown location
/// set
[[nodiscard]] std::vector<diagnosis::Hypothesis> read_catalogue(const std::filesystem::path& folder);

/// All rows of a features folder (docs/my_records.md) with their conditions and channels, quality.csv and covariance.npy where
/// they are there.
/// @param choice  which conditions are kept, with their rows; what is put right in them first
/// @throws InputError  with file, line, column: see steps/shared/feature_rows.hpp, measured_tables.hpp and corrections.hpp
[[nodiscard]] diagnosis::FeatureSet read_all_features(const std::filesystem::path& folder, const MeasuredChoice& choice = {});

/// @throws InputError  naming the line of rows.csv, for a frequency of a stay that the model lacks, or has without a pull
void refuse_unknown_stays(const diagnosis::FeatureSet& features, const diagnosis::Places& places,
                          const std::filesystem::path& folder);

/// @param folder  of the features
/// @param model   folder of the model, or another source, which has no load cases
/// @throws InputError  naming the line of conditions.toml, for a condition whose `load` is no load case of the model's
/// loads.csv
void refuse_unknown_loads(const std::filesystem::path& folder, const std::filesystem::path& model);

}  // namespace twindeck::steps
