#pragma once

#include <string>
#include <vector>

#include "diagnosis/causes/candidate.hpp"
#include "diagnosis/intervals.hpp"

/// Sizes with which a cause that stands out is none.
namespace twindeck::diagnosis {

/// Whether the interval of the one unknown, a size that may have either sign, holds zero, where there is no effect.
/// @param parameters  of the cause, with their 90 % intervals in their own units
[[nodiscard]] bool may_be_zero(const std::vector<EffectParameter>& parameters, const Candidate& candidate);

/// Whether a size (kg, N/m; no factor, no frequency) has run to the least that counts as this cause, where the data ask for a
/// smaller one. What then fits is what comes with the cause, as a mode more or a kink of a shape, and not its size.
[[nodiscard]] bool at_its_least(const Cause& cause);

/// Why a cause of this size cannot be named; empty: its size says nothing against it.
/// @param parameters  of the cause, with their 90 % intervals in their own units
[[nodiscard]] std::string objection_to_size(const Cause& cause, const std::vector<EffectParameter>& parameters);

}  // namespace twindeck::diagnosis
