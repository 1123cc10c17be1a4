#pragma once

#include <filesystem>

#include "model_io/folder_parts.hpp"

/// Inside of the library: elements.csv.
namespace twindeck::model_io {

void read_elements(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);

}  // namespace twindeck::model_io
