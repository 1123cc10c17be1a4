#pragma once

#include "model_io/ansys_build.hpp"

/// Inside of the library: beams, bars, shells and solids of the model.
namespace twindeck::model_io::ansys {

void add_member(Builder& builder, const Member& member);

}  // namespace twindeck::model_io::ansys
