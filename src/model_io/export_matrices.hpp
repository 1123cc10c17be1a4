#pragma once

#include <filesystem>

#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

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

}  // namespace twindeck::model_io
