#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "broken_inputs/case_table.hpp"
#include "broken_inputs/worker.hpp"

namespace twindeck::broken {

/// Everything below a folder: path -> content; folders, links and pipes say what they are.
using Snapshot = std::map<std::string, std::string>;
[[nodiscard]] Snapshot snapshot(const std::filesystem::path& folder);

/// What a case's run left.
struct Evidence {
  Outcome outcome;
  Snapshot before, after;  ///< of the folder that holds the run's working folder
  std::string out;         ///< --out below it: "work/out/s1_model"
};

/// Everything that is not as it should be; empty where the case is met. Held against each other are
///   - the exit code,
///   - on failure, stderr: one line that begins with the step's token, holds the words, and neither control bytes nor bytes
///   that
///     are no UTF-8; stdout: empty,
///   - on success, the words: with --quiet in stdout or a file of --out, without it (warnings) in stderr,
///   - files: on failure none but <out>.unconverged (exit code 1) may appear, change or go; on success none outside --out.
[[nodiscard]] std::vector<std::string> faults(const Case& c, const Evidence& evidence);

/// What is wrong with the answer of --check: it must be the run's line and exit code where the run refuses its input, and exit
/// code 0 otherwise. @param only_computing_shows_it  the fault is none of the files: --check takes it
/// @return empty where the answer is right
[[nodiscard]] std::string fault_of_check(const Outcome& checked, const Outcome& ran, bool only_computing_shows_it);

/// Lines that a step says of its inputs and that its manifest does not hold, as a warning or a note.
/// @param said  stderr of --check without --quiet, which reads the inputs and nothing more @param manifest  text of the run's
/// manifest.json
[[nodiscard]] std::vector<std::string> unrecorded(const std::string& step, const std::string& said,
                                                  const std::string& manifest);

}  // namespace twindeck::broken
