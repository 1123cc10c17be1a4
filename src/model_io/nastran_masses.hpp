#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards of masses.
namespace twindeck::model_io::nastran {

void read_mass(Parts& parts, const Card& card);         ///< CONM1, CONM2
void read_scalar_mass(Parts& parts, const Card& card);  ///< CMASS1, CMASS2
void finish_masses(Parts& parts);                       ///< CMASS of a node together

}  // namespace twindeck::model_io::nastran
