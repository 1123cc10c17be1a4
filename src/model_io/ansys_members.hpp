#pragma once

#include "model_io/ansys_build.hpp"

/// Inside of the library: beams, bars, shells, solids, springs, masses and supports of the model.
namespace twindeck::model_io::ansys {

void add_member(Builder& builder, const Member& member);

void add_spring(Builder& builder, const Member& member);
/// Of a MASS21, or of a COMBIN40, which has one beside its spring.
void add_masses(Builder& builder, const Member& member);
void add_supports(Builder& builder);

}  // namespace twindeck::model_io::ansys
