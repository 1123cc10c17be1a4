#pragma once

#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// Rows of whole modes, as positions among the training rows. A block holds one model mode in all conditions. With fewer than
/// three modes, each condition of a mode is a block, because the form error hardly correlates them.
[[nodiscard]] std::vector<std::vector<int>> mode_blocks(const Inference& plain, const Fit& fit, bool by_condition = false);

}  // namespace twindeck::diagnosis
