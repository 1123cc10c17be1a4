#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: springs, joints, masses and supports of an .inp file.
namespace twindeck::model_io {

void attach_inp_spring(InpParts& parts, const InpCard& card);
/// *JOINT with the *SPRING and *DASHPOT cards below it, which name no set: a spring and a dashpot for each degree of freedom,
/// along the axes of ORIENTATION or the global ones.
void attach_inp_joint(InpParts& parts, const InpCard& card);
void attach_inp_mass(InpParts& parts, const InpCard& card);
/// *NONSTRUCTURAL MASS: in total, or per volume, area or length of the elements of a set.
void spread_inp_mass(InpParts& parts, const InpCard& card);
/// *RELEASE: moments that an end of a beam does not carry (M1 and M2 about n1 and n2, T about the axis).
void release_inp_ends(InpParts& parts, const InpCard& card);
void attach_inp_boundary(InpParts& parts, const InpCard& card);
/// Axes of the *ORIENTATION that a card names, or the global ones. @throws InputError for an unknown name
[[nodiscard]] InpOrientation inp_axes_of(const InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
