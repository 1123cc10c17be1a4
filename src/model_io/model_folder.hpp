#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model_io/matrix_model.hpp"
#include "model_io/read_model.hpp"
#include "model_io/write_matrix_model.hpp"
#include "model_io/write_model.hpp"

namespace twindeck::model_io {

/// Meaning, unit, range and default of each key of a model folder's model.toml.
[[nodiscard]] std::string describe_model_toml();

/// The files of a model folder that exist, for the manifest's inputs.
[[nodiscard]] std::vector<std::filesystem::path> model_files(const std::filesystem::path& folder);

}  // namespace twindeck::model_io
