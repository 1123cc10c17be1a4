#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards that hold grids or tie them to each other.
namespace twindeck::model_io::nastran {

void read_rigid(Parts& parts, const Card& card);  ///< RBE2, RBAR
void read_supports(Parts& parts);                 ///< SPC, SPC1, SPCADD of the chosen set, and what GRID holds
/// Six components of a grid in its displacement system as components in basic axes.
/// @throws InputError  where the axes are skew and only some of three components are meant
[[nodiscard]] Directions basic_components(Parts& parts, const Card& card, long grid, const Directions& local);

}  // namespace twindeck::model_io::nastran
