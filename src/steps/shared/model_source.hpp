#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "dynamics/loaded_model.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

/// Reads a model folder, of finite elements or of matrices.
[[nodiscard]] dynamics::ReadModel read_model_folder(const std::filesystem::path& folder);

/// Reads an .inp file of CalculiX or Abaqus (model_io/inp.hpp), or a deck of ANSYS (model_io/ansys.hpp), and reports what it
/// cannot use, with the mass of the whole.
[[nodiscard]] dynamics::ReadModel import_inp(StepContext& context, const std::filesystem::path& file);

/// Reads a Nastran deck (model_io/nastran.hpp), registers the files that it includes, and reports what it cannot use.
[[nodiscard]] dynamics::ReadModel import_nastran(StepContext& context, const std::filesystem::path& file);

/// Reads a file of another program: Nastran, else .inp or ANSYS.
[[nodiscard]] dynamics::ReadModel import_file(StepContext& context, const std::filesystem::path& file);

/// The model that a step works on: `--model DIR` (or a file of another program) if given, otherwise the folder that an earlier
/// step wrote, with its files registered as inputs.
/// @throws InputError  naming the step to run first if there is neither
[[nodiscard]] dynamics::ReadModel load_model(StepContext& context, const std::filesystem::path& default_folder);

/// The study's own model (study.toml [model]): a variant of the generator, or a folder or .inp file, which have no variants.
/// `--model DIR` takes precedence over both.
[[nodiscard]] dynamics::ReadModel load_study_model(StepContext& context, const std::string& variant);

/// Writes the model as a model folder, with `theta` as its values, and the load cases of the folder that it came from.
void save_model(const dynamics::LoadedModel& loaded, const Eigen::VectorXd& theta, const std::filesystem::path& folder);

}  // namespace twindeck::steps
