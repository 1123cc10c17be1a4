#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "records/record.hpp"

namespace twindeck::records {

/// Summary of a channel's samples.
struct ChannelSummary {
  Eigen::Index samples = 0, missing = 0, longest_gap = 0;
  Eigen::Index clipped = 0;  ///< samples in runs of three or more at the largest or smallest value
  double mean = 0.0, rms = 0.0, lowest = 0.0, highest = 0.0;  ///< rms about the mean
  bool dead = false;                                          ///< constant
};

/// Sums over one channel as its samples come, in bounded memory.
class ChannelStatistics {
 public:
  void add(double value);
  /// Summary of `count` samples; those that were not added count as missing.
  [[nodiscard]] ChannelSummary summary(Eigen::Index count) const;

 private:
  Eigen::Index there_ = 0, seen_ = 0, gap_ = 0, longest_gap_ = 0;
  double mean_ = 0.0, squares_ = 0.0, lowest_ = 0.0, highest_ = 0.0, last_ = 0.0;
  Eigen::Index run_ = 0;                         ///< length of the last run of equal values
  Eigen::Index at_lowest_ = 0, at_highest_ = 0;  ///< samples in runs of three or more there
  void close_run();
};

struct Inspection {
  RecordInfo info;
  std::vector<ChannelSummary> channels;
};
/// One pass through the file.
[[nodiscard]] Inspection inspect(const std::filesystem::path& file);

/// The inspection for people: format, rate and where it comes from, channels with unit (or a guess from the size of the
/// numbers), gaps, clipping, dead channels, what is missing for an identification.
[[nodiscard]] std::vector<std::string> describe(const Inspection& inspection);

}  // namespace twindeck::records
