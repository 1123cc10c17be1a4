#pragma once

#include "blind/trial.hpp"

namespace twindeck::blind {

/// Prints the evidence of one case: the best entries with the stage they reached and what a joint fit from there leaves, the
/// truth's own place among them, and the fit that starts from the truth's own magnitudes.
void explain(const diagnosis::Inference& inference, const Sealed& seal, int entries);

/// The same, of case number `seed`.
void explain_case(const Bench& bench, std::uint64_t seed);

}  // namespace twindeck::blind
