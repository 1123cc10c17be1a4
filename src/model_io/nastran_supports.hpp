#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards that hold grids or tie them to each other.
namespace twindeck::model_io::nastran {

void read_rigid(Parts& parts, const Card& card);  ///< RBE2, RBAR
void read_supports(Parts& parts);                 ///< SPC, SPC1, SPCADD of the chosen set, and what GRID holds
void refuse_multipoint(Parts& parts);             ///< MPC

}  // namespace twindeck::model_io::nastran
