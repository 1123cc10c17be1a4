#pragma once

#include <filesystem>

#include "model_io/folder_parts.hpp"

/// Inside of the library: supports.csv, springs.csv, links.csv, constraints.csv, masses.csv, points.csv. Each may be missing.
namespace twindeck::model_io {

void read_supports(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_springs(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_links(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
/// constraints.csv: the rows of one node and direction are the terms of one equation.
void read_constraints(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_masses(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_points(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);

}  // namespace twindeck::model_io
