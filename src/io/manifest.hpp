#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace twindeck::io {

/// Inputs, outputs and configuration of a step. It is written last, as `manifest.json`, and is the step's Make target.
struct Manifest {
  std::string step;                      ///< "s6_updating"
  std::string status = "converged";      ///< "converged" | "unconverged"
  std::string message;                   ///< one line
  std::vector<std::string> warnings;     ///< doubtful inputs that the step used unchanged
  std::vector<std::string> notes;        ///< what the step noticed of its inputs beside that
  std::vector<std::string> corrections;  ///< corrections applied to the measurement, in words; may be empty
  std::string config_toml;               ///< resolved configuration
  std::vector<std::string> command_line;
  std::uint64_t seed = 0;
  int threads = 1;
  double seconds = 0.0;
  std::map<std::string, std::string> inputs;   ///< path as given -> SHA-256
  std::map<std::string, std::string> outputs;  ///< path relative to the step's folder -> SHA-256
};

/// Writes `folder/manifest.json` with library versions and commit from core/build_info.
void write_manifest(const Manifest& manifest, const std::filesystem::path& folder);
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& folder);
/// Refuses results that do not match their manifest.
/// @param path         a file, or a folder with all that is in it
/// @throws InputError  if a file inside a step's folder has another hash than the manifest above it says, is not listed there,
/// or
///                     is listed and gone; a folder without a manifest (a user's own data) is accepted.
void check_against_manifest(const std::filesystem::path& path);
/// True if the folder holds a manifest.json of ours.
[[nodiscard]] bool is_step_folder(const std::filesystem::path& folder);
/// SHA-256 of a file, lower-case hexadecimal.
[[nodiscard]] std::string sha256(const std::filesystem::path& file);

}  // namespace twindeck::io
