#include "io/atomic.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"

namespace twindeck::io {
namespace fs = std::filesystem;
namespace {

std::mutex g_publishing;  // held while a partial folder takes its place, or is removed by another thread

std::string process_suffix(const char* word) { return std::string(".") + word + "-" + std::to_string(::getpid()); }

/// Where a path leads when its last part is a link, or a link to a link: what is replaced is the target, and the link stays.
fs::path behind_links(fs::path path) {
  constexpr int most_links = 40;  // as many as Linux follows
  std::error_code error;
  for (int i = 0; i < most_links && fs::is_symlink(path, error); ++i) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = without_trailing_slash(path.parent_path() / target);
  }
  return path;
}

/// What tells one machine's process numbers from another's: results may lie on a disk that several machines or containers
/// share.
std::string here() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  std::error_code error;
  return std::string(host) + " " + fs::read_symlink("/proc/self/ns/pid", error).string();
}

/// A link in a partial folder whose "target" is what here() said when it was made. A link is no output: no manifest lists it.
constexpr const char* kOwner = ".owner";

/// The process of "s1_model.partial-17", or 0 when the name is none of `stem` + ".partial-" or ".old-".
long process_of(const std::string& name, const std::string& stem, const std::string& word) {
  const std::string begin = stem + "." + word + "-";
  if (!name.starts_with(begin) || name.size() > begin.size() + 10) return 0;
  const std::string digits = name.substr(begin.size());
  if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos) return 0;
  return std::stol(digits);
}

bool has_ended(long process) { return ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH; }

/// Removes what killed processes left beside `place`, and puts back results that one of them had moved aside.
void clean_up_beside(const fs::path& place) {
  std::error_code error;
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  std::vector<fs::path> partial, old;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    const long writing = process_of(name, place.filename().string(), "partial");
    const long swapping = process_of(name, place.filename().string(), "old");
    if (swapping > 0 && has_ended(swapping)) old.push_back(at->path());
    if (writing <= 0 || !has_ended(writing)) continue;
    std::error_code none;
    const fs::path owner = fs::read_symlink(at->path() / kOwner, none);
    if (none || owner == here()) partial.push_back(at->path());
  }
  for (const fs::path& left : old)
    if (!fs::exists(place, error)) fs::rename(left, place, error);
  for (const fs::path& left : old) fs::remove_all(left, error);
  for (const fs::path& left : partial) fs::remove_all(left, error);
}

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw InputError({path.string(), 0, ""}, "cannot be written" + (why.empty() ? "" : " (" + why + ")"),
                   "check the permissions and the space on the disk, or name another --out");
}

}  // namespace

void write_file_atomically(const fs::path& named, std::string_view content) {
  std::error_code error;
  const fs::path file = behind_links(named);
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
  return behind_links(without_trailing_slash(final_place)) += process_suffix("partial");
}

FolderReplacement::FolderReplacement(const fs::path& final_place)
    : final_(behind_links(without_trailing_slash(final_place))), partial_(partial_place(final_place)) {
  std::error_code error;
  clean_up_beside(final_);
  fs::remove_all(partial_, error);  // left over by a killed process of the same id
  fs::create_directories(partial_, error);
  if (error) fail(partial_, error.message());
  fs::create_symlink(here(), partial_ / kOwner, error);  // where there are no links, its process number has to do
}

FolderReplacement::~FolderReplacement() {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

void FolderReplacement::publish() { publish(final_); }

/// A folder can be renamed within one disk only: where `place` is on another, the partial folder is copied there first.
void FolderReplacement::bring_beside(const fs::path& place) {
  struct stat from {
  }, to{};
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  if (::stat(partial_.c_str(), &from) != 0 || ::stat(folder.c_str(), &to) != 0 || from.st_dev == to.st_dev) return;
  std::error_code error;
  fs::path copy = place;
  copy += process_suffix("partial");
  fs::copy(partial_, copy, fs::copy_options::recursive, error);
  if (error) {
    const std::string why = error.message();
    fs::remove_all(copy, error);
    fail(copy, why);
  }
  fs::remove_all(partial_, error);
  partial_ = copy;
}

std::unique_lock<std::mutex> abandon_partial(const fs::path& partial) {
  constexpr int most_attempts = 20;  // the computation may still be writing into it
  constexpr auto pause = std::chrono::milliseconds(10);
  std::unique_lock<std::mutex> lock(g_publishing);
  std::error_code ignored;
  int gone = 0;  // times in a row: a writer may make the folder anew
  for (int attempt = 0; attempt < most_attempts && gone < 2; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(pause);
    fs::remove_all(partial, ignored);
    gone = fs::exists(partial, ignored) ? 0 : gone + 1;
  }
  return lock;
}

void FolderReplacement::publish(const fs::path& elsewhere) {
  const std::lock_guard<std::mutex> lock(g_publishing);
  const fs::path place = behind_links(without_trailing_slash(elsewhere));
  std::error_code error;
  fs::remove(partial_ / kOwner, error);
  bring_beside(place);
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
