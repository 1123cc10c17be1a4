#pragma once

#include "core/error.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::fe {

/// Static state under dead load and cable forces, which gives the geometric stiffness.
struct PrestressState {
  Eigen::VectorXd stay_pull_N;            ///< (n_elements) cable forces; 0 if the element is not a stay
  Eigen::VectorXd axial_force_N;          ///< (n_elements), beams and bars; tension positive
  Eigen::VectorXd displacement;           ///< (6 n_nodes) under dead load and cable forces [m, rad]
  std::vector<Eigen::Matrix3d> rotation;  ///< (n_nodes) of nodes under large displacements; empty for linear statics
  Status status;
};

/// Checks sizes and cross references of a model: every beam has length, every name exists, moduli are positive, every node is
/// connected.
/// @throws InputError that names the source, the part, what was expected and how to mend it
void validate(const Model& model);

/// Cable forces and the axial forces in equilibrium with them (prestress rule of the model). The default is linear statics. If
/// the model asks for large displacements, equilibrium holds in the deformed geometry, with cable forces along the displaced
/// stays; shape finding then corrects the cable forces until the displacements of that state are smallest. If there is no
/// equilibrium, the status says at which part of the load and why.
/// `theta` are the parameter values (a density changes the dead load). The stiffness of stays is not used in this state.
/// @throws InputError for a mechanism, naming a node and its free degrees of freedom
[[nodiscard]] PrestressState find_prestress(const Model& model, const Eigen::VectorXd& theta);

/// Assembles K = sum a_g K_g and M = sum b_g M_g over the free degrees of freedom. Geometric stiffness of stays and members is
/// a term without parameters: the prestress is frozen until `assemble` is called again. Springs that are inactive, or in series
/// with a dashpot (which cannot carry a steady force), are left out.
/// After large displacements the matrices are those of the deformed geometry (deformed_model).
/// @param state  cable forces and axial forces; a default-constructed state (empty vectors) has none
[[nodiscard]] ParametricSystem assemble(const Model& model, const PrestressState& state);

/// Current values of the model's parameters in its materials, sections and springs.
[[nodiscard]] Eigen::VectorXd initial_parameters(const Model& model);

/// The model with parameter values written into its materials, sections, springs and masses (initial values follow).
[[nodiscard]] Model with_parameters(const Model& model, const Eigen::VectorXd& theta);

/// @throws InputError if K(theta) is singular: names a node and the directions in which it moves freely
void check_no_mechanism(const ParametricSystem& system, const Eigen::VectorXd& theta, const std::string& source);

}  // namespace twindeck::fe
