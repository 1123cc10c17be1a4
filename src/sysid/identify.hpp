#pragma once

#include <vector>

#include "signal/correlation.hpp"
#include "sysid/clustering.hpp"
#include "sysid/uncertainty.hpp"

namespace twindeck::sysid {

struct IdentifyOptions {
  Eigen::Index block_rows = 30;
  int minimum_order = 2, maximum_order = 60, order_step = 2;
  StabilisationCriteria criteria;
  PoleLimits limits;
  CleaningRule cleaning;
  /// A cluster whose frequency has a relative standard deviation above this is dropped: such a pole is settled by the model orders
  /// but not by the data, half of its replicates would not even count as stable. 0 keeps all (the paper's rule).
  double largest_deviation = 0.01;
};

struct Identification {
  std::vector<DiagramPole> diagram;
  std::vector<Cluster> modes;             ///< ascending in frequency
  std::vector<ModeDeviation> deviations;  ///< one a mode; empty with a single block
};

/// Covariance-driven identification of output-only records: correlations to subspace to poles of all orders, stabilisation diagram,
/// cleaning, clusters, standard deviations.
/// @param blocks  correlations of lags 0 … 2 block_rows - 1 of the conditioned records @param rate_Hz  their sampling rate
/// @throws InputError  if the block rows can't carry the largest order
[[nodiscard]] Identification identify(const signal::BlockCorrelations& blocks, double rate_Hz, const IdentifyOptions& options);

}  // namespace twindeck::sysid
