#pragma once

#include <map>
#include <string>
#include <utility>

#include "linalg/sparse.hpp"

/// Inside of the library: the entries of an OUTPUT4 file, formatted or binary.
namespace twindeck::matrix_io {

struct Op4Entries {
  long rows = 0;
  long form = 0;                               ///< of the header; 6: symmetric
  std::map<std::pair<long, long>, double> at;  ///< by column, row, from 0

  /// @param column, row  from 1 @return  false if the entry is there already
  bool add(long column, long row, double value) { return at.emplace(std::pair{column - 1, row - 1}, value).second; }
  /// Lower triangle. Of two triangles the mean is taken; one alone is that of a matrix of form 6.
  /// @throws InputError  with the file for a matrix that is not symmetric
  [[nodiscard]] linalg::SparseMatrix assembled(const std::string& file) const;
};

}  // namespace twindeck::matrix_io
