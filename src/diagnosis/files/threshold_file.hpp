#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"

/// Thresholds of null data sets, kept in a folder: they take minutes to make and depend on the model, the rows (without their
/// values), the catalogue and the rules alone. One file each, named by the hash of all that.
namespace twindeck::diagnosis {

/// What of the configuration a threshold depends on.
struct ThresholdRules {
  double alpha = 0.0;  ///< false alarms that the threshold allows
  long nulls = 0;      ///< data sets
  long modes = 0;      ///< in the reduced basis
  long most_refined = 0;
  double refine_within = 0.0;  ///< [nats]
  ScatterOptions scatter;
  std::vector<std::string> pairs;
};

/// What a threshold depends on, in words. Numbers that were computed have six digits, so that rounding changes no name.
[[nodiscard]] std::string threshold_key(const ThresholdRules& rules, const ReducedModel& model, const FeatureSet& features,
                                        const std::vector<Hypothesis>& catalogue, const Inference& inference,
                                        std::uint64_t seed);

/// "<folder>/0f3a….toml", by the key's SHA-256.
[[nodiscard]] std::filesystem::path threshold_file(const std::filesystem::path& folder, const std::string& key);

/// The threshold [nats] that is kept in a file, or nothing where the file is not there.
/// @throws InputError  if the file is not as write_threshold wrote it for this key: a number that was changed, or is none
[[nodiscard]] std::optional<double> read_threshold(const std::filesystem::path& file, const std::string& key);

/// Keeps a threshold with its key's hash, the number of null data sets and a check sum.
void write_threshold(double threshold, long nulls, double quantile, const std::filesystem::path& file, const std::string& key);

}  // namespace twindeck::diagnosis
