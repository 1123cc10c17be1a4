#pragma once

#include <string>
#include <vector>

#include "steps/shared/corrections.hpp"
#include "steps/shared/measured_tables.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

/// Which part of a measurement a step looks at, and what of it is put right first.
struct MeasuredChoice {
  ConditionChoice conditions;
  std::vector<Correction> corrections;
};

/// `--condition NAME`, `--state NAME` and `--correct FILE`: the options of every step that reads measured modes or features.
[[nodiscard]] std::vector<Flag> measured_flags();

/// What these options say.
/// @param condition  of the step's configuration: what holds where neither --condition nor --state is given
/// @throws InputError  see asked_corrections; an empty name
[[nodiscard]] MeasuredChoice asked_choice(StepContext& context, const std::string& condition = "");

}  // namespace twindeck::steps
