#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards of beams, rods, shells and solids.
namespace twindeck::model_io::nastran {

void read_member(Parts& parts, const Card& card);  ///< CBAR, CBEAM
void read_rod(Parts& parts, const Card& card);     ///< CROD, CONROD
void read_shell(Parts& parts, const Card& card);   ///< CQUAD4
void read_solid(Parts& parts, const Card& card);   ///< CHEXA, CTETRA
void finish_rods(Parts& parts);                    ///< torsion of rods

}  // namespace twindeck::model_io::nastran
