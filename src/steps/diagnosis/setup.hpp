#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/bar_stays_effect.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/evidence.hpp"
#include "diagnosis/files/load_test_files.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "runner/run_step.hpp"
#include "steps/diagnosis/config.hpp"
#include "steps/diagnosis/read_files.hpp"

namespace twindeck::steps {

/// Everything that a diagnosis works on.
struct DiagnosisInputs {
  std::shared_ptr<diagnosis::DiagnosedModel> model;
  diagnosis::Structure structure;  ///< borrows from `model`
  diagnosis::Places places;
  std::unique_ptr<diagnosis::ReducedModel> reduced;
  long basis_modes = 0;  ///< that `reduced` was asked for
  diagnosis::FeatureSet features;
  std::vector<records::Correction> corrected;  ///< what of the features --correct has put right
  std::vector<diagnosis::Hypothesis> catalogue;
  std::vector<diagnosis::Finding> account;             ///< what claims and rows say before any odds
  diagnosis::LoadTestFiles load_tests;                 ///< where loads and gauges stand
  std::optional<diagnosis::BarStaysEffect> bar_stays;  ///< where stays swing that the model has as bars
  /// What the causes are put into: `model`, with the stays that swing as cables.
  std::shared_ptr<const diagnosis::DiagnosedModel> extended;
};

/// The model reduced, with its places, and the rows that it can be compared with.
[[nodiscard]] DiagnosisInputs prepare_diagnosis(const DiagnosisConfig& config, const DiagnosisFiles& files,
                                                runner::StepContext& context);

/// Positions of the computed modes that the configuration gives to measured ones, by the mode's name in rows.csv.
/// @param unmeasured  gets those that no row names
[[nodiscard]] std::map<std::string, int> bound_modes(const DiagnosisConfig& config, const DiagnosisInputs& inputs,
                                                     std::vector<std::string>* unmeasured = nullptr);

}  // namespace twindeck::steps
