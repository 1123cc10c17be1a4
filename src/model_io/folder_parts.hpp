#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "fe/model.hpp"
#include "io/config.hpp"
#include "io/csv.hpp"

/// Inside of the library: a model folder is read one file at a time, in the order in which the files refer to one another.
/// Each function throws InputError with file, line and column.
namespace twindeck::model_io {

/// Finds parts by the names that the files use; fills the 0-based positions of fe::Model.
struct NameIndex {
  std::map<long, int> nodes;
  std::map<std::string, int> materials, sections;
  /// Node position of an id in a cell. @throws InputError if nodes.csv has no such node
  [[nodiscard]] int node(const io::CsvTable& table, std::size_t row, const std::string& column) const;
  /// Node position and direction 0-5 of "node:direction"; -1 for what is neither.
  [[nodiscard]] std::pair<int, int> displacement(const std::string& text) const;
};

/// 1-based line of the first line of `file` that holds `text`, 0 if there is none.
[[nodiscard]] long line_of(const std::filesystem::path& file, const std::string& text);

}  // namespace twindeck::model_io
