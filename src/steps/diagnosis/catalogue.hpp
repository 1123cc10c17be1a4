#pragma once

#include <filesystem>
#include <vector>

#include "diagnosis/catalogue.hpp"
#include "diagnosis/features.hpp"

/// What s9_diagnosis reads.
namespace twindeck::steps {

/// Every *.toml of a folder as a hypothesis, in the order of their ids.
/// @throws InputError  with file and line: an unknown key or primitive, a number that a primitive lacks, an unknown location
/// set
[[nodiscard]] std::vector<diagnosis::Hypothesis> read_catalogue(const std::filesystem::path& folder);

/// All rows of a features folder (docs/my_records.md) with their conditions and channels, quality.csv and covariance.npy where
/// they are there. Rows of static displacements are left out: no condition says under which load they were measured.
/// @throws InputError  with file, line, column: an unknown type, condition or channel, a row without a standard deviation
[[nodiscard]] diagnosis::FeatureSet read_all_features(const std::filesystem::path& folder);

}  // namespace twindeck::steps
