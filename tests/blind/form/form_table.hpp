#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "blind/form/form_trial.hpp"

namespace twindeck::blind::form {

/// A line of the score: of which trials, what counts as a hit, the target where there is one.
struct FormLine {
  std::string what;
  std::function<bool(const FormScore&)> of, hit;
  double target = -1.0;  ///< below 0: shown only
  bool at_least = true;
  double own_rate = -1.0;  ///< what few trials are held against (score_table.hpp, Judge::own_rates); below 0: nothing
};
[[nodiscard]] const std::vector<FormLine>& form_lines();

/// Prints the lines with exact intervals. A line is held when its point estimate reaches its target.
/// @return whether all lines with a target are held
bool print_form_lines(const std::vector<FormScore>& scores);
/// The same by level of the form error: counts only.
void print_by_level(const std::vector<FormScore>& scores);
/// By family of hidden causes: trials, answered, truth in the set, unknown.
void print_families(const std::vector<FormScore>& scores);
/// Whether few trials go with the rates: false for a count that a line's own rate gives less than once in a thousand runs, or
/// for an answer that is not complete.
[[nodiscard]] bool few_are_sound(const std::vector<FormScore>& scores);

/// One line of a run.
[[nodiscard]] std::string line_of(const FormScore& score);
/// All trials as CSV, one a row.
void write_form_csv(const std::vector<FormScore>& scores, const std::filesystem::path& file);

}  // namespace twindeck::blind::form
