#pragma once

#include <filesystem>

#include "records/record.hpp"

namespace twindeck::records {

/// The same contract as `scan` (record.hpp), for MAT 4 and 5.
RecordInfo scan_mat(const std::filesystem::path& file, const Visitor& visit);

}  // namespace twindeck::records
