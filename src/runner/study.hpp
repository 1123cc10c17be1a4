#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace twindeck::runner {

/// Content of `workflows/<study>/study.toml`. Paths are relative to the current folder (the root of the repository).
struct Study {
  std::string title;
  std::uint64_t seed = 1;              ///< default of each step's --seed
  std::string measured = "published";  ///< "published" | "virtual": where the measured modes come from
  std::string model_generator;         ///< [model] generator = "ponte", together with `file`
  std::filesystem::path model_file;    ///< [model] file: what the generator reads
  std::string model_mesh;              ///< [model] mesh: one of the generator's meshes by name; "": its own
  std::filesystem::path model_folder;  ///< [model] folder: a model folder, instead of a generator
  std::filesystem::path model_inp;     ///< [model] inp: a file of CalculiX or Abaqus
  std::filesystem::path features;      ///< folder of measured features (rows.csv, conditions.toml, channels.csv)
  std::vector<std::string> steps;      ///< tokens in the order in which they run
};

/// Reads `folder/study.toml`.
/// @throws InputError  if the file is missing or wrong, or if it names more than one of a generator with its file, a folder, an
/// .inp file. A study of records alone names none; steps that need a model then report it.
[[nodiscard]] Study read_study(const std::filesystem::path& folder);

/// Meaning, unit, range and default of each key of study.toml.
[[nodiscard]] std::string describe_study();

}  // namespace twindeck::runner
