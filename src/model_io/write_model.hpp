#pragma once

#include <filesystem>

#include "fe/model.hpp"

namespace twindeck::model_io {

/// Writes a model folder that `read_model` returns unchanged to the 12 significant digits of the files: whatever has been read
/// once is written again byte for byte.
void write_model(const fe::Model& model, const std::filesystem::path& folder);

}  // namespace twindeck::model_io
