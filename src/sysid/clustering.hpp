#pragma once

#include <Eigen/Core>
#include <vector>

#include "sysid/stabilisation.hpp"

namespace twindeck::sysid {

struct CleaningRule {
  double mac = 0.95;          ///< Eq. (3): shapes with a MAC of at least this are the same
  double frequency = 0.02;    ///< and their frequencies differ by less than this, relative; large = the paper's bare rule
  double recursion = 5.0;     ///< Eq. (4): a shape recurs if its index C_i exceeds this
  double share = 0.4;         ///< and its cluster holds at least this share of the orders from its first one on; 0 = bare rule
};

/// A physical mode: poles of several orders that agree.
struct Cluster {
  std::vector<std::size_t> members;  ///< positions in the diagram, ascending, at most one an order
  std::size_t representative = 0;    ///< the member nearest to the medians, in units of the scatter
  double frequency_Hz = 0.0;         ///< median of the members
  double damping_ratio = 0.0;        ///< median of the members
  double frequency_scatter_Hz = 0.0;    ///< standard deviation over the members
  double damping_ratio_scatter = 0.0;
  Eigen::VectorXcd shape;            ///< median of the members' shapes, phases aligned, normalised
};

/// Index of recursion, paper Eqs. (3) and (4):  A_ij = 1 if MAC(v_i, v_j) >= 0.95, else 0;  C_i = sum_j A_ij. Here A_ij also asks that
/// the frequencies agree, because a few channels can't tell all shapes apart.
///
/// Cleans the diagram of spurious poles and gathers the rest: the pole with the highest index of recursion takes all poles with
/// which it has affinity, and so on among those left. Marks `mode` in the diagram.
/// @param orders  the orders of the diagram, ascending
/// @return ascending in frequency
[[nodiscard]] std::vector<Cluster> identify_clusters(std::vector<DiagramPole>& diagram, const std::vector<int>& orders,
                                                     const CleaningRule& rule);

/// Members gathered into a mode: medians, scatter, median shape. @param members positions in the diagram, at most one an order
[[nodiscard]] Cluster summarise(const std::vector<DiagramPole>& diagram, std::vector<std::size_t> members);

/// Of the members, one pole an order: the one nearest to the seed in shape.
[[nodiscard]] std::vector<std::size_t> one_an_order(const std::vector<DiagramPole>& diagram, const std::vector<std::size_t>& members,
                                                    std::size_t seed);

/// Number of orders from that of the members' lowest one on.
[[nodiscard]] std::size_t possible_orders(const std::vector<DiagramPole>& diagram, const std::vector<std::size_t>& members,
                                          const std::vector<int>& orders);

/// Sorts by frequency and marks the members' `mode` in the diagram.
void number_clusters(std::vector<DiagramPole>& diagram, std::vector<Cluster>& clusters);

}  // namespace twindeck::sysid
