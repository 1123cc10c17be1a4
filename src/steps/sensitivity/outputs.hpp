#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fe/model.hpp"
#include "io/config.hpp"
#include "sensitivity/frequency_sensitivities.hpp"
#include "sensitivity/selection.hpp"

namespace twindeck::steps {

/// Configuration of s5_sensitivity.
struct SensitivityConfig : sensitivity::SensitivityOptions {
  std::string compared_modes_from = "list";  ///< "list" | "s4_refinement"
  std::vector<double> compared_modes;        ///< numbers from 1; empty: all n_modes
  double frequency_std_pct = 0.5;
  double selection_threshold = 1.0;
  double singular_value_cutoff = 1.0;
  double resolution_cutoff = 0.5;
  std::vector<std::string> published_selection;  ///< parameters that the paper selected; empty if nothing is published

  io::FieldTable fields();
};

/// @throws InputError  for a compared mode beyond n_modes, a published name that is no parameter, a model without parameters
void check_sensitivity_config(const SensitivityConfig& config, const std::vector<fe::Parameter>& parameters,
                              const std::string& source);

/// Numbers of the modes that step 4 paired with measured ones, ascending.
/// @param file  `pairs.csv` of s4_refinement
/// @throws InputError  if it has no pair
[[nodiscard]] std::vector<double> paired_modes(const std::filesystem::path& file);

[[nodiscard]] std::vector<std::string> parameter_names(const std::vector<fe::Parameter>& parameters);

/// What s5_sensitivity tells. Borrowed.
struct SensitivityOutcome {
  const std::vector<fe::Parameter>& parameters;
  const sensitivity::Sensitivities& found;
  const std::vector<sensitivity::SelectedParameter>& selection;  ///< one a parameter
  const sensitivity::Identifiability& identified;
};

/// sensitivity.csv, selection.csv, singular_values.csv, identifiability.csv.
void write_tables(const SensitivityOutcome& outcome, const SensitivityConfig& config, const std::filesystem::path& folder);

/// For people: agreement of the three ways, selection beside the paper's, directions that the frequencies see.
[[nodiscard]] std::vector<std::string> sensitivity_report(const SensitivityOutcome& outcome, const SensitivityConfig& config);

}  // namespace twindeck::steps
