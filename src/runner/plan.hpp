#pragma once

#include <filesystem>
#include <string>

#include "runner/run_step.hpp"

namespace twindeck::runner {

/// What --check prints of a step whose inputs are valid: what would run, how many files of which folder it reads, where it
/// would write, and how long the earlier run took whose results lie there. Several lines, each ended. Private to run_step.
/// @param out  folder to write
[[nodiscard]] std::string plan_of(const Step& step, const StepContext& context, const std::filesystem::path& out);

}  // namespace twindeck::runner
