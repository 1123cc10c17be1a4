#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/form_search.hpp"
#include "diagnosis/inference/verdict.hpp"

/// Private to src/diagnosis: what a search with a form error says of its entries, for the rules and for people.
namespace twindeck::diagnosis {

/// An entry of a search as a line of the ranking.
[[nodiscard]] Scored scored_of(const FormSearch& search, const FormEntry& entry, const Inference& informed);

/// Entries that these data can't tell from the leader, and what the rules look at.
struct Weighing {
  Weighed weighed;
  std::vector<std::size_t> members;  ///< positions among the entries, the leader's first
};
[[nodiscard]] Weighing weighing_of(const FormSearch& search, const std::vector<Scored>& ranking, const FormSetting& setting,
                                   const DiagnoseOptions& options);

/// The leader as a cause, with its set and their probabilities.
[[nodiscard]] Effect effect_from(const FormSearch& search, const std::vector<Scored>& ranking, const Weighing& weighing,
                                 const Ruling& ruling, const FormSetting& setting);

/// Widens the intervals of sizes in quadrature, on ln of the size (kg, |ln factor|): a size is in units of a model that is
/// wrong.
/// @param form_error  of frequencies, relative
void widen_for_form(std::vector<EffectParameter>& parameters, double form_error);
/// The same by a given standard deviation of ln of the size.
void widen_sizes(std::vector<EffectParameter>& parameters, double deviation);

}  // namespace twindeck::diagnosis
