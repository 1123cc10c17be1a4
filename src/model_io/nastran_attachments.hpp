#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards of springs and masses, and matrices given term by term at grids (DMIG).
namespace twindeck::model_io::nastran {

void read_scalar_spring(Parts& parts, const Card& card);  ///< CELAS1, CELAS2
void read_bush(Parts& parts, const Card& card);           ///< CBUSH
void read_mass(Parts& parts, const Card& card);           ///< CONM1, CONM2
void read_scalar_mass(Parts& parts, const Card& card);    ///< CMASS1, CMASS2
void finish_masses(Parts& parts);                         ///< CMASS of a node together

/// Mass that is not structural: NSM, NSM1 (per length or area), NSML, NSML1 (in total), NSMADD, of the set that the case
/// control chooses; of a deck without case control, of its one set.
void read_spread_masses(Parts& parts);

/// The matrices that K2GG and M2GG of the case control choose become elements given by matrices. Real symmetric ones (IFO 6)
/// are read. PARAM,WTMASS does not scale M2GG, as in Nastran.
/// @throws InputError  for another form, scalar points, terms that stand twice, a matrix of more than 500 grids
void read_direct_matrices(Parts& parts);

}  // namespace twindeck::model_io::nastran
