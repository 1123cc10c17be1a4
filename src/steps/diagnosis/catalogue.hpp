#pragma once

#include <filesystem>
#include <vector>

#include "diagnosis/causes/catalogue.hpp"

namespace twindeck::steps {

/// Every *.toml of a folder as a hypothesis, in the order of their ids.
/// @throws InputError  with file and line: an unknown key or primitive, a number that a primitive lacks, an unknown location
/// set
[[nodiscard]] std::vector<diagnosis::Hypothesis> read_catalogue(const std::filesystem::path& folder);

}  // namespace twindeck::steps
