#pragma once

#include "model_io/ansys_parts.hpp"

/// Inside of the library: commands of a deck that define nodes and elements, one each or by repetition (FILL, NGEN, EGEN).
namespace twindeck::model_io::ansys {

void add_node(Parts& parts, long id, const Node& node);
void add_element(Parts& parts, long id, Element element);
void read_node(Parts& parts, const Command& command);
void read_element(Parts& parts, const Command& command);
void read_numbered_element(Parts& parts, const Command& command);
void read_attribute(Parts& parts, const Command& command);
void read_axes(Parts& parts, const Command& command);

/// FILL: nodes on the straight line between two, by themselves the last two of N, evenly spaced.
void fill_nodes(Parts& parts, const Command& command);
/// NGEN: copies of nodes, moved and with increased numbers.
void generate_nodes(Parts& parts, const Command& command);
/// EGEN: copies of elements on nodes with increased numbers.
void generate_elements(Parts& parts, const Command& command);
/// EMORE: nodes nine and on of the element before.
void read_more_nodes(Parts& parts, const Command& command);

}  // namespace twindeck::model_io::ansys
