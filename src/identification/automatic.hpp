#pragma once

#include <vector>

#include "identification/clustering.hpp"

namespace twindeck::identification {

struct AutomaticRule {
  double collinearity = 0.5;  ///< least modal phase collinearity of a pole
  double share = 0.4;         ///< least share of the orders at which a mode is found, counted from its first order on
  double share_of_all = 0.3;  ///< least share of all orders, and at least four orders
  double share_beside = 0.5;  ///< least share of all orders at which two poles of like shape must appear to be two modes
  /// For each channel, how many times displacement is differentiated (2 for acceleration). Then a velocity channel beside
  /// accelerations shows no phase shift of 90 degrees. Empty: all channels are equal.
  std::vector<int> derivatives;
  /// Bounds of the cut, which the data give, as a distance between poles. Lower bound: the tolerance of a stable shape in paper
  /// section 3.1 (MAC 0.95). Upper bound: plus its tolerance of the frequency (2 %). At orders far above the number of modes
  /// the poles of a strong mode agree to 1e-4. A cut from these distances alone would split a weaker mode.
  double smallest_cut = 0.05, largest_cut = 0.07;
  /// A mixture of two neighbours: largest part of its unit-norm shape, squared, outside the span of theirs, and largest chance
  /// that the shape of another mode lies as near to the span. With few channels the chance decides: with four, 1 % of random
  /// shapes are near enough.
  double mixture_residual = 0.1, mixture_chance = 0.01;
  double mixture_reach = 0.10;  ///< [-] relative distance within which either neighbour lies
};

/// Modal phase collinearity: 1 where all components move in phase or opposite phase, 0 where phases are arbitrary. From the
/// covariance of real and imaginary parts with eigenvalues l1, l2:  MPC = ((l1 - l2)/(l1 + l2))². Reference: Pappa, Elliott and
/// Schenk (1993), Journal of Guidance, Control, and Dynamics 16(5), 832-838.
[[nodiscard]] double phase_collinearity(const Eigen::VectorXcd& shape);

/// The shape as if all channels measured the same quantity: a factor i is removed for each differentiation.
/// @param derivatives  as in AutomaticRule
[[nodiscard]] Eigen::VectorXcd one_quantity(Eigen::VectorXcd shape, const std::vector<int>& derivatives);

/// Selection without tuned criteria. Poles must be within the limits of the diagram, and collinear. Distance of two poles:
///
///     d = |f_i - f_j| / max(f_i, f_j) + 1 - MAC.
///
/// Each pole's distance to its nearest pole of the next smaller order falls into two populations, physical and spurious, split
/// by 2-means of ln d. Agglomerative clustering follows (average linkage, never two poles of one order). Its cut is the 95 %
/// quantile of the distances of physical poles. Each order without a pole in a cluster then adds its nearest pole, if it is
/// within twice the cut of the cluster's centre. Clusters at too few orders are dropped. Of two clusters nearer than half a
/// bandwidth with a MAC above 0.8 the smaller is dropped, unless both are found at half of the orders. A cluster is also
/// dropped if the nearest pole of the next order, within the cut, is the first pole of another cluster: it is the same mode at
/// orders that do not yet separate it from a neighbour. Last, mixtures are dropped: clusters that stand for two modes
/// at orders that do not separate them. The frequency lies between those of two clusters with more orders, and the shape
/// in the span of their shapes. At most of its orders one of the two is missing, and both continue above its last order.
/// @param orders  ascending @return ascending in frequency; marks `mode` in the diagram
/// Reference: Reynders, Houbrechts and De Roeck (2012), Mechanical Systems and Signal Processing 29, 228-250.
[[nodiscard]] std::vector<Cluster> automatic_clusters(std::vector<DiagramPole>& diagram, const std::vector<int>& orders,
                                                      const AutomaticRule& rule);

/// Which clusters are mixtures of two others, as automatic_clusters drops them. Clusters that have lost members must be checked
/// again: their noise poles may have hidden a mixture.
/// @param share_beside  largest share of a mixture's orders at which both of the others have poles of their own
[[nodiscard]] std::vector<bool> mixtures(const std::vector<DiagramPole>& diagram, const std::vector<Cluster>& clusters,
                                         const AutomaticRule& rule, double share_beside);

}  // namespace twindeck::identification
