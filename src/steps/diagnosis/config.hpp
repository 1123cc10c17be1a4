#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/rows_in_use.hpp"
#include "io/config.hpp"

namespace twindeck::steps {

/// Configuration of s9_diagnosis.
struct DiagnosisConfig {
  std::string catalogue;           ///< folder; empty: workflows/common/hypotheses or its installed copy
  std::string damper_places;       ///< file of places where dampers might stand instead
  std::string further_causes;      ///< folder of causes beside it, which may put a family at another set of places
  std::vector<std::string> pairs;  ///< "7X-8N", where no shape was measured
  double least_mac = 0.0;          ///< modes of which the model has none this alike are left out, and reported
  diagnosis::RowChoice rows;
  std::vector<std::string> hold_out;  ///< "condition", "condition/mode": in place of marks and rule
  double alpha = 0.01, residual_alpha = 0.001, residual_alpha_named = 0.01, either_within = 3.0, least_log_odds = 3.0;
  diagnosis::SearchOptions search;
  long most_refined = search.most_refined;
  long nulls = 0, most_causes = 4, modes = 24, zones = 24, nodes = 24;
  double sensor_tolerance_m = 0.5;
  std::string form =
      "on";  ///< the model's form may be wrong, and competes with every cause (decision 0013); "off": it is exact
  bool refine_locations = false;      ///< look round the leading cause before it is named (decision 0018): triples the time
  std::string stays = "as_modelled";  ///< "as_modelled": stays stay the bars that they are in the model
  std::string threshold_cache;        ///< folder of thresholds by hash
  diagnosis::ScatterOptions scatter;

  [[nodiscard]] io::FieldTable fields();
  /// Whether the model's form competes with the causes.
  [[nodiscard]] bool with_form(const diagnosis::FeatureSet& features) const;
};

}  // namespace twindeck::steps
