#pragma once

#include "model_io/ansys_parts.hpp"

/// Inside of the library: commands of a deck that define element types, real constants, materials and sections.
namespace twindeck::model_io::ansys {

void read_type(Parts& parts, const Command& command);
void read_option(Parts& parts, const Command& command);
void read_reals(Parts& parts, const Command& command);
void read_more_reals(Parts& parts, const Command& command);
void read_changed_reals(Parts& parts, const Command& command);
void read_property(Parts& parts, const Command& command);
void read_property_data(Parts& parts, const Command& command);
void read_section_type(Parts& parts, const Command& command);
void read_section_data(Parts& parts, const Command& command);
void read_section_offset(Parts& parts, const Command& command);
void read_section_control(Parts& parts, const Command& command);

}  // namespace twindeck::model_io::ansys
