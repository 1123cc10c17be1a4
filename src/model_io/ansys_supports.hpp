#pragma once

#include "model_io/ansys_build.hpp"
#include "model_io/ansys_parts.hpp"

/// Inside of the library: commands of a deck that hold nodes (D) or tie them to each other: rigid regions (CERIG), coupled
/// displacements (CP) and constraint equations (CE).
namespace twindeck::model_io::ansys {

void read_support(Parts& parts, const Command& command);
/// DSYM.
void read_symmetry(Parts& parts, const Command& command);
void read_released_support(Parts& parts, const Command& command);
void read_couple(Parts& parts, const Command& command);
void read_rigid_region(Parts& parts, const Command& command);

/// Collects a CE.
void read_equation(Parts& parts, const Command& command);

/// Makes rigid links where one node follows another as a rigid body in all that it has, and constraints of everything else. Of
/// an equation the first displacement follows the others that is neither held, nor a slave's, nor dependent already.
/// @throws InputError  for turned nodal axes, nodes that no element holds, an equation in which nothing can follow
void add_ties(Builder& builder);

}  // namespace twindeck::model_io::ansys
