#pragma once

#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "dynamics/loaded_model.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// `--export-matrices`, `--export-inp`, `--export-unv`.
[[nodiscard]] std::vector<runner::Flag> export_flags();

/// Writes the model for other programs, as far as these options ask for it: matrices (export_matrices.hpp), model.inp for
/// CalculiX and model_abaqus.inp for Abaqus, with a message about what such a file cannot hold, and model.unv, a universal
/// file.
/// @param n_modes  asked for in the .inp files
/// @throws InputError  for a matrix model, of which only the matrices can be written
void write_exports(const dynamics::LoadedModel& loaded, const dynamics::EigenModes& modes, int n_modes,
                   const runner::StepContext& context);

}  // namespace twindeck::steps
