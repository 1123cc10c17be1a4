#pragma once

#include <filesystem>

#include "model_io/folder_parts.hpp"

/// Inside of the library: nodes.csv, materials.csv, sections.csv, which the other files refer to, and elements.csv;
/// supports.csv, springs.csv, links.csv, constraints.csv, masses.csv, points.csv, of which each may be missing.
namespace twindeck::model_io {

void read_nodes(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_materials(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_sections(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_elements(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);

void read_supports(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_springs(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_links(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
/// constraints.csv: the rows of one node and direction are the terms of one equation.
void read_constraints(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_masses(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_points(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);

}  // namespace twindeck::model_io
