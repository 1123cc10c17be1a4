#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/record.hpp"

namespace twindeck::records {

/// Which channels of a file are the ones that were asked for.
struct ColumnMatch {
  std::vector<Eigen::Index> columns;  ///< positions in RecordInfo::channels, in the order asked for
  std::string warning;                ///< "", or an unchecked assumption
};

/// Matches channels to the columns of a file.
///  - The file names all channels: they are taken by name; other columns are ignored.
///  - It names some of them only: refused, also if the names stand in a line with another number of cells than columns.
///  - It names all of them in another spelling (case, blanks, '_', '-', '.') or by other names: taken by those, with a warning.
///  - It names none: taken by position if the number of columns is that of the channels, with a warning if the file has names.
/// @param channels  names asked for
/// @param columns   names of these channels in the file ("column 3": by position); empty if it uses the same names
/// @param file      for messages
/// @throws InputError  as above; also for a name that the file has twice
[[nodiscard]] ColumnMatch match_columns(const RecordInfo& info, const std::vector<std::string>& channels,
                                        const std::vector<std::string>& columns, const std::filesystem::path& file);

}  // namespace twindeck::records
