#pragma once

#include <string>
#include <vector>

#include "steps/measured/corrections.hpp"
#include "steps/measured/measured_tables.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

/// The part of a measurement that a step uses, and the corrections to apply to it.
struct MeasuredChoice {
  ConditionChoice conditions;
  std::vector<Correction> corrections;
};

/// `--condition NAME`, `--state NAME` and `--correct FILE`: the options of every step that reads measured modes or features.
[[nodiscard]] std::vector<Flag> measured_flags();

/// Reads these options.
/// @param condition  of the step's configuration: used if neither --condition nor --state is given
/// @throws InputError  see asked_corrections; an empty name
[[nodiscard]] MeasuredChoice asked_choice(StepContext& context, const std::string& condition = "");

}  // namespace twindeck::steps
