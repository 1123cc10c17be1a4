#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/samples.hpp"

namespace twindeck::identification {

/// A sample that no motion explains: an error value of the recorder, a bit that flipped.
struct LoneSample {
  Eigen::Index sample = 0;
  double value = 0.0;
  double deviations = 0.0;   ///< distance from the channel's median in robust standard deviations (1.4826 times the median of
                             ///< absolute distances)
  Eigen::Index samples = 1;  ///< in a row
};

/// The sample furthest from the median among those that stand alone: up to three values in a row, each perhaps held for
/// several samples, whose neighbours on both sides are
/// within a twentieth of its distance, the first ones as well as the median of ten. The motion of a structure does not stand
/// alone: a free decay follows an impact, an earthquake lasts, and the anti-aliasing filter spreads a pulse over neighbouring
/// samples.
/// @param x  NaN or infinite where missing
/// @return none where no sample stands alone more than ten robust deviations off
[[nodiscard]] std::optional<LoneSample> lone_sample(const Eigen::Ref<const Eigen::VectorXd>& x);

/// A record that is sound as a file, but cannot be identified: too short, a dead or clipped channel, a long gap. Where the step
/// has other records it goes on without this one, and says so.
class UnusableRecord : public InputError {
 public:
  using InputError::InputError;
};

/// A record with a channel that cannot be a measurement. If all records of a setup have it, the channel may be left out.
class LyingChannel : public UnusableRecord {
 public:
  using UnusableRecord::UnusableRecord;
};

/// What is wrong with a channel of a record as it was read.
struct ChannelQuality {
  std::string setup, record, channel;
  long samples = 0;
  long missing = 0;                        ///< samples that are NaN
  long longest_gap = 0;                    ///< longest run of missing samples
  long held = 1;                           ///< samples in which each value stands (held_samples)
  long clipped = 0;                        ///< samples at the record's largest or smallest value (clipped_samples)
  double mean = 0.0, rms = 0.0;            ///< [channel's unit]; rms about the mean
  double drift = 0.0;                      ///< change of the fitted straight line from begin to end, in units of the rms
  bool dead = false;                       ///< constant
  std::optional<LoneSample> lone;          ///< the farthest sample that stands alone
  std::string left_out;                    ///< why the channel is not used, "" where it is
  std::optional<double> lag_s, lag_std_s;  ///< lag of its clock behind the first channel's; empty if unknown
};

/// Number of samples for which a channel holds each of its values, as a slow channel in the table of a faster one does; 1 if
/// its values change at any sample, however rarely.
[[nodiscard]] long held_samples(const Eigen::Ref<const Eigen::VectorXd>& x);

/// @param data (n_samples × n_channels) NaN where missing @param channels  names of the columns
[[nodiscard]] std::vector<ChannelQuality> channel_quality(const Samples& data, const std::vector<std::string>& channels,
                                                          const std::string& setup, const std::string& record);

/// Bridges gaps of at most `longest` samples by a straight line. @return samples filled
/// @throws UnusableRecord  naming channel and sample if a longer gap is left, or one at an end of the record
long fill_gaps(Eigen::MatrixXd& data, const std::vector<std::string>& channels, long longest, const std::string& record);

/// Samples at which a channel was driven past its range: those in runs of three or more at its largest or smallest value; and
/// all at such a value, in runs or not, where it holds far more samples than the values next to it. A slow channel stays at its
/// rail for several samples, a fast one comes back at once.
///
/// The second count finds a feature that no sound record has. In a continuous record the extreme value occurs once. With coarse
/// counts every value has many samples, but the extreme one no more than its neighbours: the tails of noise fall off, and a
/// sine has at its crest at most 1/(sqrt(2) - 1) = 2.4 times as many samples as one count below. Records of fewer than a dozen
/// values are judged by their runs alone.
/// @param x  NaN or infinite where missing @param lowest @param highest  of the samples that are there, lowest < highest
[[nodiscard]] long clipped_samples(const Eigen::Ref<const Eigen::VectorXd>& x, double lowest, double highest);

}  // namespace twindeck::identification
