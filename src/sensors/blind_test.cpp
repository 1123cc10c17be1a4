#include "sensors/blind_test.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "identification/ssi_cov.hpp"
#include "signal/condition.hpp"
#include "signal/correlation.hpp"
#include "signal/welch.hpp"
#include "transient/trapezoidal.hpp"

namespace twindeck::sensors {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kFrameStride = 1000;  // keeps the orders of different frames apart in one list

/// Modal accelerations under white loads at all candidates, alike and independent, drawn there and projected; their density
/// gives the modes 1 (N²/kg)/Hz in the mean. One row a sample.
MatrixXd modal_accelerations(const LayoutSettings& config, const VectorXd& frequency_Hz, const MatrixXd& phi,
                             std::uint64_t seed) {
  constexpr std::uint64_t kStream = 1000000;  // beyond those of the draws of setups
  const Index n = frequency_Hz.size(), samples = std::lround(config.duration_s * config.rate_Hz);
  const Index warm_up = std::lround(config.warm_up_s * config.rate_Hz);
  const double density = std::sqrt(static_cast<double>(n)) / phi.norm();
  const MatrixXd load = std::sqrt(0.5 * config.rate_Hz) * density * phi.transpose();
  transient::TrapezoidalStepper stepper(2.0 * std::numbers::pi * frequency_Hz, VectorXd::Constant(n, config.damping_ratio),
                                        1.0 / config.rate_Hz);
  MatrixXd out(samples, n);
  VectorXd white(phi.rows());
  for (Index t = -warm_up; t < samples; ++t) {
    const auto first = static_cast<std::uint64_t>((t + warm_up) * white.size());
    for (Index i = 0; i < white.size(); ++i) white[i] = white_number(seed, kStream, first + static_cast<std::uint64_t>(i));
    stepper.step(load * white);
    if (t >= 0) out.row(t) = stepper.acceleration();
  }
  return out;
}

BlindTest identify_frames(const LayoutSettings& config, const ScoredSetup& setup, const MatrixXd& data, double rate_Hz) {
  BlindTest test;
  test.setup = setup.name;
  std::vector<int> orders, all_orders;
  for (long n = config.minimum_order; n <= config.maximum_order; n += config.order_step) orders.push_back(static_cast<int>(n));
  std::vector<Index> references(static_cast<std::size_t>(data.cols()));
  for (std::size_t c = 0; c < references.size(); ++c) references[c] = static_cast<Index>(c);
  const Index length = data.rows() / config.frames;
  const identification::PoleLimits limits{0.0, 0.8 * 0.5 * rate_Hz, 0.2};
  for (long frame = 0; frame < config.frames; ++frame) {
    const MatrixXd part = signal::detrended(data.middleRows(frame * length, length));
    const std::vector<MatrixXd> lags = signal::correlations(part, references, 2 * config.block_rows, 1).mean();
    const auto poles = identification::poles_of_orders(
        identification::ssi_cov(lags, config.block_rows, data.cols(), config.maximum_order), orders, rate_Hz);
    for (identification::DiagramPole pole : identification::stabilisation_diagram(poles, config.criteria, limits)) {
      pole.pole.order += static_cast<int>(frame) * kFrameStride;
      test.diagram.push_back(std::move(pole));
    }
    for (const int order : orders) all_orders.push_back(order + static_cast<int>(frame) * kFrameStride);
  }
  test.modes = identification::identify_clusters(test.diagram, all_orders, config.cleaning);
  return test;
}

}  // namespace

BlindTestResult blind_test(const LayoutSettings& config, const VectorXd& frequency_Hz, const std::vector<ScoredSetup>& setups,
                           const MatrixXd& phi, std::uint64_t seed) {
  // The filter is linear, so that the modes are downsampled once and for all setups.
  const MatrixXd modal = signal::decimated(modal_accelerations(config, frequency_Hz, phi, seed), config.downsample);
  const double rate_Hz = config.rate_Hz / static_cast<double>(config.downsample);
  std::vector<const ScoredSetup*> chosen;
  for (const std::string& name : config.blind_setups) {
    const auto at = std::ranges::find_if(setups, [&](const ScoredSetup& s) { return s.name == name; });
    TWINDECK_ASSERT(at != setups.end());
    chosen.push_back(&*at);
  }
  BlindTestResult result;
  result.tests.resize(chosen.size());
  result.psd_m2_s3.resize(chosen.size());
  parallel_for(chosen.size(), [&](std::size_t i) {
    const MatrixXd data = modal * phi(chosen[i]->rows, Eigen::all).transpose();
    result.tests[i] = identify_frames(config, *chosen[i], data, rate_Hz);
    const signal::PowerSpectra spectra = signal::power_spectra(data, rate_Hz, {config.welch_segment, 0.5});
    result.psd_m2_s3[i] = spectra.density;
    if (i == 0) result.psd_frequency_Hz = spectra.frequency_Hz;
  });
  return result;
}

}  // namespace twindeck::sensors
