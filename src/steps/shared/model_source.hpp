#pragma once

#include <filesystem>
#include <string>

#include "dynamics/loaded_model.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// The model that a step works on: `--model DIR` (or a file of another program) if given, otherwise the folder that an earlier
/// step wrote, with its files registered as inputs.
/// @throws InputError  naming the step to run first if there is neither
[[nodiscard]] dynamics::ReadModel load_model(runner::StepContext& context, const std::filesystem::path& default_folder);

/// The study's own model (study.toml [model]): a variant of the generator, or a folder or .inp file, which have no variants.
/// `--model DIR` takes precedence over both.
[[nodiscard]] dynamics::ReadModel load_study_model(runner::StepContext& context, const std::string& variant);

}  // namespace twindeck::steps
