#pragma once

#include <string>

#include "io/config.hpp"
#include "matching/pairing_account.hpp"
#include "runner/run_step.hpp"

/// As-built changes and comparison with the measurement: paper section 4.1, Tables 6 and 7.
namespace twindeck::steps {

struct RefinementConfig : matching::PairingSettings {
  long n_modes = 15;                ///< computed modes that are written and compared
  long extra_modes = 5;             ///< modes solved for above those, so that followed modes are among them
  std::string variant = "refined";  ///< of the generator
  std::string condition;            ///< of the measured features; empty: see choose_condition
  [[nodiscard]] io::FieldTable fields();
};

/// The step: everything between the command line and the manifest.
[[nodiscard]] runner::Computation read_refinement(runner::StepContext& context, const RefinementConfig& config);

}  // namespace twindeck::steps
