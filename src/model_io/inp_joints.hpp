#pragma once

#include "model_io/inp_parts.hpp"

/// Inside of the library: JOINTC, a joint of springs and dashpots between two nodes.
namespace twindeck::model_io {

/// *JOINT with the *SPRING and *DASHPOT cards below it, which name no set: a spring and a dashpot for each degree of freedom,
/// along the axes of ORIENTATION or the global ones.
void attach_inp_joint(InpParts& parts, const InpCard& card);

/// Whether a *SPRING or *DASHPOT belongs to the *JOINT above it.
[[nodiscard]] bool is_of_joint(const InpFile& file, const InpCard& card);

}  // namespace twindeck::model_io
