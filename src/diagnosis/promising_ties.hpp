#pragma once

#include <utility>
#include <vector>

#include "diagnosis/inference.hpp"

/// Which two nodes a tie should join to explain what a fit leaves. Takes the fit and the nodes; gives the best pairs.
namespace twindeck::diagnosis {

/// Pairs of nodes in descending order of what a tie between them would explain to first order.
///
/// A spring along d changes the modes by  d ln f_i = k (phi_i'd)² / (2 w_i²)  and
/// d phi_i = k sum_j phi_j (phi_j'd)(phi_i'd) / (w_i² - w_j²), which is linear in the products (phi_i'd)(phi_j'd). With the
/// signatures of these products whitened once, a pair costs some thousand operations. Where there are many nodes they are
/// ranked by a spring of their own to the ground, and the pairs of the best are looked at.
/// @param nodes  places with directions
/// @param count  pairs that are wanted
[[nodiscard]] std::vector<std::pair<const ReducedPlace*, const ReducedPlace*>> promising_ties(
    const Inference& inference, const Fit& base, const std::vector<const ReducedPlace*>& nodes, std::size_t count);

}  // namespace twindeck::diagnosis
