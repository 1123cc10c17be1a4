#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "steps/diagnosis/setup.hpp"

/// Thresholds of null data sets, kept in a folder: they take minutes to make and depend on the model, the rows (without their
/// values), the catalogue and the rules alone. One file each, named by the hash of all that.
namespace twindeck::steps {

/// What a threshold depends on, in words. Numbers that were computed have six digits, so that rounding changes no name.
[[nodiscard]] std::string threshold_key(const DiagnosisConfig& config, const DiagnosisInputs& inputs,
                                        const diagnosis::Inference& inference, std::uint64_t seed);

/// "<folder>/0f3a….toml", by the key's SHA-256.
[[nodiscard]] std::filesystem::path threshold_file(const std::filesystem::path& folder, const std::string& key);

/// The threshold [nats] that is kept in a file, or nothing where the file is not there.
/// @throws InputError  if the file is not as write_threshold wrote it for this key: a number that was changed, or is none
[[nodiscard]] std::optional<double> read_threshold(const std::filesystem::path& file, const std::string& key);

/// Keeps a threshold with its key's hash, the number of null data sets and a check sum.
void write_threshold(double threshold, long nulls, double quantile, const std::filesystem::path& file, const std::string& key);

}  // namespace twindeck::steps
