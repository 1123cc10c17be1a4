#pragma once

#include "model_io/ansys_build.hpp"

/// Inside of the library: rigid regions (CERIG), coupled displacements (CP) and constraint equations (CE).
namespace twindeck::model_io::ansys {

/// Collects a CE.
void read_equation(Parts& parts, const Command& command);

/// Makes rigid links where one node follows another as a rigid body in all that it has, and constraints of everything else. Of
/// an equation the first displacement follows the others that is neither held, nor a slave's, nor dependent already.
/// @throws InputError  for turned nodal axes, nodes that no element holds, an equation in which nothing can follow
void add_ties(Builder& builder);

}  // namespace twindeck::model_io::ansys
