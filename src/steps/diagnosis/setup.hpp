#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/bar_stays_effect.hpp"
#include "diagnosis/causes/catalogue.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/evidence.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/files/load_test_files.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "diagnosis/rows_in_use.hpp"
#include "io/config.hpp"
#include "runner/run_step.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/shared/model_source.hpp"

namespace twindeck::steps {

/// Configuration of s9_diagnosis.
struct DiagnosisConfig {
  std::string catalogue;           ///< folder; empty: workflows/common/hypotheses or its installed copy
  std::string damper_places;       ///< file of places where dampers might stand instead
  std::string further_causes;      ///< folder of causes beside it, which may put a family at another set of places
  std::vector<std::string> pairs;  ///< "7X-8N", where no shape was measured
  double least_mac = 0.0;          ///< MAC of a measured mode with one of the model; others are left out and reported
  diagnosis::RowChoice rows;
  std::vector<std::string> hold_out;  ///< "condition", "condition/mode": in place of marks and rule
  long most_causes = diagnosis::DiagnoseOptions{}.most_causes, modes = 24, zones = 24, nodes = 24;
  double sensor_tolerance_m = 0.5;
  std::string stays = "as_modelled";  ///< "as_modelled": stays stay the bars that they are in the model
  diagnosis::ScatterOptions scatter;

  [[nodiscard]] io::FieldTable fields();
};

/// What a diagnosis reads, before anything is solved.
struct DiagnosisFiles {
  std::filesystem::path folder;                ///< of the features
  diagnosis::FeatureSet features;              ///< the rows in use
  std::vector<diagnosis::Row> stay_rows;       ///< all frequencies of stays, in use or not
  std::vector<records::Correction> corrected;  ///< what of the features --correct has put right
  std::vector<matching::Channel> channels;
  std::vector<diagnosis::Claim> claims;
  std::vector<diagnosis::Hypothesis> catalogue;
  dynamics::ReadModel model;
  std::vector<diagnosis::DamperMove> moves;
};

/// @throws InputError  for a file that is not sound, and for a name in one of them that the others do not have
[[nodiscard]] DiagnosisFiles read_diagnosis_files(const DiagnosisConfig& config, runner::StepContext& context);

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
