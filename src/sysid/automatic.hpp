#pragma once

#include <vector>

#include "sysid/clustering.hpp"

namespace twindeck::sysid {

struct AutomaticRule {
  double collinearity = 0.5;  ///< modal phase collinearity of at least this
  double share = 0.4;         ///< a mode is found at no less than this share of the orders from its first one on,
  double share_of_all = 0.3;  ///< this share of all orders, and four of them
  /// Of each channel, how often displacement is differentiated (2 for acceleration), so that a velocity beside accelerations
  /// does not count as a quarter turn of phase; empty: all alike.
  std::vector<int> derivatives;
  /// Bounds of the cut that the data give, as a distance between poles: that of shapes that paper section 3.1 calls stable (MAC
  /// 0.95), and with the frequency's own tolerance on top (2 %). Orders far above the number of modes repeat a strong mode to
  /// 1e-4, so that its distances alone would part a weaker mode from itself.
  double smallest_cut = 0.05, largest_cut = 0.07;
};

/// Modal phase collinearity: 1 where all components move in phase or opposite phase, 0 where phases are arbitrary. From the
/// covariance of real and imaginary parts with eigenvalues l1, l2:  MPC = ((l1 - l2)/(l1 + l2))². Reference: Pappa, Elliott and
/// Schenk (1993), Journal of Guidance, Control, and Dynamics 16(5), 832-838.
[[nodiscard]] double phase_collinearity(const Eigen::VectorXcd& shape);

/// Selection without tuned criteria. Hard validation: within the diagram's limits, collinear. Distance of two poles:
///
///     d = |f_i - f_j| / max(f_i, f_j) + 1 - MAC.
///
/// Each pole's distance to its nearest pole of the next smaller order falls into two populations, physical and spurious, split
/// by 2-means of ln d; the cut of the agglomerative clustering (average linkage, never two poles of one order) is the 95 %
/// quantile of the physical ones' distances. Orders that a cluster lacks then give it their nearest pole within twice the cut
/// of its centre; clusters found at too few orders are dropped, and of two clusters nearer than half a bandwidth with a MAC
/// above 0.8 the smaller. A cluster whose pole is found again at the next order, within the cut and nearest of all, as the first
/// of another cluster is the same mode at orders that do not yet part it from a neighbour: it is dropped for the other.
/// @param orders  ascending @return ascending in frequency; marks `mode` in the diagram
/// Reference: Reynders, Houbrechts and De Roeck (2012), Mechanical Systems and Signal Processing 29, 228-250.
[[nodiscard]] std::vector<Cluster> automatic_clusters(std::vector<DiagramPole>& diagram, const std::vector<int>& orders,
                                                      const AutomaticRule& rule);

}  // namespace twindeck::sysid
