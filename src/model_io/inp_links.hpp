#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: equations are collected, then those of one node must together be a rigid link.
namespace twindeck::model_io {

void read_inp_equation(InpParts& parts, const InpCard& card);
void attach_inp_equations(InpParts& parts);
void attach_inp_rigid_body(InpParts& parts, const InpCard& card);
void attach_inp_mpc(InpParts& parts, const InpCard& card);

}  // namespace twindeck::model_io
