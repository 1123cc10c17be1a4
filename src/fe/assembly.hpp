#pragma once

#include "core/error.hpp"
#include "fe/assembly_parameters.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"
#include "fe/prestress.hpp"
#include "fe/validate.hpp"

namespace twindeck::fe {

/// Assembles K = sum a_g K_g and M = sum b_g M_g over the free degrees of freedom. Geometric stiffness of stays and members is
/// a term without parameters: the prestress is frozen until `assemble` is called again. Springs that are inactive, or in series
/// with a dashpot (which cannot carry a steady force), are left out.
/// After large displacements the matrices are those of the deformed geometry (deformed_model).
/// @param state  cable forces and axial forces; a default-constructed state (empty vectors) has none
[[nodiscard]] ParametricSystem assemble(const Model& model, const PrestressState& state);

/// @throws InputError if K(theta) is singular: names a node and the directions in which it moves freely
void check_no_mechanism(const ParametricSystem& system, const Eigen::VectorXd& theta, const std::string& source);

}  // namespace twindeck::fe
