#include "core/build_info.hpp"

#include <dlfcn.h>
#include <link.h>

#include <Eigen/Core>
#include <filesystem>
#include <fstream>

// Holds macros only, so that core does not come to depend on the library itself.
#if __has_include(<Spectra/Util/Version.h>)
#include <Spectra/Util/Version.h>
#endif

namespace twindeck {
namespace fs = std::filesystem;
namespace {

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

/// The folder that holds HEAD: .git itself, or for a linked work tree the folder named in the file .git.
fs::path git_folder(const fs::path& root) {
  const fs::path git = root / ".git";
  std::error_code ignored;
  if (fs::is_directory(git, ignored)) return git;
  const std::string line = first_line(git);
  if (!line.starts_with("gitdir: ")) return {};
  const fs::path linked = line.substr(8);
  return linked.is_absolute() ? linked : root / linked;
}

/// The source tree that this program was built in: the nearest folder above the program that holds this file. Empty for an
/// installed program. __FILE__ does not tell: the build makes it relative, so that it would name a file below the current
/// folder.
fs::path source_tree() {
  std::error_code ignored;
  for (fs::path folder = fs::read_symlink("/proc/self/exe", ignored); folder.has_relative_path();) {
    folder = folder.parent_path();
    if (fs::exists(folder / "src/core/build_info.cpp", ignored)) return folder;
  }
  return {};
}

std::string resolve(const fs::path& git, const std::string& reference) {
  fs::path common = git;
  if (const std::string line = first_line(git / "commondir"); !line.empty()) common = git / line;
  for (const fs::path& folder : {git, common})
    if (const std::string hash = first_line(folder / reference); !hash.empty()) return hash;
  std::ifstream packed(common / "packed-refs");
  for (std::string line; std::getline(packed, line);)
    if (line.size() > 41 && line.substr(41) == reference) return line.substr(0, 40);
  return "";
}

/// Called for each shared library of the running program.
int note_library(dl_phdr_info* info, std::size_t, void* target) {
  std::error_code error;
  const fs::path file = fs::canonical(info->dlpi_name, error);
  if (error) return 0;
  auto& versions = *static_cast<std::map<std::string, std::string>*>(target);
  const std::pair<const char*, const char*> wanted[] = {
      {"libceres", "Ceres"}, {"libcholmod", "CHOLMOD"}, {"libopenblas", "OpenBLAS"}, {"libblas", "BLAS"}};
  for (const auto& [stem, name] : wanted)
    if (file.filename().string().starts_with(stem)) versions[name] = file.filename().string();
  return 0;
}

}  // namespace

std::string version() { return TWINDECK_VERSION; }

std::string source_commit() {
  const fs::path root = source_tree();
  if (root.empty()) return "";
  const fs::path git = git_folder(root);
  if (git.empty()) return "";
  const std::string head = first_line(git / "HEAD");
  const std::string hash = head.starts_with("ref: ") ? resolve(git, head.substr(5)) : head;
  return hash.size() == 40 ? hash : "";
}

std::map<std::string, std::string> library_versions() {
  std::map<std::string, std::string> versions;
  versions["Eigen"] = dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
#ifdef __VERSION__
  versions["compiler"] = __VERSION__;
#endif
#ifdef SPECTRA_MAJOR_VERSION
  versions["Spectra"] = dotted(SPECTRA_MAJOR_VERSION, SPECTRA_MINOR_VERSION, SPECTRA_PATCH_VERSION);
#endif
  // Shared libraries: the full name of the file that this very program has loaded ends in its version, which a header of
  // the build machine would not know ("libceres.so.2.1.0", "libcholmod.so.3.0.14", "libopenblasp-r0.3.21.so").
  dl_iterate_phdr(&note_library, &versions);
  if (void* const kernels = dlsym(RTLD_DEFAULT, "openblas_get_corename"))
    versions["OpenBLAS kernels"] = reinterpret_cast<const char* (*)()>(kernels)();
  return versions;
}

}  // namespace twindeck
