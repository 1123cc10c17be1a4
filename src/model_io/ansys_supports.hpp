#pragma once

#include "model_io/ansys_parts.hpp"

/// Inside of the library: commands of a deck that hold nodes or tie them to each other.
namespace twindeck::model_io::ansys {

void read_support(Parts& parts, const Command& command);
void read_released_support(Parts& parts, const Command& command);
void read_couple(Parts& parts, const Command& command);
void read_rigid_region(Parts& parts, const Command& command);

}  // namespace twindeck::model_io::ansys
