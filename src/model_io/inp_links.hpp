#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: equations are collected; those of one node that together are a rigid link become one, others
/// constraints.
namespace twindeck::model_io {

void read_inp_equation(InpParts& parts, const InpCard& card);
void attach_inp_equations(InpParts& parts);
void attach_inp_rigid_body(InpParts& parts, const InpCard& card);
void attach_inp_mpc(InpParts& parts, const InpCard& card);
/// Drops constraints of displacements that are held as all that they follow is. @throws InputError for those that contradict a
/// support
void settle_inp_constraints(InpParts& parts);

}  // namespace twindeck::model_io
