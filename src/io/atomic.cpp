#include "io/atomic.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "core/error.hpp"

namespace twindeck::io {
namespace fs = std::filesystem;
namespace {

std::string process_suffix(const char* word) { return std::string(".") + word + "-" + std::to_string(::getpid()); }

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw InputError({path.string(), 0, ""}, "cannot be written" + (why.empty() ? "" : " (" + why + ")"),
                   "check the permissions and the space on the disk, or name another --out");
}

}  // namespace

void write_file_atomically(const fs::path& file, std::string_view content) {
  std::error_code error;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  if (error) fail(file, error.message());
  fs::path temporary = file;
  temporary += process_suffix("tmp");
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out) {
      fs::remove(temporary, error);
      fail(file, "");
    }
  }
  fs::rename(temporary, file, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(temporary, error);
    fail(file, why);
  }
}

fs::path without_trailing_slash(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

fs::path FolderReplacement::partial_place(const fs::path& final_place) {
  return without_trailing_slash(final_place) += process_suffix("partial");
}

FolderReplacement::FolderReplacement(const fs::path& final_place)
    : final_(without_trailing_slash(final_place)), partial_(partial_place(final_place)) {
  std::error_code error;
  fs::remove_all(partial_, error);  // left over by a killed process of the same id
  fs::create_directories(partial_, error);
  if (error) fail(partial_, error.message());
}

FolderReplacement::~FolderReplacement() {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

void FolderReplacement::publish() { publish(final_); }

void FolderReplacement::publish(const fs::path& elsewhere) {
  const fs::path place = without_trailing_slash(elsewhere);
  std::error_code error;
  if (!fs::exists(place)) {
    fs::rename(partial_, place, error);
    if (error) fail(place, error.message());
    return;
  }
  // One system call swaps both folders: there is no moment at which the results are missing.
  if (::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) == 0) {
    fs::remove_all(partial_, error);
    return;
  }
  // File systems that cannot swap: move the earlier results aside and back if the second rename fails.
  fs::path aside = place;
  aside += process_suffix("old");
  fs::rename(place, aside, error);
  if (error) fail(place, error.message());
  fs::rename(partial_, place, error);
  if (error) {
    const std::string why = error.message();
    fs::rename(aside, place, error);
    fail(place, why);
  }
  fs::remove_all(aside, error);
}

}  // namespace twindeck::io
