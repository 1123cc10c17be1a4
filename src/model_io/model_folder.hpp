#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::model_io {

/// Reads a model folder (DESIGN section 3). @throws InputError with file, line, column for anything that is not as it should be
[[nodiscard]] fe::Model read_model(const std::filesystem::path& folder);
/// Writes a model folder that `read_model` returns unchanged.
void write_model(const fe::Model& model, const std::filesystem::path& folder);

/// True if the folder is a matrix model (model.toml has [matrices]).
[[nodiscard]] bool is_matrix_model(const std::filesystem::path& folder);
/// Reads a matrix model: dofs.csv, model.toml, *.mtx.
[[nodiscard]] fe::ParametricSystem read_matrix_model(const std::filesystem::path& folder);
void write_matrix_model(const fe::ParametricSystem& system, const std::filesystem::path& folder);

/// The files of a model folder that exist, for the manifest's inputs.
[[nodiscard]] std::vector<std::filesystem::path> model_files(const std::filesystem::path& folder);

}  // namespace twindeck::model_io
