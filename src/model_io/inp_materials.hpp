#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: materials and local axes of an .inp file.
namespace twindeck::model_io {

void read_inp_material(InpParts& parts, const InpCard& card);
void read_inp_elastic(InpParts& parts, const InpCard& card);
void read_inp_density(InpParts& parts, const InpCard& card);
void read_inp_orientation(InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
