#pragma once

#include <map>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
#include "fe/model.hpp"

namespace twindeck::fe {

/// A model whose stays are chains of pieces with nodes in between, so that they have modes of their own.
struct StayChains {
  Model model;
  PrestressState state;                           ///< pulls and axial forces for `assemble`
  std::map<std::string, std::vector<int>> nodes;  ///< stay -> its nodes from end to end (pieces + 1)
};

/// Divides stays into `pieces` that hang in the parabola of their own weight,
///
///     drop(xi) = 4 d xi (1 - xi),   d = m g L² / (8 T),   xi = 0 … 1 along the chord,
///
/// vertically below the chord of length L, pull T, mass per length m. Axial stiffness along pieces that are not in line, and string
/// stiffness T/l across them, give the chain Irvine's modes, sag included, in and out of plane; seen from its ends it has the
/// static stiffness that Dischinger's modulus stands for. Half of each piece's mass goes to each of its ends. New nodes and pieces
/// come after those of the model, so that its degrees of freedom keep their numbers.
/// @param state   pulls of the undivided stays, axial forces of everything else
/// @param pieces  >= 2
/// @param names   stays that are divided; the others stay as they are
/// @throws InputError  for a stay without pull, or a name that is no stay
/// Reference: Irvine (1981), Cable Structures, chapters 2 and 3.
[[nodiscard]] StayChains with_stay_chains(const Model& model, const PrestressState& state, int pieces,
                                          const std::vector<std::string>& names);

}  // namespace twindeck::fe
