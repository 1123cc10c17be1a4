#pragma once

#include "model_io/ansys_build.hpp"

/// Inside of the library: loads of a deck of ANSYS. They are collected as they come and become the static stage of the modes if
/// the modal solution has PSTRES,ON or follows PERTURB,MODAL after a static one.
namespace twindeck::model_io::ansys {

/// Collects a load command: F, FDELE, ACEL, SFBEAM, SFE, BF, BFUNIF, TUNIF, TREF, INISTATE; remembers the first one that is not
/// read (FCUM, SF, OMEGA …). @return false for a command that is no load
bool read_load(Parts& parts, const Command& command);
/// PSTRES, NLGEOM, ANTYPE, PERTURB: what kind of solution comes next. @return false for another command
bool read_solution(Parts& parts, const Command& command);
/// SOLVE: keeps the loads of a static solution; says whether this is the modal solution that is read.
/// @return true if nothing behind it matters
bool read_solve(Parts& parts, const Command& command);
/// An initial strain of real constant `i`, which acts where a static stage is asked for. @throws InputError where it is not
[[nodiscard]] double initial_strain(const Builder& builder, const Member& member, const RealSet& set, std::size_t i);
/// Puts the kept loads on the model. @throws InputError for a load that is not carried, by its name
void apply_stage(Builder& builder);

}  // namespace twindeck::model_io::ansys
