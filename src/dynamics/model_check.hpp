#pragma once

#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"

namespace twindeck::dynamics {

/// Refuses matrices that cannot belong to a structure. It is called once for each model that a user gives, by the functions of
/// model_source.hpp. K of a prestressed or matrix model and M of a matrix model are factorised for the check; matrices
/// of elements alone are valid by construction.
/// @throws InputError  naming the degree of freedom: a number that is not finite, negative mass or an indefinite M, no mass at
///         all, a stiffness that is negative in any motion, a motion with neither stiffness nor mass (fe/definite.hpp)
[[nodiscard]] LoadedModel with_sound_matrices(LoadedModel loaded);

/// @param n_modes  as configured
/// @param modes    what `ModalSolver::solve_available` found
/// @throws InputError  if more modes are requested than the structure has
void refuse_more_modes_than_there_are(long n_modes, const LoadedModel& loaded, const EigenModes& modes);

}  // namespace twindeck::dynamics
