#pragma once

#include "model_io/ansys_parts.hpp"

/// Inside of the library: blocks of a deck (ETBLOCK, NBLOCK, EBLOCK, CMBLOCK, RLBLOCK, SECBLOCK), collected in Parts.
namespace twindeck::model_io::ansys {

/// ETBLOCK of 2023 and later: number, type and key options of each element type.
void read_type_block(Parts& parts, const Command& command);
void read_node_block(Parts& parts, const Command& command);
void read_element_block(Parts& parts, const Command& command);
void read_component_block(Parts& parts, const Command& command);
void read_real_block(Parts& parts, const Command& command);
void read_section_block(Parts& parts, const Command& command);

}  // namespace twindeck::model_io::ansys
