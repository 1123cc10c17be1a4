#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: nodes, elements and sets of an .inp file.
namespace twindeck::model_io {

void read_inp_nodes(InpParts& parts, const InpCard& card);
void read_inp_elements(InpParts& parts, const InpCard& card);
void read_inp_set(InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
