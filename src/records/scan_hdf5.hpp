#pragma once

#include <filesystem>

#include "records/record.hpp"

namespace twindeck::records {

/// The same contract as `scan` (record.hpp), for HDF5, and MAT 7.3, which is HDF5.
RecordInfo scan_hdf5(const std::filesystem::path& file, const Visitor& visit);

}  // namespace twindeck::records
