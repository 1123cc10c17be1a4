#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"

namespace twindeck::steps {

/// Writes `folder` as a model that every step accepts, with the parameters of the extended fit and the causes put in as far as
/// a model folder can say them; extension.toml lists each cause with its numbers and whether the model holds it. Causes on the
/// measurement's side leave the model as it is and correct channels.csv beside it.
/// @param state  of the structure that the model is of: causes that act in others alone are listed and not put in
/// @param several  whether there are others, which extension.toml then tells apart
/// @return the causes that were left out for their state
[[nodiscard]] std::vector<std::string> write_extended_model(const diagnosis::DiagnosedModel& model,
                                                            const diagnosis::Places& places, const diagnosis::Diagnosis& result,
                                                            const std::string& state, bool several,
                                                            const std::filesystem::path& folder);

}  // namespace twindeck::steps
