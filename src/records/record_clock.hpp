#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace twindeck::records {

/// A place where the time stamps and the rows of a file part.
struct ClockGap {
  Eigen::Index row = 0;      ///< of the file, from 0: samples are missing before it, or it is the first that is there twice
  Eigen::Index samples = 0;  ///< positive: missing; negative: rows whose time was there before
};

/// What a column of time stamps says of a record.
struct RecordClock {
  double rate_Hz = 0.0;            ///< slope of the line; 0 where the stamps say none
  double deviation_Hz = 0.0;       ///< standard deviation of the rate
  double scatter_s = 0.0;          ///< robust deviation of the stamps from the line
  double shared_by = 1.0;          ///< samples a stamp, on average
  std::vector<ClockGap> gaps;      ///< ascending by row
  Eigen::Index steps_back = -1;    ///< row whose stamp lies before its predecessor's beyond all scatter; -1 for none
  Eigen::Index changes_rate = -1;  ///< row from which on another rate holds; -1 for none
  bool reversed = false;           ///< the stamps fall from the first to the last
  bool stands_still = false;       ///< all stamps are one
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
/// where m_k counts the missing samples before it and e_k is bounded and mostly lateness. Steps of m are where the smallest
/// residual of the next W stamps lies above the smallest of the last W by more than half a sample (one and a half where rows
/// share stamps, so that one row more or less in a second is none) and more than twenty of its own robust deviations. Rate and
/// deviation come from a robust line (Tukey's biweight) through t against k + m; the deviation is the larger of white
/// residuals' and of their means in ten blocks, and at least what one row's place in a shared stamp leaves open.
/// A step back from the end of a day to its begin is midnight. Memory: sixteen bytes a stamp.
class StampedRows {
 public:
  /// The next row's stamp in any unit; NaN where it has none.
  void add(double stamp);
  /// @param unit_s  [s] of the stamps; 0: not known, then the first of s, ms, us, ns, days that gives 1 to 100,000 Hz
  [[nodiscard]] RecordClock clock(double unit_s) const;
  /// That unit, where none is known. @param step  between samples, as stamped @param first  stamp: one of the last decades'
  /// 100 ns since the year 1 or 1601 (ticks of .NET, times of Windows) tells its unit
  [[nodiscard]] static double likely_unit_s(double step, double first = 0.0);
  /// What an unnamed column must do to be time: it never falls, lies near a line and does not count samples (1, 2, 3 …).
  /// @param evenly  it scatters about the line by no more than a sample, as a slow motion that rises does not
  [[nodiscard]] bool runs_like_time(bool evenly = false) const;
  /// The stamps never fell, but for midnight and a few jumps.
  [[nodiscard]] bool mostly_rises() const;
  [[nodiscard]] Eigen::Index rows() const { return row_; }
  /// Stamps that differ from the one before.
  [[nodiscard]] std::size_t distinct() const { return stamps_.size(); }

 private:
  struct Stamp {
    Eigen::Index row;
    double time;
  };
  std::vector<Stamp> stamps_;  ///< the first row of each
  Eigen::Index row_ = 0, without_ = 0, falls_ = 0;
  double midnight_ = 0.0, last_ = 0.0;
  bool counts_ = true;
};

}  // namespace twindeck::records
