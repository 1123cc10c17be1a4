#pragma once

#include <map>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
#include "fe/model.hpp"

namespace twindeck::fe {

/// A model whose stays are chains of pieces with inner nodes, so that the stays have their own modes.
struct StayChains {
  Model model;
  PrestressState state;                           ///< cable forces and axial forces for `assemble`
  std::map<std::string, std::vector<int>> nodes;  ///< stay -> its nodes from end to end (pieces + 1)
};

/// Divides stays into `pieces` on the parabola of the stay under its own weight,
///
///     drop(xi) = 4 d xi (1 - xi),   d = m g L² / (8 T),   xi = 0 … 1 along the chord,
///
/// vertically below the chord of length L, cable force T, mass per length m. With the axial stiffness along its pieces and the
/// string stiffness T/l across them, the chain has Irvine's modes, sag included, in and out of plane. Between its ends it has
/// the static stiffness of Dischinger's modulus. Half of each piece's mass is at each of its ends. New nodes and pieces follow
/// those of the model, so that its degrees of freedom keep their numbers.
/// @param state   cable forces of the undivided stays, axial forces of all other elements
/// @param pieces  >= 2
/// @param names   stays that are divided; the others stay as they are
/// @throws InputError  for a stay without a cable force, or a name that is not a stay
/// Reference: Irvine (1981), Cable Structures, chapters 2 and 3.
[[nodiscard]] StayChains with_stay_chains(const Model& model, const PrestressState& state, int pieces,
                                          const std::vector<std::string>& names);

}  // namespace twindeck::fe
