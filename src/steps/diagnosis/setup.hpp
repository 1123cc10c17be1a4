#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "io/config.hpp"
#include "steps/diagnosis/evidence.hpp"
#include "steps/diagnosis/extended_stays.hpp"
#include "steps/diagnosis/load_tests.hpp"
#include "steps/diagnosis/model.hpp"
#include "steps/measured/corrections.hpp"
#include "steps/shared/run_step.hpp"

namespace twindeck::steps {

/// Configuration of s9_diagnosis.
struct DiagnosisConfig {
  std::string catalogue;              ///< folder; empty: workflows/common/hypotheses or its installed copy
  std::string damper_places;          ///< file of places where dampers might stand instead
  std::string further_causes;         ///< folder of causes beside it, which may put a family at another set of places
  std::vector<std::string> pairs;     ///< "7X-8N", where no shape was measured
  std::vector<std::string> left_out;  ///< types of rows, or "mode:8", that are not used
  double least_mac = 0.0;             ///< modes of which the model has none this alike are left out, and reported
  bool names_alike = false;           ///< one name for a mode in all conditions, by likeness of shape
  double highest_Hz = 0.0;            ///< modes above it are left out; 0: none
  std::vector<std::string> hold_out;  ///< "condition", "condition/mode": in place of marks and rule
  double alpha = 0.01, residual_alpha = 0.001, either_within = 3.0, least_log_odds = 3.0;
  diagnosis::SearchOptions search;
  long most_refined = search.most_refined;
  long nulls = 0, most_causes = 4, modes = 24, zones = 24, nodes = 24;
  double sensor_tolerance_m = 0.5;
  std::string form = "auto";  ///< "on": the model's form may be wrong, and competes with every cause (decision 0013); "auto":
                              ///< where states are compared
  std::string stays = "as_modelled";  ///< "as_modelled": stays stay the bars that they are in the model
  std::string threshold_cache;        ///< folder of thresholds by hash
  diagnosis::ScatterOptions scatter;

  [[nodiscard]] io::FieldTable fields();
};

/// Everything that a diagnosis works on, made from files once.
struct DiagnosisInputs {
  std::shared_ptr<DiagnosedModel> model;
  diagnosis::Structure structure;  ///< borrows from `model`
  diagnosis::Places places;
  std::unique_ptr<diagnosis::ReducedModel> reduced;
  diagnosis::FeatureSet features;
  std::vector<Correction> corrected;  ///< what of the features --correct has put right
  std::vector<diagnosis::Hypothesis> catalogue;
  std::vector<Finding> account;             ///< what claims and rows say before any odds
  LoadTestFiles load_tests;                 ///< where loads and gauges stand
  std::optional<BarStaysEffect> bar_stays;  ///< where stays swing that the model had as bars; `model` has them as cables
};

[[nodiscard]] DiagnosisInputs read_diagnosis_inputs(const DiagnosisConfig& config, StepContext& context);

/// Threshold of the largest log odds: of cached nulls where the same model, rows (without their values), catalogue and rule
/// were run before, of nulls run now where the configuration asks for them, else the analytic tail.
struct Threshold {
  double value;
  std::string from;
};
[[nodiscard]] Threshold find_threshold(const DiagnosisConfig& config, const DiagnosisInputs& inputs,
                                       const diagnosis::Inference& inference, StepContext& context);

/// Positions of the computed modes that the configuration gives to measured ones, by the mode's name in rows.csv.
/// @param unmeasured  gets those that no row names
[[nodiscard]] std::map<std::string, int> bound_modes(const DiagnosisConfig& config, const DiagnosisInputs& inputs,
                                                     std::vector<std::string>* unmeasured = nullptr);

/// Runs the whole step.
[[nodiscard]] Status run_diagnosis(const DiagnosisConfig& config, StepContext& context);

}  // namespace twindeck::steps
