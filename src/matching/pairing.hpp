#pragma once

#include <Eigen/Core>
#include <vector>

#include "modal/modes.hpp"

namespace twindeck::matching {

/// A pair of an experimental and a numerical mode (0-based positions in their sets).
struct ModePair {
  Eigen::Index experimental = 0;
  Eigen::Index numerical = 0;
  double mac = 0.0;        ///< NaN where no shape is known
  bool clustered = false;  ///< paired as a member of a subspace of close modes
};

struct PairingOptions {
  double minimum_mac = 0.0;               ///< pairs below it are left out
  double maximum_frequency_error = 0.35;  ///< relative; larger errors of frequency are not admitted
  double cluster_gap = 0.02;              ///< relative frequency gap below which modes count as close
  double cluster_mac = 0.8;               ///< least MAC of a shape that is like a close mode, or lies in the span of several
};

/// Positions of modes, the lowest frequency first; equal ones in their order.
[[nodiscard]] std::vector<Eigen::Index> lowest_first(const Eigen::VectorXd& frequency);

/// Whether a measured shape can be told from others: at a single channel any two shapes have a MAC of 1.
/// @param measured (n_sensors), NaN where the mode was not measured
[[nodiscard]] bool has_a_shape(const Eigen::Ref<const Eigen::VectorXcd>& measured);

/// How like each other the modes of two sets are.
struct Likeness {
  Eigen::MatrixXd value;  ///< [-] (n_X × n_N) MAC, or the subspace MAC where `clustered`; NaN where no shape is known
  Eigen::MatrixXd gain;   ///< [-] (n_X × n_N) what a pair adds to the sum that the pairing maximises
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> clustered;  ///< (n_X × n_N) see pair_by_likeness
};

/// Close numerical modes can rotate into each other. An experimental shape that is like none of them by itself (`cluster_mac`)
/// may lie within the span of such a cluster. Its pairs with the members are then `clustered`, and get the subspace MAC,
/// |P phi_x|²/|phi_x|², P the projection on that span. A shape that is like one member keeps its own MACs. A mode without a
/// shape (no sensors, or measured at one of them: has_a_shape) has a gain by its frequency alone, and its MAC is NaN.
/// @param frequency_x, frequency_n [Hz]
/// @param phi_x (n_sensors × n_X), NaN where a mode was not measured; phi_n (n_sensors × n_N)
[[nodiscard]] Likeness likeness_of(const Eigen::VectorXd& frequency_x, const Eigen::MatrixXcd& phi_x,
                                   const Eigen::VectorXd& frequency_n, const Eigen::MatrixXcd& phi_n,
                                   const PairingOptions& options);

/// One-to-one pairing that maximises the sum of MAC over admissible pairs (Hungarian assignment, not greedy). A mode may stay
/// unpaired. Where shapes decide nothing, the nearer frequency does.
/// @param frequency_x, frequency_n [Hz] @param likeness  of these modes
/// @return pairs in the order of the experimental modes
/// Reference: Kuhn (1955), Naval Research Logistics Quarterly 2, 83-97.
[[nodiscard]] std::vector<ModePair> pair_by_likeness(const Eigen::VectorXd& frequency_x, const Eigen::VectorXd& frequency_n,
                                                     const Likeness& likeness, const PairingOptions& options);

/// Mode tracking: for each reference mode its position in a changed model. The one-to-one assignment maximises the sum of
/// `mac` (n_ref × n_new). @return (n_ref), -1 for a reference mode without a partner
[[nodiscard]] std::vector<int> follow_modes(const Eigen::Ref<const Eigen::MatrixXd>& mac);

/// One-to-one assignment of rows to columns with the largest sum of gains (Hungarian algorithm with potentials, O(r² c)).
/// @param gain  [-] (n_rows × n_columns), finite
/// @return (n_rows) column of each row; -1 for rows without a column (if there are more rows than columns)
/// References: Kuhn (1955), Naval Research Logistics Quarterly 2, 83-97; Jonker and Volgenant (1987), Computing 38, 325-340.
[[nodiscard]] std::vector<int> best_assignment(const Eigen::Ref<const Eigen::MatrixXd>& gain);

}  // namespace twindeck::matching
