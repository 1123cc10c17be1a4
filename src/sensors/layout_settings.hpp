#pragma once

#include <string>
#include <vector>

#include "identification/clustering.hpp"

namespace twindeck::sensors {

/// How setups are scored, searched for and tested blindly; the step's configuration has a sentence for each value.
struct LayoutSettings {
  long n_modes = 10, channels = 16, draws = 500, free_setups = 2;
  double tolerance_m = 0.5;
  // the blind test
  std::vector<std::string> blind_setups;
  double duration_s = 8000.0, rate_Hz = 64.0, damping_ratio = 0.01, warm_up_s = 200.0;
  long downsample = 8, frames = 10, minimum_order = 10, maximum_order = 20, order_step = 2, block_rows = 30,
       welch_segment = 1024;
  identification::StabilisationCriteria criteria;
  identification::CleaningRule cleaning{0.95, 0.02, 5.0, 0.0};
};

}  // namespace twindeck::sensors
