#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace twindeck::io {

/// What a step read, wrote and was told: written last, as `manifest.json`; it is the step's Make target.
struct Manifest {
  std::string step;                  ///< "s6_updating"
  std::string status = "converged";  ///< "converged" | "unconverged"
  std::string message;               ///< one line
  std::vector<std::string> warnings;  ///< what the step found odd in its inputs and took as it is
  std::vector<std::string> corrections;  ///< what of the measurement was put right first, in words; empty where nothing was
  std::string config_toml;           ///< resolved configuration
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
/// Refuses results that are not those of their manifest.
/// @param path         a file, or a folder with all that is in it
/// @throws InputError  if a file inside a step's folder has another hash than the manifest above it says, is not listed there,
/// or
///                     is listed and gone; a folder without a manifest (a user's own data) is accepted.
void check_against_manifest(const std::filesystem::path& path);
/// True if the folder holds a manifest.json of ours.
[[nodiscard]] bool is_step_folder(const std::filesystem::path& folder);
/// SHA-256 of a file, lower-case hexadecimal.
[[nodiscard]] std::string sha256(const std::filesystem::path& file);
/// The same of a text.
[[nodiscard]] std::string sha256_of_text(const std::string& text);

}  // namespace twindeck::io
