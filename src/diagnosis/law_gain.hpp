#pragma once

#include <cstdint>

#include "diagnosis/gain.hpp"
#include "diagnosis/inference/guard.hpp"
#include "diagnosis/law_search.hpp"

/// Private to src/diagnosis: prediction by the accounts of a search, for modes left out of the fit.
namespace twindeck::diagnosis {

/// The best error of the model that is more probable than no cause; null if there is none.
[[nodiscard]] const LawAccount* leading_model_error(const LawSearch& search);

/// Gain of the leading accounts over "nothing", each mode left out in turn. "Nothing" may include an error of the model.
/// @param bootstrap  number of resamplings of the modes @param seed  of them
[[nodiscard]] PredictiveGain gain_by_law(const LawSetting& setting, const LawSearch& search, int bootstrap, std::uint64_t seed);

/// Each mode predicted by fits to all others, without and with the causes of the leader. Both use the leader's scales, so that
/// only the causes differ. Modes that are open under the leader, or that one of the fits leaves without a partner, are left
/// out.
[[nodiscard]] std::vector<HeldOutMode> held_out_modes(const LawSetting& setting, const LawSearch& search);

/// Whether a set predicts left-out modes better than its best subset with one cause less. Causes on channels are not tested,
/// because a fault of a channel appears in all modes.
[[nodiscard]] bool each_cause_predicts(const LawSetting& setting, const LawSearch& search, const LawAccount& set, int bootstrap,
                                       std::uint64_t seed);

}  // namespace twindeck::diagnosis
