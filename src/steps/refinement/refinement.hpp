#pragma once

#include <string>
#include <vector>

#include "io/config.hpp"
#include "matching/pairing_account.hpp"
#include "runner/run_step.hpp"

/// As-built changes and comparison with the measurement: paper section 4.1, Tables 6 and 7.
namespace twindeck::steps {

struct RefinementConfig {
  long n_modes = 15;                ///< computed modes that are written and compared
  long extra_modes = 5;             ///< modes solved for above those, so that followed modes are among them
  std::string variant = "refined";  ///< of the generator
  std::vector<std::string> pairs;   ///< published assignment, used if no shape was measured; empty: by order
  std::string condition;            ///< of the measured features; empty: see choose_condition
  double minimum_mac = matching::usual_minimum_mac;
  double least_paired = matching::usual_least_paired;
  double maximum_frequency_error = 0.35;
  double cluster_gap = 0.02;
  double sensor_tolerance_m = 0.5;  ///< largest distance of a sensor from its node
  [[nodiscard]] io::FieldTable fields();
};

/// The step: everything between the command line and the manifest.
[[nodiscard]] runner::Computation read_refinement(runner::StepContext& context, const RefinementConfig& config);

}  // namespace twindeck::steps
