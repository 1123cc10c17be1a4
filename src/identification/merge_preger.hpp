#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/identify.hpp"

namespace twindeck::identification {

/// Correlations of one setup for merging before identification.
struct SetupCorrelations {
  std::string setup;
  std::vector<Eigen::Index> channels;    ///< of its outputs, in the list of all
  std::vector<Eigen::Index> references;  ///< positions among its outputs, the same sensors in the same order in every setup
  std::vector<Eigen::MatrixXd> lags;     ///< R_0 … (n_outputs × n_references)
};

/// Merging before the poles are computed (PreGER). The reference parts of all setups, side by side, give one observability
/// matrix O_ref of the references and, for each setup, the states Z_s that excite it. O_s = T_s Z_s⁺  then has the common basis
/// for any excitation of the setup, and the rows of all setups make one system. Each setup is first divided by the norm of its
/// reference part.
/// @return poles of all orders, shapes over all channels (`n_channels`; zero at channels without a measurement)
/// Reference: Mevel, Basseville, Benveniste and Goursat (2002), Journal of Sound and Vibration 254(1), 97-117; Doehler,
/// Andersen and Mevel (2010), IOMAC (PreGER).
[[nodiscard]] std::vector<std::vector<Pole>> merge_preger(const std::vector<SetupCorrelations>& setups, Eigen::Index n_channels,
                                                          Eigen::Index block_rows, const std::vector<int>& orders,
                                                          double rate_Hz);

}  // namespace twindeck::identification
