#include "dynamics/model_check.hpp"

#include <fmt/format.h>

#include "dynamics/eigenmodes.hpp"
#include "fe/definite.hpp"
#include "fe/mechanism.hpp"
#include "linalg/cholesky.hpp"

namespace twindeck::dynamics {

LoadedModel with_sound_matrices(LoadedModel loaded) {
  if (!loaded.state.status.converged) return loaded;  // no state to judge; the step says why there is none
  const std::vector<fe::DofLabel>& dofs = loaded.system.dofs;
  const linalg::SparseMatrix mass = loaded.system.mass(loaded.theta);
  fe::check_mass(mass, dofs, loaded.source, loaded.model && fe::mass_is_a_sum_of_squares(*loaded.model));
  const linalg::SparseMatrix stiffness = loaded.system.stiffness(loaded.theta);
  fe::check_sizes(stiffness, dofs, loaded.source, "stiffness");
  if (loaded.model && loaded.model->prestress.rule == fe::PullRule::none) return loaded;  // from_model has factorised K
  linalg::Cholesky factor;
  if (factor.factorize(stiffness).converged) return loaded;
  fe::refuse_negative_stiffness(stiffness, dofs, loaded.source, loaded.model ? " under its dead load and pulls" : "");
  // K is semidefinite: a free structure, which its mass has to hold.
  linalg::SparseMatrix held = stiffness - dynamics::free_structure_shift(stiffness, mass) * mass;
  held.makeCompressed();
  if (!factor.factorize(held).converged) static_cast<void>(fe::factorize_or_refuse(held, dofs, loaded.source, ""));
  return loaded;
}

void refuse_more_modes_than_there_are(long n_modes, const LoadedModel& loaded, const EigenModes& modes) {
  const long found = modes.frequency_Hz.size();
  if (!modes.status.converged || found >= n_modes) return;
  const bool dofs = n_modes > loaded.system.size();
  throw InputError({loaded.source, 0, "n_modes"},
                   dofs ? fmt::format("is {}, but the model has {} degrees of freedom", n_modes, loaded.system.size())
                        : fmt::format("is {}, but only {} modes have mass to move", n_modes, found),
                   "ask for fewer modes: --set n_modes=" + std::to_string(found));
}

}  // namespace twindeck::dynamics
