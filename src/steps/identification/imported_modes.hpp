#pragma once

#include <optional>

#include "runner/run_step.hpp"

namespace twindeck::steps {

/// Reads the modes of `--modes FILE`, a universal file of the program that identified them (universal_modes.hpp).
/// @param std_pct  [%] standard deviation of each frequency, which the file does not hold; 0: stays empty
/// @return writes modes.csv, shapes.csv and channels.csv, which every step takes by `--modes`; nothing without the option
/// @throws InputError  for a folder, and as read_universal_modes
[[nodiscard]] std::optional<runner::Computation> imported_modes(double std_pct, runner::StepContext& context);

}  // namespace twindeck::steps
