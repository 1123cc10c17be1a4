#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/evidence.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/prediction/feature_map.hpp"

/// Division of the measured rows: rows that a diagnosis fits, holds out, or does not use.
namespace twindeck::diagnosis {

/// Choice of the rows to use.
struct RowChoice {
  std::vector<std::string> left_out;  ///< types of rows, or "mode:8", that are not used
  bool names_alike = false;           ///< one name for a mode in all conditions, by likeness of shape
  double highest_Hz = 0.0;            ///< modes above it are left out; 0: none
};

/// Leaves out the rows that the choice names. If asked for, gives one name to a mode in all conditions.
/// @throws InputError  for a type or a mode that is none, and where no row is left
void choose_rows(const RowChoice& choice, FeatureSet& features);

/// Leaves out measured modes without a mode of the model of MAC `least_mac` or more. The model cannot predict them; an example
/// is a swinging stay if stays are bars.
/// @param least_mac  0: nothing is left out @return what was left out; empty if nothing
[[nodiscard]] std::optional<Finding> leave_out_unpaired(double least_mac, const ScatterOptions& scatter,
                                                        const ReducedModel& model, FeatureSet& features);

/// Leaves out the imaginary parts of shapes if the model has no damper. No cause of the catalogue could explain them, and those
/// of close modes are far above their deviations. @return what was left out, if anything
[[nodiscard]] std::optional<Finding> leave_out_imaginary(const ReducedModel& model, FeatureSet& features);

/// Whether there are rows of modes. The form error of the model acts on modes. Load tests alone have a part of the covariance
/// instead.
[[nodiscard]] bool has_rows_of_modes(const FeatureSet& features);

/// Marks the rows that are held out: those that the rules name, else those with marks.
/// @param rules  "condition", "condition/mode", "condition/mode/type", "condition/every_second", "none". Without rules and
///         marks no mode is held out, because modes are left out in turn.
/// @throws InputError  for a rule that matches no row
void hold_out(const std::vector<std::string>& rules, FeatureSet& features);

}  // namespace twindeck::diagnosis
