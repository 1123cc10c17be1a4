#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards that hold grids or tie them to each other.
namespace twindeck::model_io::nastran {

void read_rigid(Parts& parts, const Card& card);  ///< RBE2, RBAR
void read_supports(Parts& parts);                 ///< SPC, SPC1, SPCADD of the chosen set, and what GRID holds
/// RBE3: the reference grid moves as the weighted mean of the others. Its six motions q are those of least sum of w (u - S q)²
/// over the displacements u that the card names, S the rigid motion about the reference grid; weights of rotations count with
/// the square of the mean distance of the grids, as in MSC Nastran.
/// @throws InputError  where the grids do not determine a motion that REFC asks for
void read_average(Parts& parts, const Card& card);
/// MPC cards of the set that the case control chooses. The first displacement of each follows the others.
void read_multipoint(Parts& parts);

}  // namespace twindeck::model_io::nastran
