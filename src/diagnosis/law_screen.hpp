#pragma once

#include "diagnosis/law_search.hpp"

/// Private to src/diagnosis: entries of the catalogue at a base, each weighed by the one law at a few choices of its scales.
namespace twindeck::diagnosis {

/// Scale of what a cause leaves over in its contrast: this part of its effect, and of a unit of the class at least.
constexpr double kLeft = 0.1;

/// Scale of what a cause leaves over. @param effect  RMS change of its frequencies, ln
[[nodiscard]] double left_scale(double effect);

/// RMS change of the frequencies in the conditions where something acts.
[[nodiscard]] double effect_on(const Inference& inference, const Eigen::VectorXd& change, const std::vector<bool>& acts);

/// (n_conditions)
[[nodiscard]] std::vector<bool> acting_conditions(const LawSetting& setting, const Candidate& candidate, int contrast);

/// Prior of all causes of a contrast against nothing, of "something else", of channels [nats].
inline const double kOddsOfAChange = std::log(0.1);

/// Fills entries for those of some candidates that show, and the signatures of the base's system.
void collect_entries(const LawSetting& setting, LawSearch& search, const std::vector<const Candidate*>& candidates);

/// Weighs nothing, something else, and every entry alone, its magnitudes summed over: the accounts, the best first.
void screen_by_law(const LawSetting& setting, LawSearch& search, const OneLaw& law);

/// Place of the first term that no other exceeds beyond rounding: a sensor turned either way about its axis shows the same.
[[nodiscard]] Eigen::Index first_of_equals(const Eigen::VectorXd& terms);

void sort_accounts(std::vector<LawAccount>& accounts);

}  // namespace twindeck::diagnosis
