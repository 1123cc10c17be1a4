#pragma once

#include <cstdint>

#include "diagnosis/form_search.hpp"
#include "diagnosis/inference/guard.hpp"

/// Private to src/diagnosis: what a search's causes predict of modes that they were not fitted to.
namespace twindeck::diagnosis {

/// Leave-one-block-out gain of the catalogue over "nothing but the model's form", blocks of whole modes, each hypothesis at its
/// best scales (decision 0013). @param bootstrap  draws of the blocks
[[nodiscard]] PredictiveGain predictive_gain(const FormSetting& setting, const FormSearch& search, const Leftover& leftover,
                                             int bootstrap, std::uint64_t seed);

/// Rows of whole modes, as positions among the training rows: those of one model mode in all conditions. Of fewer than three
/// modes each condition's part is a block of its own: with the form error in the model these leak little.
[[nodiscard]] std::vector<std::vector<int>> mode_blocks(const Inference& plain, const Fit& fit, bool by_condition = false);

}  // namespace twindeck::diagnosis
