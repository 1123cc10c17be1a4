#pragma once

#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// Rows of whole modes, as positions among the training rows: those of one model mode in all conditions. Of fewer than three
/// modes each condition's part is a block of its own: with the form error in the model these leak little.
[[nodiscard]] std::vector<std::vector<int>> mode_blocks(const Inference& plain, const Fit& fit, bool by_condition = false);

}  // namespace twindeck::diagnosis
