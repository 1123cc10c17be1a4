#pragma once

#include "diagnosis/full_check.hpp"
#include "steps/diagnosis/setup.hpp"

namespace twindeck::steps {

/// The winner in the reduced basis against the full model, as the structure is in the last state: in the modes that those
/// measured in that state are paired with, or in the lowest one where none is. Says how far they agree, and warns where the
/// basis is too small for the measured modes.
[[nodiscard]] diagnosis::FullCheck checked_against_full(const DiagnosisInputs& inputs, const diagnosis::FeatureMap& map,
                                                        const diagnosis::Diagnosis& result, runner::StepContext& context);

}  // namespace twindeck::steps
