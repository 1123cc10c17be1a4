#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/eigenmodes.hpp"
#include "fe/assembly.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"
#include "fe/structure.hpp"

/// A structure on its way from its files to its modes: first as read and valid, then prestressed, assembled and ready to be
/// solved.
namespace twindeck::dynamics {

/// A model as its files hold it: valid, neither prestressed nor solved. `solvable` makes it ready.
struct ReadModel {
  std::shared_ptr<const fe::Structure> structure;  ///< null for a matrix model
  fe::ParametricSystem matrices;                   ///< of a matrix model
  std::string source;                              ///< folder or generator, for messages
  /// Null for a matrix model.
  [[nodiscard]] const fe::Model* fe_model() const { return structure ? &structure->model() : nullptr; }
  [[nodiscard]] const std::vector<fe::Parameter>& parameters() const {
    return structure ? structure->model().parameters : matrices.parameters;
  }
};

/// A model ready to be solved, from any source.
struct LoadedModel {
  std::shared_ptr<const fe::Model> model;          ///< null for a matrix model
  std::shared_ptr<const fe::Structure> structure;  ///< the same, numbered and assembled
  fe::ParametricSystem system;
  Eigen::VectorXd theta;     ///< (n_parameters) current values, in the parameters' units
  fe::PrestressState state;  ///< empty vectors for a matrix model
  std::string source;        ///< folder or generator, for messages
  /// For the writers of model_io; null for a matrix model.
  [[nodiscard]] const fe::Model* fe_model() const { return model.get(); }
};

/// @throws InputError  for an invalid model (fe::validate)
[[nodiscard]] ReadModel valid_model(fe::Model model);

/// Checks a model, finds its prestress and assembles it.
/// @throws InputError  for an invalid model, or a mechanism
[[nodiscard]] LoadedModel from_model(fe::Model model);

/// The same of a model that was read. What a step reads calls it in its computation alone.
/// @throws InputError  for a mechanism, or matrices that cannot belong to a structure (model_check.hpp)
[[nodiscard]] LoadedModel solvable(const ReadModel& read);

/// The same model, to be in equilibrium under its dead load with displacements "linear" or "large" (fe::Displacements);
/// "as_model", or a matrix model: as it is.
[[nodiscard]] ReadModel with_displacements(ReadModel read, const std::string& displacements, int load_steps);

/// The model with parameter values put in and its prestress found anew.
[[nodiscard]] LoadedModel with_values(const LoadedModel& loaded, const Eigen::VectorXd& theta);

/// The lowest modes, as many of `n_modes` as the structure has.
[[nodiscard]] EigenModes available_modes(const fe::ParametricSystem& system, const Eigen::VectorXd& theta, int n_modes);

/// How many of the lowest modes pairing with measured ones needs: `n_modes`, or where these end below the highest measured
/// frequency, as many as lie within the relative `error` above it.
[[nodiscard]] int modes_for_band(const fe::ParametricSystem& system, const Eigen::VectorXd& theta, int n_modes,
                                 const Eigen::VectorXd& measured_Hz, double error);

}  // namespace twindeck::dynamics
