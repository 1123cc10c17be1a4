#pragma once

#include <filesystem>

#include "dynamics/eigenmodes.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"
#include "modal/modes.hpp"

namespace twindeck::model_io {

/// K.mtx and M.mtx (Matrix Market, symmetric, lower triangle, 17 digits) with dofs.csv (`dof,node,direction,x_m,y_m,z_m`, dof
/// from 1).
void write_matrices(const fe::ParametricSystem& system, const Eigen::VectorXd& theta, const std::filesystem::path& folder);
/// C.mtx, where the model has dashpots or elements with damping, written of fe::assemble_dynamic; nothing where it has none.
/// Rows are those of dofs.csv, then one for each unknown that an element has of its own (a spring in series with a dashpot);
/// where there are such, also the K_damped.mtx and M_damped.mtx that go with C.mtx, and dofs_damped.csv, whose last rows give
/// the element's name for the node and `own` for the direction. Friction is no part of it.
void write_damping(const fe::Model& model, const fe::ParametricSystem& system, const Eigen::VectorXd& theta,
                   const std::filesystem::path& folder);
/// dofs.csv alone; coordinates that are not known (NaN) stay empty.
void write_dofs(const fe::ParametricSystem& system, const std::filesystem::path& folder);
/// Unstructured grid for ParaView: one point field per mode (vector, largest translation 1), one cell field `group`, `type`.
void write_vtu(const fe::Model& model, const fe::ParametricSystem& system, const dynamics::EigenModes& modes,
               const std::filesystem::path& file);

/// modes.csv and shapes.csv (docs/my_records.md) in a folder: standard deviations and damping that are NaN stay empty, damping
/// in per cent; each shape is scaled so that its component of largest magnitude is +1; a column value_imag is written where a
/// shape is complex; no shapes.csv where no shape is known.
void write_modes(const modal::ModeSet& modes, const std::filesystem::path& folder);
/// Reads the same files, further columns are allowed; shapes.csv may be missing. Modes with 1 in a column `partial` (of several
/// setups, of which some did not see the mode) are left out, because their shapes have holes.
/// @throws InputError with file, line, column: a frequency that is not positive, a mode named twice, a shape of an unknown
/// mode,
///         a component that one mode has and another lacks
/// @param lines  gets the line of modes.csv of each mode, where it is not null
[[nodiscard]] modal::ModeSet read_modes(const std::filesystem::path& folder, std::vector<long>* lines = nullptr);
/// Model modes as a ModeSet (names "1", "2", …): all six directions at every node (FE), or node and direction of each dof
/// (matrix model).
[[nodiscard]] modal::ModeSet to_mode_set(const fe::Model* model, const fe::ParametricSystem& system,
                                         const dynamics::EigenModes& modes);

}  // namespace twindeck::model_io
