#pragma once

#include "core/error.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::fe {

/// Static state under dead load and pulls: what stiffens the structure.
struct PrestressState {
  Eigen::VectorXd stay_pull_N;            ///< (n_elements), 0 for what is not a stay
  Eigen::VectorXd axial_force_N;          ///< (n_elements), beams and bars; tension positive
  Eigen::VectorXd displacement;           ///< (6 n_nodes) under dead load and pulls [m, rad]
  std::vector<Eigen::Matrix3d> rotation;  ///< (n_nodes) of nodes under large displacements; empty for linear statics
  Status status;
};

/// Sizes and cross references of a model: every beam has length, every name exists, moduli are positive, every node is reached.
/// @throws InputError that names the source, the part, what was expected and how to mend it
void validate(const Model& model);

/// Stay pulls and the axial forces that balance them (prestress rule of the model). Linear statics, or, where
/// the model asks for large displacements, equilibrium in the deformed geometry under pulls that run along the stays as they
/// then lie; shape finding then corrects its pulls until the displacements of that state are at their best. Without
/// equilibrium the status says at which part of the load and why.
/// `theta` are the parameter values (a density changes the dead load). Stay stiffness is left out of this state.
/// @throws InputError for a mechanism, naming a node and its free degrees of freedom
[[nodiscard]] PrestressState find_prestress(const Model& model, const Eigen::VectorXd& theta);

/// Assembles K = sum a_g K_g and M = sum b_g M_g over the free degrees of freedom. Geometric stiffness of stays and members is
/// a term without parameters: the prestress is frozen until `assemble` is called again. Springs that are inactive, or in series
/// with a dashpot (which lets go of a steady force), are left out.
/// After large displacements the matrices are those of the deformed geometry (deformed_model).
/// @param state  pulls and axial forces; a default-constructed one (empty vectors) means none
[[nodiscard]] ParametricSystem assemble(const Model& model, const PrestressState& state);

/// Values of the model's parameters as they stand in materials, sections, springs.
[[nodiscard]] Eigen::VectorXd initial_parameters(const Model& model);

/// The model with parameter values written into its materials, sections, springs and masses (initial values follow).
[[nodiscard]] Model with_parameters(const Model& model, const Eigen::VectorXd& theta);

/// @throws InputError if K(theta) is singular: names a node and the directions in which it moves freely
void check_no_mechanism(const ParametricSystem& system, const Eigen::VectorXd& theta, const std::string& source);

}  // namespace twindeck::fe
