#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// A measured mode predicted from all other modes, without and with the causes.
struct HeldOutMode {
  std::string mode, condition;
  double frequency_before_pct = 0.0, frequency_after_pct = 0.0;  ///< predicted minus measured, over measured
  double damping_before_pct = 0.0, damping_after_pct = 0.0;      ///< the same for damping ratios with dampers, else NaN
  double mac_before = 0.0, mac_after = 0.0;                      ///< [-] with the measured shape; NaN where there is none
};

/// Improvement by the causes on held-out rows.
struct Gain {
  int rows = 0;
  double before = 0.0, after = 0.0;  ///< RMS of standardised held-out residuals
  double reduction_pct = 0.0, low_pct = 0.0, high_pct = 0.0;
  std::string held_out;
  std::vector<HeldOutMode> modes = {};
};

/// Gain of `after` over `before` on the held-out rows, 90 % interval over resampled blocks (a mode or record of one condition
/// each).
[[nodiscard]] Gain held_out_gain(const Inference& inference, const Fit& before, const Fit& after, int bootstrap,
                                 std::uint64_t seed);

/// Standardised residuals of every row at a fit, e = (y - g)/sigma_id; the level of a record that is held out completely is
/// removed.
[[nodiscard]] Eigen::VectorXd standardised_residuals(const Inference& inference, const Fit& fit);

}  // namespace twindeck::diagnosis
