#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/stabilisation.hpp"

namespace twindeck::identification {

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
  Eigen::VectorXcd shape;  ///< median of the members' shapes, phases aligned, normalised
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
