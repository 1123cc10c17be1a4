#pragma once

#include "model_io/ansys_parts.hpp"

/// Inside of the library: nodes and elements by repetition (FILL, NGEN, EGEN), and the further nodes of an element (EMORE).
namespace twindeck::model_io::ansys {

/// FILL: nodes on the straight line between two, by themselves the last two of N, evenly spaced.
void fill_nodes(Parts& parts, const Command& command);
/// NGEN: copies of nodes, moved and with increased numbers.
void generate_nodes(Parts& parts, const Command& command);
/// EGEN: copies of elements on nodes with increased numbers.
void generate_elements(Parts& parts, const Command& command);
/// EMORE: nodes nine and on of the element before.
void read_more_nodes(Parts& parts, const Command& command);

}  // namespace twindeck::model_io::ansys
