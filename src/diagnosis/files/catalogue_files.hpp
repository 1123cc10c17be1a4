#pragma once

#include <filesystem>
#include <vector>

#include "diagnosis/causes/catalogue.hpp"

/// Room diagnosis/files: files that only a diagnosis reads or keeps. It takes folders of features, the catalogue of causes,
/// published claims and load cases, and refuses with file and line what does not fit together. It gives the rows, causes and
/// loads that the other rooms of the diagnosis compute with.
namespace twindeck::diagnosis {

/// Every *.toml of a folder as a hypothesis, in the order of their ids.
/// @throws InputError  with file and line: an unknown key or primitive, a number that a primitive lacks, an unknown location
/// set
[[nodiscard]] std::vector<Hypothesis> read_catalogue(const std::filesystem::path& folder);

}  // namespace twindeck::diagnosis
