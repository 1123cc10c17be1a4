#pragma once

#include <optional>

#include "steps/diagnosis/setup.hpp"

/// Which of the measured rows step 9 fits, which it holds out, and which it leaves alone.
namespace twindeck::steps {

/// Leaves out the rows that the configuration names, and gives one name to a mode in all conditions where it says so.
/// @throws InputError  for a type or a mode that is none, and where no row is left
void choose_rows(const DiagnosisConfig& config, diagnosis::FeatureSet& features);

/// Leaves out the modes of which the model has none with a MAC of at least `least_mac`: what it has no mode for, such as a stay
/// that swings by itself where stays are bars, cannot be a residual of it.
/// @param least_mac  0: nothing is left out @return what was left out; nothing where all modes have one
[[nodiscard]] std::optional<Finding> leave_out_unpaired(double least_mac, const diagnosis::ScatterOptions& scatter,
                                                        const diagnosis::ReducedModel& model, diagnosis::FeatureSet& features);

/// Whether the model's form competes: asked for, or two states are compared, whose common error it takes out.
[[nodiscard]] bool with_form(const DiagnosisConfig& config, const diagnosis::FeatureSet& features);

/// Marks the rows that are kept from the fit: those that the configuration names, else by mark or rule.
/// @throws InputError  for a rule that matches no row
void hold_out(const DiagnosisConfig& config, diagnosis::FeatureSet& features);

}  // namespace twindeck::steps
