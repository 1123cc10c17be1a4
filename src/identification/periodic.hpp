#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/samples.hpp"
#include "identification/state_space.hpp"

namespace twindeck::identification {

/// Lines of periodic forces (machines, pumps, generators) in a record: no modes.
struct PeriodicRule {
  /// [-] largest |damping ratio| of a line's pole. A line has none; its estimate scatters to either side of zero. Structures
  /// have 0.2 % and more.
  double largest_damping = 0.001;
  /// [-] largest damping ratio of the pole that is left where a line was taken out: a machine's speed wanders, and what does
  /// not turn with the line's phase stays.
  double largest_leftover = 0.002;
  double largest_spread = 0.001;  ///< [-] relative distance of neighbouring poles of one line, which repeats at all orders
  double share = 0.3;             ///< [-] least share of the orders that a line is found at
  /// [-] largest E|a|⁴ / (E|a|²)² of the envelope a in a narrow band around it: 1 for a steady line, 2 for normal noise or a
  /// mode.
  double largest_kurtosis = 1.3;
  /// [-] the same where the frequency is a multiple of a line that is already found: prior knowledge, weaker evidence.
  double largest_kurtosis_of_multiple = 1.5;
  double multiple = 0.001;  ///< [-] relative distance from a multiple
  /// [-] least power of what turns with a multiple of a line's phase, over the median of what turns beside it
  double least_prominence = 20.0;
};

/// A line, or a candidate for one.
struct PeriodicLine {
  double frequency_Hz = 0.0;   ///< median over the orders
  double damping_ratio = 0.0;  ///< median over the orders [-]
  Eigen::VectorXcd shape;      ///< (n_outputs) of the highest order: how the structure moves at this frequency; no mode shape
  double kurtosis = 0.0;       ///< [-] E|a|⁴ / (E|a|²)²
  int multiple = 1;            ///< of the lowest line that it is a multiple of
};

/// Poles with next to no damping, also below zero, that recur over the orders.
/// @param poles  one list an order @return ascending in frequency; kurtosis not known yet
[[nodiscard]] std::vector<PeriodicLine> undamped_poles(const std::vector<std::vector<Pole>>& poles, double lowest_Hz,
                                                       double highest_Hz, const PeriodicRule& rule);

/// Which candidates are lines of a periodic force. The records are projected on the candidate's shape and filtered to a narrow
/// band. The amplitude of a line is steady there; that of a mode or of noise has the normal law's kurtosis.
/// @param records  (n_samples × n_outputs) each @return ascending in frequency, multiples numbered
/// Reference: Jacobsen, Andersen and Brincker (2007), IOMAC 2 (harmonics by the kurtosis of the filtered signal).
[[nodiscard]] std::vector<PeriodicLine> periodic_lines(const std::vector<PeriodicLine>& candidates,
                                                       const std::vector<Samples>& records, double rate_Hz,
                                                       const PeriodicRule& rule);

/// Takes the lines out of the records, and finds what belongs to them: multiples, and the half and the third of which they are
/// multiples (a machine's own speed is often its weakest line). The turning phase of a line is read in a narrow band around it
/// from all channels together. Of each channel the part that turns with this phase, or with a multiple or a part of it, is
/// subtracted by least squares: two numbers a channel, so that modes near the line keep what is theirs. Where a phase that
/// turns evenly leaves less, it is taken instead, and the record loses the ends that a decimating filter bends. A multiple
/// counts as a line if what turns with it stands out from what turns somewhat faster and slower.
/// @param records  (n_samples × n_outputs) each, changed, some shorter @param lowest_Hz, highest_Hz  of a line that is found
/// @return the lines and those found with them, ascending in frequency, multiples numbered
[[nodiscard]] std::vector<PeriodicLine> without_lines(std::vector<Samples>& records, const std::vector<PeriodicLine>& lines,
                                                      double rate_Hz, double lowest_Hz, double highest_Hz,
                                                      const PeriodicRule& rule);

}  // namespace twindeck::identification
