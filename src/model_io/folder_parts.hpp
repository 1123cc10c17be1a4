#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "fe/model.hpp"
#include "io/config.hpp"
#include "io/csv.hpp"

/// Inside of the library: a model folder is read one file at a time, in the order in which the files refer to one another.
/// Each function throws InputError with file, line and column.
namespace twindeck::model_io {

/// Of a parameter's initial value and bounds: beyond, what it scales leaves the range of doubles.
[[nodiscard]] inline io::Range parameter_range() { return {-1e30, 1e30}; }

/// Finds parts by the names that the files use; fills the 0-based positions of fe::Model.
struct NameIndex {
  std::map<long, int> nodes;
  std::map<std::string, int> materials, sections;
  /// Node position of an id in a cell. @throws InputError if nodes.csv has no such node
  [[nodiscard]] int node(const io::CsvTable& table, std::size_t row, const std::string& column) const;
};

void read_nodes(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_materials(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_sections(const std::filesystem::path& folder, fe::Model& model, NameIndex& index);
void read_elements(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);

/// supports.csv, springs.csv, links.csv, masses.csv, points.csv: each may be missing.
void read_supports(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_springs(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_links(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_masses(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);
void read_points(const std::filesystem::path& folder, fe::Model& model, const NameIndex& index);

/// model.toml: title, gravity, formulation, prestress, parameters. Called last, since parameters name parts of the others.
/// @param model     its title and formulation stand where the file does not give them
/// @param add_keys  binds further keys that this file may have (the units of an imported deck)
void read_model_toml(const std::filesystem::path& file, fe::Model& model,
                     const std::function<void(io::FieldTable&)>& add_keys = {});
void write_model_toml(const fe::Model& model, const std::filesystem::path& folder);

/// [[matrix_element]] of model.toml: elements given by matrices, which lie in the folder matrices/ (Matrix Market, general or
/// symmetric). `MatrixElementEntry` is a table of the file as it stands.
struct MatrixElementEntry {
  std::string name, group, stiffness, damping, mass;  ///< the last three are files, relative to the model folder; "" = none
  std::vector<std::string> dofs;                      ///< "node:direction"
  long internal = 0;
  io::FieldTable fields();
};
[[nodiscard]] fe::MatrixElement to_matrix_element(const std::filesystem::path& folder, const NameIndex& index,
                                                  const MatrixElementEntry& entry);
/// The tables of model.toml; the matrices are written to matrices/<name>_K.mtx, _C.mtx, _M.mtx.
[[nodiscard]] std::string write_matrix_elements(const fe::Model& model, const std::filesystem::path& folder);

/// 1-based line of the first line of `file` that holds `text`, 0 if there is none.
[[nodiscard]] long line_of(const std::filesystem::path& file, const std::string& text);

}  // namespace twindeck::model_io
