#pragma once

#include <vector>

#include "diagnosis/causes/candidate.hpp"

/// Private to src/diagnosis: magnitudes at which a candidate's effect is larger or smaller by a factor.
namespace twindeck::diagnosis {

/// Whether the effect of a candidate grows with its first magnitude. There are three exceptions. The effect of a tuned cause
/// depends on its frequency. The position of a moved support is not a size. A candidate without unknowns has no magnitude.
[[nodiscard]] bool is_a_size(const Candidate& candidate);

/// Factors on the trial magnitudes (n_factors); only 1 if they cannot be scaled.
[[nodiscard]] std::vector<double> magnitude_factors(const Candidate& candidate);

/// First magnitude at which the effect of a candidate is about t times that at `a`: the logarithm of a factor and a rate scale,
/// other logarithms shift. Stays within the candidate's bounds.
[[nodiscard]] double scaled_magnitude(const Candidate& candidate, double a, double t);

}  // namespace twindeck::diagnosis
