#pragma once

#include <filesystem>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"
#include "modal/modes.hpp"

namespace twindeck::model_io {

/// modes.csv and shapes.csv (docs/my_records.md) in a folder: standard deviations and damping that are NaN stay empty, damping
/// in per cent; each shape is scaled so that its component of largest magnitude is +1; a column value_imag is written where a
/// shape is complex; no shapes.csv where no shape is known.
void write_modes(const modal::ModeSet& modes, const std::filesystem::path& folder);
/// Reads the same files, further columns are allowed; shapes.csv may be missing. Modes with 1 in a column `partial` (of several
/// setups, of which some did not see the mode) are left out, because their shapes have holes.
/// @throws InputError with file, line, column: a frequency that is not positive, a mode named twice, a shape of an unknown
/// mode, a component that one mode has and another lacks
/// @param lines  gets the line of modes.csv of each mode, where it is not null
[[nodiscard]] modal::ModeSet read_modes(const std::filesystem::path& folder, std::vector<long>* lines = nullptr);
/// Model modes as a ModeSet (names "1", "2", …): all six directions at every node (FE), or node and direction of each dof
/// (matrix model).
[[nodiscard]] modal::ModeSet to_mode_set(const fe::Model* model, const fe::ParametricSystem& system,
                                         const dynamics::EigenModes& modes);

/// Modes of a model as they are published: translations x y z at every node of an FE model (rotations are left out: no
/// sensor measures them and they double the file), every degree of freedom of a matrix model.
/// @param model  null for a matrix model
[[nodiscard]] modal::ModeSet published_modes(const fe::Model* model, const fe::ParametricSystem& system,
                                             const dynamics::EigenModes& modes);

}  // namespace twindeck::model_io
