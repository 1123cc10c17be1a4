#pragma once

#include "model_io/ansys_parts.hpp"

/// Inside of the library: commands of a deck that select nodes and elements, or name what is selected.
namespace twindeck::model_io::ansys {

void read_component(Parts& parts, const Command& command);
void select_component(Parts& parts, const Command& command);
void select_nodes(Parts& parts, const Command& command);
void select_elements(Parts& parts, const Command& command);
void select_nodes_of_elements(Parts& parts, const Command& command);
void select_all(Parts& parts, const Command& command);

}  // namespace twindeck::model_io::ansys
