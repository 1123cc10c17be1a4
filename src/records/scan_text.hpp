#pragma once

#include <filesystem>

#include "records/record.hpp"

namespace twindeck::records {

/// The same contract as `scan` (record.hpp), for CSV and its kin.
RecordInfo scan_text(const std::filesystem::path& file, const Visitor& visit, const ReadOptions& options = {});

}  // namespace twindeck::records
