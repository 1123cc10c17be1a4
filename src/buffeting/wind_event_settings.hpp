#pragma once

#include <string>
#include <vector>

#include "aero/aeroelastic_system.hpp"
#include "wind/component.hpp"

namespace twindeck::buffeting {

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

/// Wind events, the simulations made in them, and how they are made.
struct WindEventSettings {
  double height_m = 14.5;
  bool frozen = true, dampers = true;
  long seeds = 20, n_modes = 30, static_shapes = 8, point_shapes = 1, anchors = 40;
  double duration_s = 600.0, lead_in_s = 60.0, step_s = 1.0 / 64.0, cutoff_Hz = 8.0;
  double level = 0.95;
  aero::Equations equations = aero::Equations::consistent;
  bool across = false;                 ///< u' loads the decks too
  std::string frequencies = "single";  ///< or "double_indexed"
  std::vector<WindEvent> events;
  std::vector<ValidationRun> runs;
  double comfort_vertical_m_s2 = 0.7, comfort_lateral_m_s2 = 0.1;
  double full_model_check_s = 0.0;

  /// v', w' and, where it loads the decks, u': the order of the columns of loads and gusts.
  [[nodiscard]] std::vector<wind::Component> components() const {
    std::vector<wind::Component> list = {wind::Component::along, wind::Component::vertical};
    if (across) list.push_back(wind::Component::across);
    return list;
  }
  [[nodiscard]] bool repeats() const { return frequencies == "single"; }
};

}  // namespace twindeck::buffeting
