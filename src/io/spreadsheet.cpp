#include "io/spreadsheet.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.hpp"
#include "io/regular_file.hpp"

extern "C" char** environ;

namespace twindeck::io {
namespace fs = std::filesystem;

namespace {

constexpr int no_workbook = 3, no_openpyxl = 4, too_long = 5, empty_sheet = 6;  ///< exit codes of spreadsheet.py

/// The program beside this one: in the source tree, or installed.
fs::path reader() {
  const fs::path place = "workflows/common/spreadsheet.py";
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path(), tree = folder.parent_path().parent_path();
  return fs::exists(tree / "src/layers.toml", ignored) ? tree / place : folder.parent_path() / "share/twindeck" / place;
}

/// @return exit code, -1 for a program that was ended or could not be started
int run(const fs::path& program, const fs::path& file, const fs::path& out) {
  const std::string script = program.string(), book = fs::absolute(file).string(), target = out.string();
  std::string words[] = {"python3", "-I", script, book};  // -I: no module out of the folder it is called in
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, target.c_str(), O_WRONLY | O_TRUNC, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int problem = ::posix_spawn(&child, "/usr/bin/python3", &files, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&files);
  if (problem != 0) return -1;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

bool is_spreadsheet(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".xlsx" || ending == ".XLSX";
}

fs::path table_file(const fs::path& csv) {
  const fs::path book = fs::path(csv).replace_extension(".xlsx");
  return !fs::exists(csv) && fs::exists(book) ? book : csv;
}

bool has_table(const fs::path& csv) { return fs::exists(table_file(csv)); }

fs::path csv_of_spreadsheet(const fs::path& file) {
  require_regular_file(file);
  std::string name = (fs::temp_directory_path() / "twindeck-XXXXXX").string();
  const int handle = ::mkstemp(name.data());
  if (handle < 0) throw std::system_error(errno, std::generic_category(), name);
  ::close(handle);
  const int code = run(reader(), file, name);
  if (code == 0) return name;
  fs::remove(name);
  const auto refuse = [&](const std::string& problem, const char* mend) {
    throw InputError({file.string(), 0, ""}, problem, mend);
  };
  if (code == no_openpyxl)
    refuse("is a workbook of Excel; the Python package openpyxl, which reads it, is not installed for /usr/bin/python3",
           "apt-get install python3-openpyxl, or save the sheet as CSV");
  if (code == too_long) refuse("has more than 2 GB as text", "save the sheet as CSV, and fewer columns");
  if (code == empty_sheet)
    refuse("is a workbook whose first sheet is empty", "move the table to the first sheet, or save its sheet as CSV");
  if (code == no_workbook) refuse("is no workbook that can be read", "save it anew as .xlsx, or the sheet as CSV");
  refuse(fmt::format("cannot be read: python3 ended with {}", code), "save the sheet as CSV");
  return {};
}

}  // namespace twindeck::io
