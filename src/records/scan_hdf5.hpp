#pragma once

#include <filesystem>
#include <functional>

#include "records/record.hpp"

namespace twindeck::records {

/// The same contract as `scan` (record.hpp), for HDF5, and MAT 7.3, which is HDF5.
RecordInfo scan_hdf5(const std::filesystem::path& file, const Visitor& visit);

/// Does work in a child process first, whose end costs nothing: for libraries that break down on damaged files.
/// @return whether the child came to the work's end: false after a crash, or after a minute. True where no process can be had.
///         What the work throws is no crash: the caller, who does it again, sees it.
[[nodiscard]] bool survives(const std::function<void()>& work);

}  // namespace twindeck::records
