#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "blind/form/calibration.hpp"
#include "blind/form/hidden.hpp"
#include "blind/held_numbers.hpp"
#include "diagnosis/diagnose.hpp"

/// One trial of the tier of form errors: a truth of another class, its measurement with errors, the diagnosis by the coarse
/// model, the score.
namespace twindeck::blind::form {

/// A trial before the diagnosis sees it.
struct FormCase {
  std::uint64_t seed = 0;
  Truth truth;
  Calibrated calibrated;
  Hidden hidden;
  double sigma =
      0.0;  ///< how much the hidden cause changes the rows, in deviations of their errors (root of the sum of squares)
  diagnosis::FeatureSet features;
};
/// @param level  form error instead of the one that is the seed's turn
[[nodiscard]] FormCase make_form_case(std::uint64_t seed, std::optional<double> level = {});

/// What the diagnosis said, and what it is worth.
struct FormScore {
  std::uint64_t seed = 0;
  Turn turn;
  std::string structure, words;
  double reached = 0.0, shape = 0.0, least_mac = 0.0, severity = 0.0, sigma = 0.0;
  int modes = 0, channels = 0, conditions = 0, rows = 0;
  std::string verdict, found;
  double log_odds = 0.0, form_frequency = 0.0, form_shape = 0.0, gain_low = 0.0;
  bool complete = false;      ///< every part of the answer is there
  bool reported = false;      ///< a cause is put forward, and "something else" is not among its rivals
  bool answered = false;      ///< named or ambiguous
  bool in_set = false;        ///< the truth is in the set of a cause
  bool further = false;       ///< … beside another that is not the truth
  bool localised = false;     ///< the set holds the form's main feature, which sits at one place
  bool gain_claimed = false;  ///< a cause is put forward and the interval of the left-out modes' gain lies above zero
  bool sized = false, covered = false;
  double size = 0.0, found_size = 0.0, low = 0.0, high = 0.0;
  std::vector<HeldNumber> numbers;           ///< of the diagnosis
  double seconds_made = 0.0, seconds = 0.0;  ///< CPU: to make the truth, to diagnose it
};

/// What is known of a trial before its diagnosis.
[[nodiscard]] FormScore prepare_score(const FormCase& hidden);
/// Runs the diagnosis with nothing set by hand, and scores it.
/// @param look  at the diagnosis while what it refers to lives; may be empty @throws what the diagnosis throws
void run_form_case(const FormCase& hidden, FormScore& score, const std::function<void(const diagnosis::Diagnosis&)>& look = {});
/// Prints what a trial hides, which features of the form make its error, and the evidence of the diagnosis.
void explain_form_case(std::uint64_t seed);

/// What a diagnosis is worth against what was hidden.
void score_answer(const FormCase& hidden, const diagnosis::Diagnosis& result, FormScore& score);

}  // namespace twindeck::blind::form
