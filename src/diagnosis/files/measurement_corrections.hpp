#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "records/corrections.hpp"

/// What the diagnosis found wrong with single channels, as corrections that the steps can make (`--correct FILE`).
namespace twindeck::diagnosis {

/// Corrections of the effects that are faults of channels alone: a sign, an exchange, a gain. An effect that these rows do not
/// tell from another entry is none: nobody should turn a channel that may be right. Signs and factors come first, by the names
/// as recorded; then exchanges, the last found first, which is the order that undoes what the model of the channels does.
/// @param channels  names of the channels, in the order of the features
[[nodiscard]] std::vector<records::Correction> corrections_of(const Diagnosis& result,
                                                              const std::vector<std::string>& channels);

/// Writes corrections.toml where something was found: what was corrected before this run, then what it found, so that the file
/// alone brings the recorded features to what the run recommends. No file where nothing was found.
void write_corrections(const std::vector<records::Correction>& before, const std::vector<records::Correction>& found,
                       const std::filesystem::path& file);

/// What to do next, for people: "correct A5, then update: --correct …". Empty where nothing was found.
[[nodiscard]] std::vector<std::string> correction_advice(const std::vector<records::Correction>& found);

}  // namespace twindeck::diagnosis
