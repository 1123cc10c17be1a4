#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: springs, masses and supports of an .inp file.
namespace twindeck::model_io {

void attach_inp_spring(InpParts& parts, const InpCard& card);
void attach_inp_mass(InpParts& parts, const InpCard& card);
void attach_inp_boundary(InpParts& parts, const InpCard& card);
/// Axes of the *ORIENTATION that a card names, or the global ones. @throws InputError for an unknown name
[[nodiscard]] InpOrientation inp_axes_of(const InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
