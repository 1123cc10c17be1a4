#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/record.hpp"

namespace twindeck::records {

/// Which channels of a file are the ones that were asked for.
struct ColumnMatch {
  std::vector<Eigen::Index> columns;  ///< positions in RecordInfo::channels, in the order asked for
  std::string warning;                ///< "" or what was taken on trust
};

/// A header binds: channels that it names are taken by name, and what was not asked for is ignored. A file that names some of
/// the channels but not all is refused, also where the names stand in a line that does not fit to the columns. A file that
/// names all of them in another spelling (case, blanks, '_', '-', '.') or by a further name of theirs is taken by those, with a
/// warning. A file that names none of them is taken by position if it has as many columns as channels were asked for, with a
/// warning if it has names at all.
/// @param channels  names asked for
/// @param columns   what the file calls each of them ("column 3": by position in the file); empty where it calls them so itself
/// @param file      for messages
/// @throws InputError  as said; also for a name that the file has twice
[[nodiscard]] ColumnMatch match_columns(const RecordInfo& info, const std::vector<std::string>& channels,
                                        const std::vector<std::string>& columns, const std::filesystem::path& file);

}  // namespace twindeck::records
