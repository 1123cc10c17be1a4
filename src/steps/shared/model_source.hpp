#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "fe/assembly.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"
#include "fe/structure.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

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

/// Checks a model, finds its prestress and assembles it.
/// @throws InputError  for an invalid model, or a mechanism
[[nodiscard]] LoadedModel from_model(fe::Model model);

/// The same of a model that was read. What a step reads calls it in its computation alone.
/// @throws InputError  for a mechanism, or matrices that cannot belong to a structure (model_check.hpp)
[[nodiscard]] LoadedModel solvable(const ReadModel& read);

/// Reads a model folder, of finite elements or of matrices.
[[nodiscard]] ReadModel read_model_folder(const std::filesystem::path& folder);

/// Reads an .inp file of CalculiX or Abaqus (model_io/inp.hpp), or a deck of ANSYS (model_io/ansys.hpp), and reports what it
/// cannot use, with the mass of the whole.
[[nodiscard]] ReadModel import_inp(StepContext& context, const std::filesystem::path& file);

/// Reads a Nastran deck (model_io/nastran.hpp), registers the files that it includes, and reports what it cannot use.
[[nodiscard]] ReadModel import_nastran(StepContext& context, const std::filesystem::path& file);

/// Reads a file of another program: Nastran, else .inp or ANSYS.
[[nodiscard]] ReadModel import_file(StepContext& context, const std::filesystem::path& file);

/// The model that a step works on: `--model DIR` (or a file of another program) if given, otherwise the folder that an earlier
/// step wrote, with its files registered as inputs.
/// @throws InputError  naming the step to run first if there is neither
[[nodiscard]] ReadModel load_model(StepContext& context, const std::filesystem::path& default_folder);

/// The study's own model (study.toml [model]): a variant of the generator, or a folder or .inp file, which have no variants.
/// `--model DIR` takes precedence over both.
[[nodiscard]] ReadModel load_study_model(StepContext& context, const std::string& variant);

/// The same model, to be in equilibrium under its dead load with displacements "linear" or "large" (fe::Displacements);
/// "as_model", or a matrix model: as it is.
[[nodiscard]] ReadModel with_displacements(ReadModel read, const std::string& displacements, int load_steps);

/// Writes the model as a model folder, with `theta` as its values, and the load cases of the folder that it came from.
void save_model(const LoadedModel& loaded, const Eigen::VectorXd& theta, const std::filesystem::path& folder);

}  // namespace twindeck::steps
