#pragma once

#include <filesystem>

#include "fe/parametric_system.hpp"

namespace twindeck::model_io {

/// True if the folder is a matrix model (model.toml has [matrices]).
[[nodiscard]] bool is_matrix_model(const std::filesystem::path& folder);
/// Reads a matrix model: dofs.csv, model.toml, *.mtx. K(theta) = K0 + sum theta_i K_i and M(theta) likewise, all on the union
/// of the patterns (with a full diagonal). M may be singular. Coordinates may be missing (NaN in DofLabel::x_m). Beyond the
/// contract a parameter may give `unit` and `group` (in Parameter::of; its own name if missing), and one name may stand twice,
/// once for the stiffness and once for the mass, with the same values.
/// @throws InputError with file and line for matrices that do not fit dofs.csv or are not symmetric, doubled names, bad bounds
[[nodiscard]] fe::ParametricSystem read_matrix_model(const std::filesystem::path& folder);

/// Writes a matrix model that `read_matrix_model` reads, K and M decomposed at the initial parameters: exact to the last bits
/// where every coefficient is linear in one parameter (always so for what was read), the tangent K0 = K - sum theta_i
/// dK/dtheta_i, K_i = dK/dtheta_i elsewhere.
void write_matrix_model(const fe::ParametricSystem& system, const std::filesystem::path& folder);

}  // namespace twindeck::model_io
