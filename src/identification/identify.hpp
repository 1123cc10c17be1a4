#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/samples.hpp"
#include "identification/automatic.hpp"
#include "identification/clustering.hpp"
#include "identification/periodic.hpp"
#include "identification/uncertainty.hpp"
#include "signal/correlation.hpp"

namespace twindeck::identification {

enum class Selection {
  automatic,  ///< automatic_clusters
  paper       ///< Eqs. (3)-(4): identify_clusters
};

struct IdentifyOptions {
  Eigen::Index block_rows = 30;
  long minimum_order = 2, maximum_order = 60, order_step = 2;
  StabilisationCriteria criteria;
  PoleLimits limits;
  Selection selection = Selection::automatic;
  CleaningRule cleaning;
  AutomaticRule automatic;
  PeriodicRule periodic;
  /// A cluster whose frequency has a relative standard deviation above this is dropped: its pole recurs over the model orders,
  /// but the data do not determine it. In the automatic selection of an ambient record, three times the lower limit (see below)
  /// is allowed if that is more. 0 keeps all (the rule as printed in the paper).
  double largest_deviation = 0.01;
  /// Automatic selection: a mode of an ambient record is dropped if the standard deviation of its unit-norm shape, across
  /// itself, exceeds this. At 0.6 its MAC with the true shape is about 0.7, and one of two close modes cannot be distinguished
  /// from a mixture of both. 0 keeps all. It is also dropped if its shape is not collinear (AutomaticRule::collinearity) and
  /// the deviation alone can explain this.
  double largest_shape_deviation = 0.6;
  /// Automatic selection: a mode of an ambient record is dropped if the standard deviation of its frequency exceeds this many
  /// times
  ///     f sqrt(zeta / (2 pi N_c)),   N_c the cycles in the record,
  /// the lower limit for a record of this length (Au 2014): such a mode hardly contributes to the motion. It is also dropped if
  /// its damping ratio is below its standard deviation, unless that is within three times the lower limit. 0 keeps all.
  double largest_law_ratio = 10.0;
  /// Automatic selection: a mode is dropped if the standard deviation of its frequency exceeds this share of the half bandwidth
  /// zeta f. In a record, three times the lower limit is allowed if that is more, because few cycles determine no mode better.
  /// In a decay, a mode is also dropped if its damping ratio may be zero. 0 keeps all.
  double largest_bandwidth_share = 0.5;

  [[nodiscard]] std::vector<int> orders() const;
};

struct Identification {
  std::vector<DiagramPole> diagram;
  std::vector<Cluster> modes;  ///< ascending in frequency
  /// One per mode. For frequency and damping: root of the sum of the data's variance (`factor`) and the variance over the model
  /// orders. Empty if the covariance is unknown (a single block).
  std::vector<ModeDeviation> deviations;
  /// Recurring poles without damping: of ambient records the candidates of `mark_periodic`, after it the lines of periodic
  /// forces.
  std::vector<PeriodicLine> periodic;
};

/// The stabilisation diagram of poles and the modes that the options select in it, without deviations.
/// @param poles  one list an order, of the same channels @param orders  theirs, ascending
[[nodiscard]] Identification modes_of_poles(const std::vector<std::vector<Pole>>& poles, const std::vector<int>& orders,
                                            const IdentifyOptions& options);

/// Covariance-driven identification of output-only records: correlations to subspace to poles of all orders, stabilisation
/// diagram, selection, clusters, standard deviations.
/// @param blocks  correlations of lags 0 … 2 block_rows - 1 of the conditioned records @param rate_Hz  their sampling rate
/// @throws InputError  if there are too few block rows for the largest order
[[nodiscard]] Identification identify(const signal::BlockCorrelations& blocks, double rate_Hz, const IdentifyOptions& options);

/// The same, data-driven. @param records conditioned, one rate @param blocks  of the same records, for the standard deviations
[[nodiscard]] Identification identify_from_data(const std::vector<Samples>& records,
                                                const std::vector<Eigen::Index>& references,
                                                const signal::BlockCorrelations& blocks, double rate_Hz,
                                                const IdentifyOptions& options);

/// The same, of free decays by ERA. @param decays (n_samples × n_outputs) of one length, from the release on
/// @param quiet  records of the disturbance, see era
[[nodiscard]] Identification identify_decays(const std::vector<Eigen::MatrixXd>& decays, double rate_Hz,
                                             const IdentifyOptions& options, std::uint64_t seed,
                                             const std::vector<Eigen::MatrixXd>& quiet = {});

/// Tells lines of periodic forces from modes: `periodic` keeps the candidates that the records show to be lines. Modes at such
/// a frequency are dropped, unless their damping exceeds that of a removed line.
/// @param records  those identified (n_samples × n_outputs), channels scaled alike
/// @param known  lines that are no longer in these records; they stay in `periodic`
void mark_periodic(Identification& result, const std::vector<Samples>& records, double rate_Hz, const PeriodicRule& rule,
                   const std::vector<PeriodicLine>& known = {});

/// Drops the modes of each setup that are lines in another setup, because a machine runs during all of them.
void drop_lines_of_others(const std::vector<Identification*>& setups, const PeriodicRule& rule);

/// Drops modes, with their deviations and marks in the diagram. @param stays  false: the mode is dropped
void keep_modes(Identification& result, const std::vector<bool>& stays);
/// Drops the modes for whose position `stays` is false. All are asked before the first is dropped.
template <typename Stays>
void keep_modes_where(Identification& result, const Stays& stays) {
  std::vector<bool> kept;
  for (std::size_t m = 0; m < result.modes.size(); ++m) kept.push_back(stays(m));
  keep_modes(result, kept);
}

/// Drops the modes that the data do not determine, by the rules of the options. The automatic selection then drops mixtures of
/// two other modes. Of two modes that the data cannot distinguish it drops the one with the larger standard deviation:
/// frequencies within three standard deviations of their difference, and shapes that differ no more than two estimates of one
/// shape. Each mode must have its deviation.
/// @param seconds  length of the ambient records; 0: free decays
void drop_undetermined(Identification& result, const IdentifyOptions& options, double seconds);

/// Drops poles of a single free decay that may be noise. The largest of n samples of noise reaches sqrt(2 ln n) standard
/// deviations (Donoho and Johnstone 1994); a mode's damping ratio must exceed as many of its own.
/// @return what was dropped, in words
std::vector<std::string> drop_noise_of_a_decay(Identification& result, Eigen::Index samples);

/// Drops modes of an ambient record with smaller deviations than random forces allow: below the lower limit of IdentifyOptions
/// by more than chance. The uncertainty of a deviation follows from the number of blocks (columns of the factor); with twenty
/// blocks the threshold is half the limit. Such a pole follows a periodic force, for example a machine whose speed varies too
/// much to be marked as a line. If half of the modes or more are below, the forces of the record are not random (fans, one
/// shaker), and none is dropped.
/// @param seconds  length of the ambient records
void drop_better_than_random(Identification& result, double seconds);

}  // namespace twindeck::identification
