#pragma once

#include <string>
#include <vector>

#include "io/config.hpp"
#include "steps/aerodynamics/config.hpp"

namespace twindeck::steps {

struct WindEvent {
  std::string name;        ///< "August"
  double speed_m_s = 0.0;  ///< mean speed at the decks
  std::string condition;   ///< of the campaign whose wind records are the measured side; empty: none
};

/// A numerical simulation of Table 13.
struct ValidationRun {
  std::string name;   ///< "NS1"
  std::string model;  ///< of Table 11, or "hybrid"
};

/// Configuration of s8_validation; decks, data, direction and damping are those of s7_aerodynamics.toml.
struct ValidationConfig {
  std::string aerodynamics;  ///< file of step 7's configuration; empty: the study's
  std::string set = "standin";
  std::string turbulence_file = "data/wind/turbulence_sets.csv", turbulence_set = "printed";
  double height_m = 14.5;
  bool frozen = true, dampers = true;
  long seeds = 20, n_modes = 30, static_shapes = 8, point_shapes = 1, anchors = 40;
  double duration_s = 600.0, lead_in_s = 60.0, step_s = 1.0 / 64.0, cutoff_Hz = 8.0;
  double level = 0.95;
  std::string equations = "consistent";
  std::vector<WindEvent> events;
  std::vector<ValidationRun> runs;
  double comfort_vertical_m_s2 = 0.7, comfort_lateral_m_s2 = 0.1;
  double full_model_check_s = 0.0;

  [[nodiscard]] io::FieldTable fields();
  [[nodiscard]] aero::Equations equation_choice() const;
};

}  // namespace twindeck::steps
