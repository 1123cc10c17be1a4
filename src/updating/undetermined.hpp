#pragma once

#include <string>
#include <vector>

#include "core/reporter.hpp"
#include "updating/weighing.hpp"

namespace twindeck::updating {

/// What the data do not determine at the published end (UpdatingResult::flat), in sentences. One for each parameter that
/// nothing depends on, and one for all that change nothing together.
[[nodiscard]] std::vector<std::string> undetermined_sentences(const Weighed& weighed);

/// Warns of them, with any weights.
void warn_of_undetermined(Reporter& reporter, const Weighed& weighed);

}  // namespace twindeck::updating
