#pragma once

#include <array>

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards by which some displacements of a grid follow those of others.
namespace twindeck::model_io::nastran {

/// RBE3: the reference grid moves as the weighted mean of the others. Its six motions q are those of least sum of w (u - S q)²
/// over the displacements u that the card names, S the rigid motion about the reference grid; weights of rotations count with
/// the square of the mean distance of the grids, as in MSC Nastran.
/// @throws InputError  where the grids do not determine a motion that REFC asks for
void read_average(Parts& parts, const Card& card);
/// RBE2 that ties some components only: those follow the independent grid as a rigid body, the others are free (hinges).
void tie_some(Parts& parts, const Card& card, long independent, long dependent, const Directions& tied);
/// MPC cards of the set that the case control chooses. The first displacement of each follows the others.
void read_multipoint(Parts& parts);

}  // namespace twindeck::model_io::nastran
