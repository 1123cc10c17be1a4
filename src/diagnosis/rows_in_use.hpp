#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/evidence.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/prediction/feature_map.hpp"

/// Which of the measured rows a diagnosis fits, which it holds out, and which it leaves alone.
namespace twindeck::diagnosis {

/// What is used of the measured rows.
struct RowChoice {
  std::vector<std::string> left_out;  ///< types of rows, or "mode:8", that are not used
  bool names_alike = false;           ///< one name for a mode in all conditions, by likeness of shape
  double highest_Hz = 0.0;            ///< modes above it are left out; 0: none
};

/// Leaves out the rows that the choice names, and gives one name to a mode in all conditions where it says so.
/// @throws InputError  for a type or a mode that is none, and where no row is left
void choose_rows(const RowChoice& choice, FeatureSet& features);

/// Leaves out the modes of which the model has none with a MAC of at least `least_mac`: what it has no mode for, such as a stay
/// that swings by itself where stays are bars, cannot be a residual of it.
/// @param least_mac  0: nothing is left out @return what was left out; nothing where all modes have one
[[nodiscard]] std::optional<Finding> leave_out_unpaired(double least_mac, const ScatterOptions& scatter,
                                                        const ReducedModel& model, FeatureSet& features);

/// Leaves out the imaginary parts of shapes where the model has no damper: no cause of the catalogue could make them, and those
/// of close modes are far beyond their deviations. @return what was left out, if anything
[[nodiscard]] std::optional<Finding> leave_out_imaginary(const ReducedModel& model, FeatureSet& features);

/// Whether there are rows of modes. The error of a model's form is one of modes: load tests alone have none, and a part of the
/// covariance instead.
[[nodiscard]] bool has_rows_of_modes(const FeatureSet& features);

/// Marks the rows that are kept from the fit: those that the rules name, else by mark or rule.
/// @param rules  "condition", "condition/mode", "condition/mode/type", "condition/every_second", "none"
///               Without rules none of the modes is held out, since whole modes are left out one after another.
/// @throws InputError  for a rule that matches no row
void hold_out(const std::vector<std::string>& rules, FeatureSet& features);

}  // namespace twindeck::diagnosis
