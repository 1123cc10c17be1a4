#pragma once

#include "model_io/nastran_parts.hpp"

/// Inside of the library: cards of beams, rods, shells and solids.
namespace twindeck::model_io::nastran {

void read_member(Parts& parts, const Card& card);  ///< CBAR, CBEAM
void read_rod(Parts& parts, const Card& card);     ///< CROD, CONROD
void read_shell(Parts& parts, const Card& card);   ///< CQUAD4
void read_solid(Parts& parts, const Card& card);   ///< CHEXA, CTETRA
void finish_rods(Parts& parts);                    ///< torsion of rods
/// The vector v of a member or bush in basic axes: by a grid (G0) or by components. @param frame  'B': of the basic axes, 'G':
/// of the displacement axes of its first grid
[[nodiscard]] Eigen::Vector3d plane_vector(Parts& parts, const Card& card, char frame);

}  // namespace twindeck::model_io::nastran
