#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model_io/folder_parts.hpp"

/// Inside of the library: elements of a model folder that are given by matrices.
namespace twindeck::model_io {

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

}  // namespace twindeck::model_io
