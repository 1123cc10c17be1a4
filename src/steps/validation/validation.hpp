#pragma once

#include <Eigen/Core>
#include <string>

#include "buffeting/interval.hpp"
#include "steps/validation/check.hpp"
#include "steps/validation/config.hpp"
#include "steps/validation/measured.hpp"
#include "steps/validation/setup.hpp"

/// Step 8: the bridge in turbulent wind (paper sections 5.2 and 6, Tables 13, 14, Fig. 21).
namespace twindeck::steps {

/// Results of an event and a run: a row a sensor, a column a seed.
struct RunResult {
  std::string event, run, model;
  Eigen::MatrixXd rms, peak;                    ///< [m/s²] (n_sensors × n_seeds)
  Eigen::VectorXd spectral_rms;                 ///< (n_sensors) frequency domain, derivatives frozen as in time
  Eigen::VectorXd spectral_rms_each_frequency;  ///< the same with derivatives at each frequency's own
  Status status;
};

/// The step.
[[nodiscard]] Computation read_validation(StepContext& context, const ValidationConfig& config);

}  // namespace twindeck::steps
