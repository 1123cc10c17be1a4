#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "dynamics/loaded_model.hpp"

namespace twindeck::model_io {

/// Reads a model folder, of finite elements or of matrices.
/// @throws InputError  with file and line
[[nodiscard]] dynamics::ReadModel read_model_folder(const std::filesystem::path& folder);

/// Writes the model as a model folder, with `theta` as its values, and the load cases of the folder that it came from.
void save_model(const dynamics::LoadedModel& loaded, const Eigen::VectorXd& theta, const std::filesystem::path& folder);

}  // namespace twindeck::model_io
