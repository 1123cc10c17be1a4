#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "records/corrections.hpp"

/// Faults of single channels, as corrections that the steps can make (`--correct FILE`).
namespace twindeck::diagnosis {

/// Corrections of the effects that are faults of channels alone: a sign, an exchange, a gain. An effect that these rows do not
/// distinguish from another entry gives no correction, because the channel may be right. Signs and factors come first, with the
/// recorded names. Exchanges follow in reverse order of the effects, which undoes the exchanges of the model.
/// @param channels  names of the channels, in the order of the features
[[nodiscard]] std::vector<records::Correction> corrections_of(const Diagnosis& result,
                                                              const std::vector<std::string>& channels);

/// Writes corrections.toml: the corrections made before this run, then those that it found. The file alone corrects the
/// recorded features as the run recommends. Nothing is written if nothing was found.
void write_corrections(const std::vector<records::Correction>& before, const std::vector<records::Correction>& found,
                       const std::filesystem::path& file);

/// What to do next, for people: "correct A5, then update: --correct …". Empty where nothing was found.
[[nodiscard]] std::vector<std::string> correction_advice(const std::vector<records::Correction>& found);

}  // namespace twindeck::diagnosis
