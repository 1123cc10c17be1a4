#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "dynamics/loaded_model.hpp"
#include "fe/model.hpp"

namespace twindeck::model_io {

/// Reads a model folder, of finite elements or of matrices.
/// @throws InputError  with file and line
[[nodiscard]] dynamics::ReadModel read_model_folder(const std::filesystem::path& folder);

/// Writes the model as a model folder, with `theta` as its values, and the load cases of the folder that it came from.
void save_model(const dynamics::LoadedModel& loaded, const Eigen::VectorXd& theta, const std::filesystem::path& folder);

/// Reads a model folder (docs/my_model.md): model.toml, nodes.csv, elements.csv, materials.csv, sections.csv and, where they
/// are there, supports.csv, springs.csv, links.csv, constraints.csv, masses.csv, points.csv. Columns are those that
/// `write_model` writes; those with an obvious default may be left out. An empty shear modulus follows from E and nu.
/// @throws InputError with file, line, column for anything that is not as it should be
[[nodiscard]] fe::Model read_model(const std::filesystem::path& folder);

}  // namespace twindeck::model_io
