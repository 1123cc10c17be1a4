#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "steps/measured/measured_input.hpp"

/// What the diagnosis found wrong with single channels, as corrections that the steps can make (`--correct FILE`).
namespace twindeck::steps {

/// Corrections of the effects that are faults of channels alone: a sign, an exchange, a gain. An effect that these rows do not
/// tell from another entry is none: nobody should turn a channel that may be right. Signs and factors come first, by the names
/// as recorded; then exchanges, the last found first, which is the order that undoes what the model of the channels does.
/// @param channels  names of the channels, in the order of the features
[[nodiscard]] std::vector<Correction> corrections_of(const diagnosis::Diagnosis& result,
                                                     const std::vector<std::string>& channels);

/// Writes corrections.toml where something was found: what was corrected before this run, then what it found, so that the file
/// alone brings the recorded features to what the run recommends. No file where nothing was found.
void write_corrections(const std::vector<Correction>& before, const std::vector<Correction>& found,
                       const std::filesystem::path& file);

/// What to do next, for people: "correct A5, then update: --correct …". Empty where nothing was found.
[[nodiscard]] std::vector<std::string> correction_advice(const std::vector<Correction>& found);

}  // namespace twindeck::steps
