#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/samples.hpp"
#include "identification/lone_sample.hpp"

namespace twindeck::identification {

/// A record that is sound as a file, but cannot be identified: too short, a dead or clipped channel, a long gap. Where the step
/// has other records it goes on without this one, and says so.
class UnusableRecord : public InputError {
 public:
  using InputError::InputError;
};

/// A record whose channel cannot be what it says; where all records of a setup have it, the channel may be left out.
class LyingChannel : public UnusableRecord {
 public:
  using UnusableRecord::UnusableRecord;
};

/// What is wrong with a channel of a record as it was read.
struct ChannelQuality {
  std::string setup, record, channel;
  long samples = 0;
  long missing = 0;                        ///< samples that are NaN
  long longest_gap = 0;                    ///< longest run of them
  long clipped = 0;                        ///< samples at the record's largest or smallest value (clipped_samples)
  double mean = 0.0, rms = 0.0;            ///< [channel's unit]; rms about the mean
  double drift = 0.0;                      ///< change of the fitted straight line from begin to end, in units of the rms
  bool dead = false;                       ///< constant
  std::optional<LoneSample> lone;          ///< the sample that stands furthest off, alone
  std::string left_out;                    ///< why the channel is not used, "" where it is
  std::optional<double> lag_s, lag_std_s;  ///< of its clock behind the first channel's, where it could be told
};

/// @param data (n_samples × n_channels) NaN where missing @param channels  names of the columns
[[nodiscard]] std::vector<ChannelQuality> channel_quality(const Samples& data, const std::vector<std::string>& channels,
                                                          const std::string& setup, const std::string& record);

/// Bridges gaps of at most `longest` samples by a straight line. @return samples filled
/// @throws UnusableRecord  naming channel and sample if a longer gap is left, or one at an end of the record
long fill_gaps(Eigen::MatrixXd& data, const std::vector<std::string>& channels, long longest, const std::string& record);

}  // namespace twindeck::identification
