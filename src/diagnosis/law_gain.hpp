#pragma once

#include <cstdint>

#include "diagnosis/gain.hpp"
#include "diagnosis/inference/guard.hpp"
#include "diagnosis/law_search.hpp"

/// Private to src/diagnosis: what the accounts of a search say of modes that they were not fitted to.
namespace twindeck::diagnosis {

/// The account of the model's errors that says more than no cause, null where there is none.
[[nodiscard]] const LawAccount* leading_model_error(const LawSearch& search);

/// Gain of the leading accounts over nothing, each mode left out in turn. Nothing may be an error of the model.
/// @param bootstrap  number of resamplings of the modes @param seed  of them
[[nodiscard]] PredictiveGain gain_by_law(const LawSetting& setting, const LawSearch& search, int bootstrap, std::uint64_t seed);

/// Each mode by fits to all others, without and with the causes of the leader. Both weigh the rows by the leader's scales, so
/// that nothing differs but the causes. Modes that the leader holds for none of the model's, and those that one of the two
/// pairs with none, are left out.
[[nodiscard]] std::vector<HeldOutMode> held_out_modes(const LawSetting& setting, const LawSearch& search);

/// Whether a set predicts modes that it was not fitted to better than the best of its causes do without one of them. What is
/// wrong with channels shows in every mode alike, and a mode left out cannot tell.
[[nodiscard]] bool each_cause_predicts(const LawSetting& setting, const LawSearch& search, const LawAccount& set, int bootstrap,
                                       std::uint64_t seed);

}  // namespace twindeck::diagnosis
