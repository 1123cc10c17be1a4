#pragma once

#include <string>
#include <vector>

#include "diagnosis/causes/candidate.hpp"
#include "diagnosis/intervals.hpp"

/// Objections to the size of a cause.
namespace twindeck::diagnosis {

/// Whether the interval of a single unknown that may have either sign includes zero, where there is no effect.
/// @param parameters  of the cause, with their 90 % intervals in their own units
[[nodiscard]] bool may_be_zero(const std::vector<EffectParameter>& parameters, const Candidate& candidate);

/// Whether a size (kg, N/m; no factor, no frequency) is at its lower bound, because the data ask for a smaller one. The cause
/// then fits by a side effect, such as an additional mode or a kink of a shape.
[[nodiscard]] bool at_its_least(const Cause& cause);

/// Why a cause of this size cannot be named; empty if there is no objection.
/// @param parameters  of the cause, with their 90 % intervals in their own units
[[nodiscard]] std::string objection_to_size(const Cause& cause, const std::vector<EffectParameter>& parameters);

}  // namespace twindeck::diagnosis
