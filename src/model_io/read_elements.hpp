#pragma once

#include <filesystem>

#include "model_io/folder_parts.hpp"

/// Inside of the library: nodes.csv, materials.csv, sections.csv, which the other files refer to, and elements.csv.
namespace twindeck::model_io {

void read_nodes(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_materials(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_sections(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_elements(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);

}  // namespace twindeck::model_io
