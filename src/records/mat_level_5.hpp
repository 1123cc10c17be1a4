#pragma once

#include <cstdint>
#include <filesystem>

#include "records/mat_file.hpp"

namespace twindeck::records {

constexpr std::uint64_t kLevel5Header = 128;  ///< [bytes] text, version, order of bytes

/// Bytes of a number of that code (MatArray::storage); 0 for a code that is none.
[[nodiscard]] std::uint64_t storage_bytes(int storage);

/// Walks through the elements of a file of version 5, compressed or not: arrays, fields of single structures, texts of cell
/// arrays.
/// @param size  of the file [bytes] @throws InputError  as read_mat_contents
[[nodiscard]] MatFile read_level_5(const std::filesystem::path& file, std::uint64_t size);

}  // namespace twindeck::records
