#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/samples.hpp"

namespace twindeck::identification {

/// A stretch of samples that a setup has twice.
struct RepeatedRows {
  std::string file;                               ///< file with the first occurrence
  Eigen::Index first = 0, again = 0, length = 0;  ///< [samples] begin in that file, begin of the repeat, length
};

/// Finds the samples that the records of a setup hold twice, all channels alike and exactly: a file listed as a copy of
/// another, a record appended to itself, an export that overlaps the next. Ambient vibration never repeats itself; counted
/// twice, it makes deviations too small. A signal that repeats itself over and over is periodic, and channels at rest are no
/// repeat. Memory: eight bytes a sample of a record, whatever its number of channels.
class RowsSeen {
 public:
  /// The longest stretch of the next record that was there before, if it takes a hundredth of the record and 64 samples.
  /// @param raw  (n_samples × n_channels), the same channels in each record
  [[nodiscard]] std::optional<RepeatedRows> add(const Samples& raw, const std::string& file);

 private:
  struct Place {
    std::size_t record = 0;
    Eigen::Index row = 0;
  };
  std::vector<std::string> files_;
  std::vector<std::vector<std::uint64_t>> rows_;      ///< a hash of each row of each record
  std::unordered_map<std::uint64_t, Place> windows_;  ///< by their hash
};

}  // namespace twindeck::identification
