#pragma once

#include "runner/run_step.hpp"
#include "steps/wind/validation_config.hpp"
#include "wind/turbulence.hpp"

namespace twindeck::steps {

/// The turbulence that a configuration of step 8 names: its set, with its spectrum, its coherence and its decays. Steps 8 and
/// 10 read it alike.
/// @param context  registers the files as inputs
[[nodiscard]] wind::TurbulenceSet read_turbulence(const ValidationConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
