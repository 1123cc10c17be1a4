#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/samples.hpp"
#include "identification/state_space.hpp"

namespace twindeck::identification {

/// Tells lines of periodic forces (machines, pumps, generators) from modes.
struct PeriodicRule {
  /// [-] largest |damping ratio| of a line's pole. A line has none; its estimate scatters to either side of zero. Structures
  /// have 0.2 % and more.
  double largest_damping = 0.001;
  /// [-] largest damping ratio of the pole that remains after a line was taken out. Because the speed of a machine varies, the
  /// part that does not follow the line's phase remains.
  double largest_leftover = 0.002;
  double largest_spread = 0.001;  ///< [-] relative distance of neighbouring poles of one line, which repeats at all orders
  double share = 0.3;             ///< [-] least share of the orders at which a line is found
  /// [-] largest E|a|⁴ / (E|a|²)² of the envelope a in a narrow band around it: 1 for a steady line, 2 for normal noise or a
  /// mode.
  double largest_kurtosis = 1.3;
  /// [-] largest kurtosis of a multiple of a known line, which needs weaker evidence
  double largest_kurtosis_of_multiple = 1.5;
  double multiple = 0.001;  ///< [-] largest relative distance from a multiple
  /// [-] least power that follows a multiple of a line's phase, over the median power beside it
  double least_prominence = 20.0;
};

/// A line, or a candidate for one.
struct PeriodicLine {
  double frequency_Hz = 0.0;   ///< median over the orders
  double damping_ratio = 0.0;  ///< median over the orders [-]
  Eigen::VectorXcd shape;      ///< (n_outputs) of the highest order: how the structure moves at this frequency; no mode shape
  double kurtosis = 0.0;       ///< [-] E|a|⁴ / (E|a|²)²
  int multiple = 1;            ///< number of the multiple of the lowest line; 1 for that line
};

/// Poles with almost no damping, also negative, that recur over the orders.
/// @param poles  one list an order @return ascending in frequency; kurtosis not known yet
[[nodiscard]] std::vector<PeriodicLine> undamped_poles(const std::vector<std::vector<Pole>>& poles, double lowest_Hz,
                                                       double highest_Hz, const PeriodicRule& rule);

/// Selects the candidates that are lines of a periodic force. The records are projected on the candidate's shape and filtered
/// to a narrow band. The amplitude of a line is steady there; that of a mode or of noise has the normal law's kurtosis.
/// @param records  (n_samples × n_outputs) each @return ascending in frequency, multiples numbered
/// Reference: Jacobsen, Andersen and Brincker (2007), IOMAC 2 (harmonics by the kurtosis of the filtered signal).
[[nodiscard]] std::vector<PeriodicLine> periodic_lines(const std::vector<PeriodicLine>& candidates,
                                                       const std::vector<Samples>& records, double rate_Hz,
                                                       const PeriodicRule& rule);

/// Takes the lines out of the records, and finds lines that belong to them: multiples, the half and the third (a machine's own
/// speed is often its weakest line). The phase of a line is read from all channels together, in a narrow band around it. The
/// part of each channel that follows this phase, its multiple or its fraction is subtracted by least squares. These are two
/// numbers a channel, so that modes near the line are hardly changed. If a line of constant frequency leaves less, it is
/// subtracted instead, and the ends distorted by decimation are cut. A multiple counts as a line if its power stands out from
/// that at frequencies somewhat above and below.
/// @param records  (n_samples × n_outputs) each, changed, some shorter @param lowest_Hz, highest_Hz  of a line that is found
/// @return the lines and those found with them, ascending in frequency, multiples numbered
[[nodiscard]] std::vector<PeriodicLine> without_lines(std::vector<Samples>& records, const std::vector<PeriodicLine>& lines,
                                                      double rate_Hz, double lowest_Hz, double highest_Hz,
                                                      const PeriodicRule& rule);

}  // namespace twindeck::identification
