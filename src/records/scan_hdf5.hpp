#pragma once

#include <filesystem>
#include <functional>

#include "records/record.hpp"

namespace twindeck::records {

/// The same contract as `scan` (record.hpp), for HDF5, and MAT 7.3, which is HDF5.
RecordInfo scan_hdf5(const std::filesystem::path& file, const Visitor& visit);

/// Does work in a child process first, because some libraries crash on damaged files.
/// @return false if the child crashed or took a minute; true if it ended, or if no process can be created. An exception of the
///         work is no crash: the caller repeats the work and gets it.
[[nodiscard]] bool survives(const std::function<void()>& work);

}  // namespace twindeck::records
