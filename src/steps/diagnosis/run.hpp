#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/rows_in_use.hpp"
#include "io/config.hpp"
#include "runner/run_step.hpp"

namespace twindeck::steps {

/// Configuration of s9_diagnosis.
struct DiagnosisConfig {
  std::string catalogue;           ///< folder; empty: workflows/common/hypotheses or its installed copy
  std::string damper_places;       ///< file of places where dampers might stand instead
  std::string further_causes;      ///< folder of causes added to the catalogue; it may put a family at other locations
  std::vector<std::string> pairs;  ///< "7X-8N", where no shape was measured
  double least_mac = 0.0;          ///< least MAC of a measured mode with one of the model; others are left out and reported
  diagnosis::RowChoice rows;
  std::vector<std::string> hold_out;  ///< "condition", "condition/mode"; replaces marks and rule
  int most_causes = diagnosis::DiagnoseOptions{}.most_causes, modes = 24, zones = 0, nodes = 0;
  double sensor_tolerance_m = 0.5;
  std::string stays = "as_modelled";  ///< "as_modelled": stays stay the bars that they are in the model
  diagnosis::ScatterOptions scatter;

  [[nodiscard]] io::FieldTable fields();
};

/// The step.
[[nodiscard]] runner::Computation read_diagnosis(const DiagnosisConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
