#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/words/place_words.hpp"
#include "diagnosis/words/plain_words.hpp"

/// Room diagnosis/words: what a diagnosis says to people. It takes the diagnosis with its ids, locations and numbers, and the
/// model whose parts have names. It gives sentences, places and sizes in plain words; a step prints them and writes them down.
///
/// This file: the results of a diagnosis in sentences, with the same words and numbers on the terminal, in diagnosis.json and
/// in the report.
namespace twindeck::diagnosis {

struct Sentences {
  std::string what;             ///< the measured quantity with the largest misfit, and the number of standard deviations
  std::string why;              ///< the cause in words, its place, its sizes with intervals
  std::string how_sure;         ///< probability and rivals
  std::string how_much_better;  ///< the gain with its interval, or that there is none
  std::string next;             ///< one thing to do
};

/// Words for every location and cause that the entries of a diagnosis name.
/// @param ranking  of the result; it may name entries that were added around the leading one
[[nodiscard]] IdsInWords ids_in_words(const PlaceWords& places, const Inference& inference,
                                      const std::vector<Scored>& ranking = {});

/// Puts the sentences and measurements of the effects, and the message, into words for people: their ids and locations become
/// places, their numbers get three digits.
void put_into_words(Diagnosis& result, const PlaceWords& places, const IdsInWords& ids);

/// The gain to report: that of the held-out rows or, without any, that of leaving out each mode in turn.
[[nodiscard]] Gain told_gain(const Diagnosis& result);

/// Whether the gain's interval lies above zero.
[[nodiscard]] bool shows_gain(const Gain& gain);

/// Measurements that would decide open questions, the most useful first: between the members of a cluster, about one-sided
/// limits, about the remaining misfit. The last line names causes that these rows cannot show.
[[nodiscard]] std::vector<std::string> measure_next(const Diagnosis& result, const PlaceWords& places, const IdsInWords& ids,
                                                    const std::vector<Invisible>& invisible);

/// @param next  as measure_next gives it
[[nodiscard]] Sentences sentences_of(const Inference& inference, const Diagnosis& result, const PlaceWords& places,
                                     const IdsInWords& ids, const std::vector<std::string>& next);

/// Two-sided limit that n standard normal residuals keep together with 99 % (Sidak 1967).
[[nodiscard]] double sidak_limit(std::size_t n);

}  // namespace twindeck::diagnosis
