#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: *TIE joins two meshes that need not match.
namespace twindeck::model_io {

/// Every slave node follows the point of the master surface that is nearest to it, by the shape functions of the facet there:
/// u_s = sum N_i u_i, and over a gap as the facet turns. Rotations follow where both sides have them (shells). Nodes further
/// from the surface than POSITION TOLERANCE stay free; without that parameter it is 5 % of the size of a master facet and half
/// the thicknesses of shells.
/// @throws InputError  for unknown surfaces, where no node at all is near enough, for a slave that follows something else
/// already
void attach_inp_tie(InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
