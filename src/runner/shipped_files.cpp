#include "runner/shipped_files.hpp"

#include <array>
#include <string>
#include <string_view>

namespace twindeck::runner {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 2> shipped_folders = {"workflows/common/", "data/wind/"};

bool is_shipped(const std::string& path) {
  for (const std::string_view folder : shipped_folders)
    if (path.starts_with(folder)) return true;
  return false;
}

}  // namespace

fs::path shipped(const fs::path& path, const fs::path& program) {
  std::error_code ignored;
  if (fs::exists(path, ignored) || program.empty() || !is_shipped(path.generic_string())) return path;
  const fs::path folder = program.parent_path();
  const fs::path tree = folder.parent_path().parent_path();
  // Only a source tree of twindeck counts, not whatever lies two folders above an installed program.
  if (fs::exists(tree / "src/layers.toml", ignored) && fs::exists(tree / path, ignored)) return tree / path;
  const fs::path installed = folder.parent_path() / "share/twindeck" / path;
  return fs::exists(installed, ignored) ? installed : path;
}

fs::path shipped(const fs::path& path) {
  std::error_code ignored;
  return shipped(path, fs::read_symlink("/proc/self/exe", ignored));
}

}  // namespace twindeck::runner
