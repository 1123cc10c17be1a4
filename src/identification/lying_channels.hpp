#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/samples.hpp"
#include "identification/quality.hpp"

namespace twindeck::identification {

/// [-] RMS below the resolution of any converter (160 dB), for a motion of RMS 1.
constexpr double kUnresolved = 1e-8;

/// Channels of a record to be judged.
struct JudgedChannels {
  std::vector<Eigen::Index> columns;  ///< of the record: responses that are used
  std::vector<double> gain;           ///< of each, from recorded to physical values
  std::vector<bool> reference;        ///< of each
  bool may_rest = false;              ///< a free decay or an earthquake: all channels may rest before it begins
};

/// Finds channels that cannot be measurements and writes the reason into ChannelQuality::left_out:
///   dead   constant, or without motion: its RMS is below kUnresolved of the channels' median
///   count  each sample is one more than the last: a counter of rows
///   stuck  one value for over 5 % of the record, or 1 % and far above other runs (where all may rest: while most others move)
///   copy   sample by sample the recorded values of another channel, times a factor plus an offset too, within what is
///          resolved, which two sensors never give; a reference is the original. Of a free decay, a sine, and where
///          all channels are in proportion, the same values alone
/// @param raw  (n_samples × channels of the record), gains applied
void judge_channels(const Samples& raw, const JudgedChannels& judged, std::vector<ChannelQuality>& quality);

}  // namespace twindeck::identification
