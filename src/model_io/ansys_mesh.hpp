#pragma once

#include "model_io/ansys_parts.hpp"

/// Inside of the library: commands of a deck that define nodes and elements, one each, by repetition (FILL, NGEN, EGEN) or in
/// blocks (ETBLOCK, NBLOCK, EBLOCK, CMBLOCK, RLBLOCK, SECBLOCK), collected in Parts.
namespace twindeck::model_io::ansys {

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

/// ETBLOCK of 2023 and later: number, type and key options of each element type.
void read_type_block(Parts& parts, const Command& command);
void read_node_block(Parts& parts, const Command& command);
void read_element_block(Parts& parts, const Command& command);
void read_component_block(Parts& parts, const Command& command);
void read_real_block(Parts& parts, const Command& command);
void read_section_block(Parts& parts, const Command& command);

}  // namespace twindeck::model_io::ansys
