#pragma once

#include <filesystem>

namespace twindeck::io {

/// Refuses what a reader cannot read twice or to an end: a folder, a pipe, a socket, a device. Links are followed.
/// @return its length [bytes]
/// @throws InputError  naming what it is, or that it is not there
std::uintmax_t require_regular_file(const std::filesystem::path& file);

}  // namespace twindeck::io
