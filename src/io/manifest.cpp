#include "io/manifest.hpp"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/build_info.hpp"
#include "core/error.hpp"
#include "io/atomic.hpp"
#include "io/regular_file.hpp"

namespace twindeck::io {
namespace fs = std::filesystem;
namespace {

/// Marks a manifest.json as ours; other programs write files of that name too.
constexpr const char* kFormat = "twindeck-manifest-1";

/// Header of a CSV output, so that the manifest tells columns with their units.
std::vector<std::string> header_of(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<std::string> columns(1);
  for (const char letter : line) {
    if (letter == ',') {
      columns.emplace_back();
    } else if (letter != '\r' && letter != '"') {
      columns.back() += letter;
    }
  }
  return columns;
}

std::optional<nlohmann::json> parse_ours(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  require_regular_file(file);
  std::ifstream in(file);
  if (!in) return std::nullopt;
  nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (json.is_discarded())
    throw InputError({file.string(), 0, ""}, "is no readable JSON, so the files beside it cannot be checked",
                     "run the step that writes this folder again");
  if (!json.is_object() || json.value("format", nlohmann::json()) != kFormat) return std::nullopt;
  return json;
}

/// The nearest folder at or above `start` with a manifest of ours.
std::optional<fs::path> step_folder(fs::path start) {
  start = fs::weakly_canonical(start);
  while (true) {
    if (parse_ours(start / "manifest.json")) return start;
    if (!start.has_relative_path()) return std::nullopt;
    start = start.parent_path();
  }
}

void check_file(const Manifest& manifest, const fs::path& folder, const fs::path& file) {
  const std::string name = fs::relative(fs::weakly_canonical(file), folder).generic_string();
  if (name == "manifest.json") return;
  const auto listed = manifest.outputs.find(name);
  const std::string rerun =
      "run " + manifest.step + " again, or copy the folder without its manifest.json to use it as your own data";
  if (listed == manifest.outputs.end())
    throw InputError({file.string(), 0, ""}, "is not among the outputs in the manifest of " + manifest.step, rerun);
  if (listed->second != sha256(file))
    throw InputError({file.string(), 0, ""},
                     "was changed after " + manifest.step + " wrote it (its SHA-256 is not the manifest's)", rerun);
}

std::string sha256_of_stream(std::istream& in) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  TWINDECK_ASSERT(context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1);
  std::vector<char> block(1 << 16);
  do {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    TWINDECK_ASSERT(EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(in.gcount())) == 1);
  } while (in);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  TWINDECK_ASSERT(EVP_DigestFinal_ex(context.get(), digest.data(), &length) == 1);
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    constexpr const char* digits = "0123456789abcdef";
    text += digits[digest[i] >> 4];
    text += digits[digest[i] & 15];
  }
  return text;
}

}  // namespace

void write_manifest(const Manifest& manifest, const fs::path& folder) {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["step"] = manifest.step;
  json["status"] = manifest.status;
  json["message"] = manifest.message;
  json["warnings"] = manifest.warnings;
  json["notes"] = manifest.notes;
  if (!manifest.corrections.empty()) json["corrections"] = manifest.corrections;
  json["seed"] = manifest.seed;
  json["threads"] = manifest.threads;
  json["seconds"] = manifest.seconds;
  json["version"] = version();
  json["commit"] = source_commit();
  json["libraries"] = library_versions();
  json["command_line"] = manifest.command_line;
  json["config_toml"] = manifest.config_toml;
  json["inputs"] = manifest.inputs;
  json["outputs"] = manifest.outputs;
  json["columns"] = nlohmann::ordered_json::object();
  for (const auto& [name, hash] : manifest.outputs)
    if (name.ends_with(".csv")) json["columns"][name] = header_of(folder / name);
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;  // a path that is no UTF-8 must not stop the run
  write_file_atomically(folder / "manifest.json", json.dump(2, ' ', false, replace) + "\n");
}

Manifest read_manifest(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  const auto json = parse_ours(file);
  if (!json)
    throw InputError({file.string(), 0, ""}, "is no readable manifest of a step", "run the step that writes this folder");
  try {
    Manifest manifest;
    manifest.step = json->at("step").get<std::string>();
    manifest.status = json->at("status").get<std::string>();
    manifest.message = json->at("message").get<std::string>();
    manifest.seed = json->at("seed").get<std::uint64_t>();
    manifest.threads = json->at("threads").get<int>();
    manifest.seconds = json->at("seconds").get<double>();
    manifest.command_line = json->at("command_line").get<std::vector<std::string>>();
    manifest.config_toml = json->at("config_toml").get<std::string>();
    manifest.inputs = json->at("inputs").get<std::map<std::string, std::string>>();
    manifest.outputs = json->at("outputs").get<std::map<std::string, std::string>>();
    return manifest;
  } catch (const nlohmann::json::exception& error) {
    throw InputError({file.string(), 0, ""}, std::string("does not read as a manifest (") + error.what() + ")",
                     "run the step that writes this folder again");
  }
}

void check_against_manifest(const fs::path& path) {
  const bool is_folder = fs::is_directory(path);
  const auto folder = step_folder(is_folder ? path : fs::absolute(path).parent_path());
  if (!folder) return;
  const Manifest manifest = read_manifest(*folder);
  if (!is_folder) return check_file(manifest, *folder, path);
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) check_file(manifest, *folder, entry.path());
  const std::string below = fs::relative(fs::weakly_canonical(path), *folder).generic_string();
  for (const auto& [name, hash] : manifest.outputs)
    if ((below == "." || name.starts_with(below + "/")) && !fs::exists(*folder / name))
      throw InputError({(*folder / name).string(), 0, ""}, "is gone, though the manifest of " + manifest.step + " lists it",
                       "run " + manifest.step + " again");
}

bool is_step_folder(const fs::path& folder) {
  try {
    return parse_ours(folder / "manifest.json").has_value();
  } catch (const InputError&) {
    return false;
  }
}

std::string sha256(const fs::path& file) {
  require_regular_file(file);  // a pipe would be waited for without an end
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file)) throw InputError({file.string(), 0, ""}, "cannot be opened", "check the path");
  return sha256_of_stream(in);
}

}  // namespace twindeck::io
