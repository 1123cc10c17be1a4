#pragma once

#include <filesystem>

#include "fe/parametric_system.hpp"

namespace twindeck::model_io {

/// Writes a matrix model that `read_matrix_model` reads, K and M decomposed at the initial parameters: exact to the last bits
/// where every coefficient is linear in one parameter (always so for what was read), the tangent K0 = K - sum theta_i
/// dK/dtheta_i, K_i = dK/dtheta_i elsewhere.
void write_matrix_model(const fe::ParametricSystem& system, const std::filesystem::path& folder);

}  // namespace twindeck::model_io
