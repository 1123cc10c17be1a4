#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "identification/clustering.hpp"
#include "sensors/layout.hpp"
#include "sensors/setup_scores.hpp"

namespace twindeck::sensors {

/// One setup of the blind test: identified as if nothing were known.
struct BlindTest {
  std::string setup;
  std::vector<identification::DiagramPole> diagram;  ///< all frames; order = frame · 1000 + order
  std::vector<identification::Cluster> modes;
};
struct BlindTestResult {
  std::vector<BlindTest> tests;
  Eigen::VectorXd psd_frequency_Hz;
  std::vector<Eigen::MatrixXd> psd_m2_s3;  ///< one a test (n_frequencies × n_channels)
};

/// Section 3.1: white noise all over the bridge, independent from candidate to candidate; the model's modes by the trapezoidal
/// rule, every `downsample`-th sample, frames, SSI of each frame at all orders, criteria of stabilisation, cleaning over all
/// frames.
/// @param frequency_Hz (n_modes) @param setups  scored; those that the configuration names are tested
[[nodiscard]] BlindTestResult blind_test(const LayoutSettings& config, const Eigen::VectorXd& frequency_Hz,
                                         const std::vector<ScoredSetup>& setups, const Eigen::MatrixXd& phi,
                                         std::uint64_t seed);

}  // namespace twindeck::sensors
