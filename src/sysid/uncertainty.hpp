#pragma once

#include <Eigen/Core>
#include <vector>

#include "signal/correlation.hpp"
#include "sysid/ssi_cov.hpp"

namespace twindeck::sysid {

/// Standard deviations of one identified mode.
struct ModeDeviation {
  double frequency_Hz = 0.0;
  double damping_ratio = 0.0;
  Eigen::VectorXd shape_real, shape_imag;  ///< (n_outputs) of the entries of the unit-norm shape
};

/// Standard deviations of modes by the delete-one jackknife over data blocks: the correlations are taken again with each of the
/// n_b blocks left out, each replicate's subspace is found from the full record's (ssi_cov_nearby), and
///
///     var(x) = (n_b - 1)/n_b · sum_b |x_b - mean of x_b|².
///
/// For a smooth function of means, as poles are of the correlations, this equals first-order propagation of the covariance of
/// the block correlations, up to terms of second order, without forming that covariance. Blocks must be longer than the
/// correlations last (1/(zeta omega) of the lowest mode); then they count as independent.
/// x_b is made as the reported value is: the median over the model orders of frequency and damping, the mean of the shapes.
/// @param modes  for each mode its poles, each of the model of its own order; a replicate's pole is the one nearest to it in the
///               complex plane among those of the same order
/// @param full   observability matrix of all blocks
/// References: Efron and Stein (1981), Annals of Statistics 9, 586-596; Künsch (1989), Annals of Statistics 17, 1217-1241
/// (blocks); the propagation it equals: Reynders, Pintelon and De Roeck (2008), Mech. Syst. Signal Process. 22, 948-969.
[[nodiscard]] std::vector<ModeDeviation> jackknife(const signal::BlockCorrelations& blocks, Eigen::Index block_rows, const Observability& full,
                                                   const std::vector<std::vector<Pole>>& modes, double rate_Hz);

}  // namespace twindeck::sysid
