#include "io/regular_file.hpp"

#include "core/error.hpp"

namespace twindeck::io {
namespace fs = std::filesystem;

std::uintmax_t require_regular_file(const fs::path& file) {
  std::error_code problem;
  const fs::file_status status = fs::status(file, problem);
  const auto refuse = [&](const char* what, const char* mend) { throw InputError({file.string(), 0, ""}, what, mend); };
  if (fs::is_directory(status)) refuse("cannot be read: it is a folder, expected a file", "name a file in it");
  if (fs::is_fifo(status) || fs::is_socket(status) || fs::is_character_file(status) || fs::is_block_file(status))
    refuse("is a pipe, a socket or a device, expected a regular file", "save what comes out of it to a file first");
  if (!fs::is_regular_file(status)) refuse("cannot be read", "check its name and your permissions");
  const std::uintmax_t bytes = fs::file_size(file, problem);
  if (problem) refuse("cannot be read", "check its name and your permissions");
  return bytes;
}

}  // namespace twindeck::io
