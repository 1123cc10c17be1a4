#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: materials, local axes, and sections, which give the elements of their set a material and a
/// cross-section.
namespace twindeck::model_io {

void read_inp_material(InpParts& parts, const InpCard& card);
void read_inp_elastic(InpParts& parts, const InpCard& card);
void read_inp_density(InpParts& parts, const InpCard& card);
/// *EXPANSION: the coefficient of the last *MATERIAL.
void read_inp_expansion(InpParts& parts, const InpCard& card);
void read_inp_orientation(InpParts& parts, const InpCard& card);
/// *TRANSFORM: the axes along which the degrees of freedom of a set of nodes count (rectangular, cylindrical, spherical).
void read_inp_transform(InpParts& parts, const InpCard& card);
void assign_inp_section(InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
