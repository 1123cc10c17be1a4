#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace twindeck::records {

/// A place where the time stamps jump against the rows of a file.
struct ClockGap {
  Eigen::Index row = 0;      ///< of the file, from 0: the first row after missing samples, or the first repeated row
  Eigen::Index samples = 0;  ///< positive: missing; negative: repeated rows
};

/// Clock of a record, from its column of time stamps.
struct RecordClock {
  double rate_Hz = 0.0;            ///< slope of the line; 0 if the stamps give no rate
  double deviation_Hz = 0.0;       ///< standard deviation of the rate
  double scatter_s = 0.0;          ///< robust deviation of the stamps from the line
  double shared_by = 1.0;          ///< samples a stamp, on average
  std::vector<ClockGap> gaps;      ///< ascending by row
  Eigen::Index steps_back = -1;    ///< row whose stamp lies before that of the row above by more than the scatter; -1 for none
  Eigen::Index changes_rate = -1;  ///< row from which on another rate holds; -1 for none
  Eigen::Index hour_again = -1;    ///< row at which an hour began a second time, as summer time was over; -1 for none
  bool reversed = false;           ///< the stamps fall from the first to the last
  bool stands_still = false;       ///< all stamps are equal
  [[nodiscard]] Eigen::Index missing() const;   ///< samples in all gaps
  [[nodiscard]] Eigen::Index repeated() const;  ///< rows in all repeats
};

/// Takes the stamp of each row and finds the clock of the record.
///
/// A stamp may be exact, printed with few digits (whole seconds too), shared by several rows (a packet, a coarse clock), or
/// late (jitter, arrival). The model for the first row k of each stamp is
///
///     t_k = t_0 + dt (k + m_k) + e_k,
///
/// where m_k counts the missing samples before it and e_k is bounded and mostly lateness. m steps where the smallest residual
/// of the next W stamps exceeds the smallest of the last W by 0.6 samples and by twenty robust deviations. If rows share
/// stamps, 1.5 samples are needed, because a second may hold one row more or less; or 1.5 packets, if the rows of a stamp vary
/// by packets. Rate and deviation come from a robust line (Tukey's biweight) through t against k + m; the deviation is the
/// larger one of white residuals and of their means in ten blocks, and at least that of the unknown position of a row in a
/// shared stamp. A step back from the end of a day to its begin is midnight, with a date too, and one from the end of 32 bits
/// of ticks their overflow, from the end of an hour to its begin the end of summer time; a time of day as one number (hhmmss)
/// goes on at 59. Memory: sixteen bytes a stamp.
class StampedRows {
 public:
  /// The next row's stamp in any unit; NaN where it has none.
  void add(double stamp);
  /// @param unit_s  [s] of the stamps; 0: not known, then the first of s, ms, us, ns, days that gives 1 to 100,000 Hz
  [[nodiscard]] RecordClock clock(double unit_s) const;
  /// Likely unit of stamps [s] if none is known. @param step  between samples, as stamped @param first  stamp; if it lies in
  /// 1990 to 2090 as a count of 100 ns since the year 1 or 1601 (.NET, Windows), that is the unit
  [[nodiscard]] static double likely_unit_s(double step, double first = 0.0);
  /// How near to a line a column of time lies. Its robust scatter is at most:
  enum class Straight {
    to_a_sample,  ///< one sample, unlike a motion that rises slowly
    to_a_stamp,   ///< the rows of a stamp, if it never falls, and its steps are no last digits of a rounded motion
    roughly,      ///< 5 % of its length, if it never falls
    named         ///< 5 % of its length; it may fall, as late stamps do
  };
  /// Whether a column can be time: it lies near a line but for a few rows (restarts, another rate from some row on, lost stamps
  /// leave a broken clock, no channel) and does not count samples (1, 2, 3 …).
  [[nodiscard]] bool runs_like_time(Straight straight) const;
  /// Whether the stamps rise, except at midnight and at a few jumps.
  [[nodiscard]] bool mostly_rises() const;
  [[nodiscard]] Eigen::Index rows() const { return row_; }
  /// Stamps that differ from the one before.
  [[nodiscard]] std::size_t distinct() const { return stamps_.size(); }

 private:
  struct Stamp {
    Eigen::Index row;
    double time;
  };
  /// Robust scatter about the line [samples]; none if most rows lie about no line.
  /// @param most_set  number of rows at which the clock may be set back @param of_one_rate  not in two parts
  [[nodiscard]] std::optional<double> samples_about_a_line(Eigen::Index most_set, bool of_one_rate = false) const;
  /// Takes all stamps as times of day (hhmmss, hhmmssfff) if the number jumps where a minute ends, but that time does not.
  void take_as_digits(double given);
  std::vector<Stamp> stamps_;  ///< the first row of each
  Eigen::Index row_ = 0, without_ = 0, falls_ = 0, hour_again_ = -1;
  double begun_ = 0.0, last_ = 0.0;  ///< sum of the periods that are over; last stamp
  double period_ = 0.0;              ///< of the clock, once it has begun anew
  double digits_ = 0.0;              ///< of one second in stamps hhmmss (1) and hhmmssfff (1000); 0 for other stamps
  bool counts_ = true;
};

}  // namespace twindeck::records
