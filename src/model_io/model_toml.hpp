#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "fe/model.hpp"
#include "io/config.hpp"

/// Inside of the library: the file model.toml of a model folder.
namespace twindeck::model_io {

/// model.toml: title, gravity, formulation, prestress, parameters. Called last, since parameters name parts of the others.
/// @param model     its title and formulation stand where the file does not give them
/// @param add_keys  binds further keys that this file may have (the units of an imported deck)
void read_model_toml(const std::filesystem::path& file, fe::Model& model,
                     const std::function<void(io::FieldTable&)>& add_keys = {});
/// Meaning, unit, range and default of each key.
[[nodiscard]] std::string describe_model_toml();
void write_model_toml(const fe::Model& model, const std::filesystem::path& folder);

}  // namespace twindeck::model_io
