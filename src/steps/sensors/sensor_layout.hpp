#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/config.hpp"
#include "steps/shared/layout.hpp"
#include "steps/shared/run_step.hpp"
#include "sysid/clustering.hpp"

/// s2_sensors: how well setups tell a model's modes apart (paper section 3.1).
namespace twindeck::steps {

struct SensorsConfig {
  std::string points, setups;
  long n_modes = 10, channels = 16, draws = 500, free_setups = 2;
  double tolerance_m = 0.5;
  // the blind test
  std::vector<std::string> blind_setups;
  double duration_s = 8000.0, rate_Hz = 64.0, damping_ratio = 0.01, warm_up_s = 200.0;
  long downsample = 8, frames = 10, minimum_order = 10, maximum_order = 20, order_step = 2, block_rows = 30,
       welch_segment = 1024;
  sysid::StabilisationCriteria criteria;
  sysid::CleaningRule cleaning{0.95, 0.02, 5.0, 0.0};

  io::FieldTable fields();
};

/// A setup with its scores.
struct ScoredSetup {
  std::string name, family;
  std::vector<Eigen::Index> rows;  ///< candidates, in the order of its channels
  std::vector<std::string> channels;
  double score = 0.0;            ///< R_k, Eq. (1)
  double log_determinant = 0.0;  ///< of modes scaled to unit norm over all candidates
  long draws = 0;                ///< candidate setups of its family that were drawn
  double best_drawn = 0.0, median_drawn = 0.0;
  double better_drawn_pct = 0.0;  ///< how many of them score lower
};

/// All candidates: two channels a point, vertical and radial.
[[nodiscard]] std::vector<LayoutChannel> candidate_channels(const std::vector<LayoutPoint>& points);

/// Scores of the given setups; for each, `draws` candidates of its family: the same lines and directions, points that share a
/// place moved together to another at random; and of 16 channels drawn freely the lowest `free_setups`, family "dec" (DC1, DC2,
/// …). Then the searches: effective independence, greatest determinant, least R_k by greedy start and exchange.
/// @param phi  (n_candidates × n_modes)
[[nodiscard]] std::vector<ScoredSetup> score_setups(const SensorsConfig& config, const std::vector<LayoutPoint>& points,
                                                    const std::vector<LayoutChannel>& candidates,
                                                    const std::vector<LayoutChannel>& setups, const Eigen::MatrixXd& phi,
                                                    std::uint64_t seed);

/// @throws InputError  for a setup of the blind test that score_setups will not score
void refuse_unknown_blind_setups(const SensorsConfig& config, const std::vector<LayoutChannel>& setups);

/// One setup of the blind test: identified as if nothing were known.
struct BlindTest {
  std::string setup;
  std::vector<sysid::DiagramPole> diagram;  ///< all frames; order = frame · 1000 + order
  std::vector<sysid::Cluster> modes;
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
[[nodiscard]] BlindTestResult blind_test(const SensorsConfig& config, const Eigen::VectorXd& frequency_Hz,
                                         const std::vector<ScoredSetup>& setups, const Eigen::MatrixXd& phi,
                                         std::uint64_t seed);

/// The step.
[[nodiscard]] Computation read_sensors(StepContext& context, const SensorsConfig& config);

}  // namespace twindeck::steps
