#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: sections give the elements of their set a material and a cross-section.
namespace twindeck::model_io {

void assign_inp_section(InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
