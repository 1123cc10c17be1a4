#pragma once

#include "diagnosis/law_search.hpp"

/// Private to src/diagnosis: weighs catalogue entries at a base by one law, at a few choices of its scales.
namespace twindeck::diagnosis {

/// Scale of the change that a cause leaves unexplained in its contrast: this part of its effect, and at least of one unit of
/// the class.
constexpr double kLeft = 0.1;
/// The scale is known within this factor: no model describes a change exactly.
constexpr double kLeftWithin = 2.0;

/// Scale of the unexplained change. @param effect  RMS change of ln(frequency) by the cause
[[nodiscard]] double left_scale(double effect);

/// RMS change of the frequencies in the conditions where a cause acts.
[[nodiscard]] double effect_on(const Inference& inference, const Eigen::VectorXd& change, const std::vector<bool>& acts);

/// (n_conditions)
[[nodiscard]] std::vector<bool> acting_conditions(const LawSetting& setting, const Candidate& candidate, int contrast);

/// Prior odds against "nothing": of all causes of a contrast, of "something else", of channels [nats].
inline const double kOddsOfAChange = std::log(0.1);

/// Fills the entries with the candidates that change the rows, and sets the signatures of the base's system.
void collect_entries(const LawSetting& setting, LawSearch& search, const std::vector<const Candidate*>& candidates);

/// Weighs "nothing", "something else", and every entry alone, summed over its magnitudes. Fills the accounts, the best first.
void screen_by_law(const LawSetting& setting, LawSearch& search, const OneLaw& law);

/// Position of the first term that equals the largest one to rounding. For example, a sensor rotated either way gives equal
/// terms.
[[nodiscard]] Eigen::Index first_of_equals(const Eigen::VectorXd& terms);

void sort_accounts(std::vector<LawAccount>& accounts);

}  // namespace twindeck::diagnosis
