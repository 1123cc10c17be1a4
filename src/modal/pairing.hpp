#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "modal/modes.hpp"

namespace twindeck::modal {

/// A pair of an experimental and a numerical mode (0-based positions in their sets).
struct ModePair {
  Eigen::Index experimental = 0;
  Eigen::Index numerical = 0;
  double mac = 0.0;        ///< NaN where no shape is known
  bool clustered = false;  ///< paired as a member of a subspace of close modes
};

struct PairingOptions {
  double minimum_mac = 0.0;               ///< pairs below it are left out
  double maximum_frequency_error = 0.35;  ///< relative; a pair further off is not admitted
  double cluster_gap = 0.02;              ///< relative frequency gap below which modes count as close
  double cluster_mac = 0.8;               ///< subspace MAC from which a shape counts as lying in the span of close modes
};

/// One-to-one pairing that maximises the sum of MAC (Hungarian assignment, not greedy), admissible pairs only; a mode may stay unpaired. Close numerical
/// modes that rotate into each other are recognised by their subspace: a pair of low MAC whose experimental shape lies within
/// the span of a cluster is marked `clustered` with the subspace MAC, |P phi_x|²/|phi_x|², P the projection on that span.
/// Without sensors (no rows) the pairing is by frequency alone, and MAC is NaN.
/// @return pairs in the order of the experimental modes
/// @param frequency_x, frequency_n [Hz]
/// @param phi_x (n_sensors × n_X), NaN where a mode was not measured; phi_n (n_sensors × n_N)
/// Reference: Kuhn (1955), Naval Research Logistics Quarterly 2, 83-97.
[[nodiscard]] std::vector<ModePair> pair_by_mac(const Eigen::VectorXd& frequency_x, const Eigen::MatrixXcd& phi_x,
                                                const Eigen::VectorXd& frequency_n, const Eigen::MatrixXcd& phi_n,
                                                const PairingOptions& options = {});

/// Follows reference modes through a changed model: for each reference column the position in `mac` (n_ref × n_new) that
/// maximises the sum over a one-to-one assignment. @return (n_ref), -1 where nothing is left
[[nodiscard]] std::vector<int> follow_modes(const Eigen::Ref<const Eigen::MatrixXd>& mac);

}  // namespace twindeck::modal
