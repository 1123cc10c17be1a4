#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: surfaces of an .inp file.
namespace twindeck::model_io {

/// *SURFACE of TYPE=ELEMENT (faces S1-S6 of hexahedra, sides SPOS and SNEG of shells, edges E1-E4 of shells) or TYPE=NODE.
void read_inp_surface(InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
