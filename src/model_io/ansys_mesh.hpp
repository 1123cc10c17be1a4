#pragma once

#include "model_io/ansys_parts.hpp"

/// Inside of the library: commands of a deck that define nodes and elements.
namespace twindeck::model_io::ansys {

void add_node(Parts& parts, long id, const Node& node);
void add_element(Parts& parts, long id, Element element);
void read_node(Parts& parts, const Command& command);
void read_element(Parts& parts, const Command& command);
void read_numbered_element(Parts& parts, const Command& command);
void read_attribute(Parts& parts, const Command& command);
void read_axes(Parts& parts, const Command& command);

}  // namespace twindeck::model_io::ansys
