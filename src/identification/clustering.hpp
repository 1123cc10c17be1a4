#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/state_space.hpp"

namespace twindeck::identification {

/// The criteria of stable poles, paper section 3.1, each against the model of the next smaller order.
struct StabilisationCriteria {
  double frequency = 0.02;  ///< relative change below which a frequency is stable
  double damping = 0.01;    ///< change of the damping ratio [-], one percentage point, below which it is stable
  double mac = 0.95;        ///< MAC from which a shape is stable
};

/// Hard limits that every mode of a structure meets.
struct PoleLimits {
  double lowest_Hz = 0.0, highest_Hz = 1e300;
  double largest_damping = 0.20;  ///< 0 < zeta < largest_damping
};

/// A pole of the diagram.
struct DiagramPole {
  Pole pole;
  bool stable_frequency = false, stable_damping = false, stable_shape = false;
  int mode = -1;                  ///< position in the list of identified modes, -1 if the pole belongs to none
  double frequency_std_Hz = 0.0;  ///< from the data's covariance; 0 where that is unknown
  [[nodiscard]] bool stable() const { return stable_frequency && stable_damping && stable_shape; }
};

/// The stabilisation diagram: poles of all orders within the limits, each compared with the pole of the next smaller order that
/// has the highest MAC with it among those within the frequency criterion (close modes may change their order in frequency, not
/// their shapes).
/// @param poles  one list an order, orders ascending
[[nodiscard]] std::vector<DiagramPole> stabilisation_diagram(const std::vector<std::vector<Pole>>& poles,
                                                             const StabilisationCriteria& criteria, const PoleLimits& limits);

struct CleaningRule {
  double mac = 0.95;        ///< Eq. (3): shapes with a MAC of at least this are the same
  double frequency = 0.02;  ///< largest relative difference of their frequencies; a large value gives the paper's rule
  double recursion = 5.0;   ///< Eq. (4): least index C_i of a recurring shape (exclusive)
  double share = 0.4;       ///< least share of the orders from its first one on in its cluster; 0 = the paper's rule
};

/// A physical mode: poles of several orders that agree.
struct Cluster {
  std::vector<std::size_t> members;   ///< positions in the diagram, ascending, at most one an order
  std::size_t representative = 0;     ///< the member nearest to the medians, in units of the scatter
  double frequency_Hz = 0.0;          ///< median of the members
  double damping_ratio = 0.0;         ///< median of the members
  double frequency_scatter_Hz = 0.0;  ///< standard deviation over the members
  double damping_ratio_scatter = 0.0;
  Eigen::VectorXcd shape;  ///< (n_outputs) median of the members' shapes, phases aligned, normalised
};

/// Index of recursion of each shape, paper Eqs. (3) and (4):  A_ij = 1 if MAC(v_i, v_j) >= 0.95, else 0;  C_i = sum_j A_ij.
/// Here A_ij also requires that the frequencies agree, because a few channels cannot distinguish all shapes.
///
/// Removes spurious poles and clusters the others. The pole with the highest index of recursion takes all poles with A_ij = 1.
/// This repeats with the remaining poles. Marks `mode` in the diagram.
/// @param orders  the orders of the diagram, ascending
/// @return ascending in frequency
[[nodiscard]] std::vector<Cluster> identify_clusters(std::vector<DiagramPole>& diagram, const std::vector<int>& orders,
                                                     const CleaningRule& rule);

/// Makes a mode of its members: medians, scatter, median shape. @param members positions in the diagram, at most one an order
[[nodiscard]] Cluster summarise(const std::vector<DiagramPole>& diagram, std::vector<std::size_t> members);

/// Keeps one member per order: the pole whose shape is nearest to that of the seed.
[[nodiscard]] std::vector<std::size_t> one_an_order(const std::vector<DiagramPole>& diagram,
                                                    const std::vector<std::size_t>& members, std::size_t seed);

/// Number of orders from the lowest order of the members on.
[[nodiscard]] std::size_t possible_orders(const std::vector<DiagramPole>& diagram, const std::vector<std::size_t>& members,
                                          const std::vector<int>& orders);

/// Sorts by frequency and marks the members' `mode` in the diagram.
void number_clusters(std::vector<DiagramPole>& diagram, std::vector<Cluster>& clusters);

}  // namespace twindeck::identification
