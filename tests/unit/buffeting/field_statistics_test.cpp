/// Oracles: samples of Deodatis' waves have the variance and spectra they were asked to have; samples twice as strong have
/// twice the deviation and four times the spectrum; points with independent gusts have no coherence; limits by hand.
#include "buffeting/field_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace twindeck::buffeting {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr long kStatisticsSeeds = 4;
constexpr double kStatisticsDuration_s = 150.0;

/// Five points 4 m apart across a wind of 15 m/s, with gusts of 20 m length.
wind::Simulator simulator_of(wind::Component component, double sigma = 1.0) {
  wind::FieldDefinition field;
  field.component = component;
  field.position_m = MatrixXd::Zero(5, 3);
  for (Index i = 0; i < 5; ++i) field.position_m(i, 1) = 4.0 * static_cast<double>(i);
  field.speed_m_s = Eigen::VectorXd::Constant(5, 15.0);
  field.sigma_m_s = Eigen::VectorXd::Constant(5, sigma);
  field.length_m = Eigen::VectorXd::Constant(5, 20.0);
  field.decay = {1.0, 6.0, 6.0};
  wind::SimulationOptions options;
  options.duration_s = kStatisticsDuration_s;
  options.rate_Hz = 16.0;
  options.cutoff_Hz = 4.0;
  options.anchors = 20;
  return {field, options};
}

std::map<std::string, FieldCheck> by_quantity(const std::vector<FieldCheck>& checks) {
  std::map<std::string, FieldCheck> out;
  for (const FieldCheck& check : checks) out[check.quantity] = check;
  return out;
}

/// The gusts of four seeds, v' of every point, then w'.
const std::vector<MatrixXd>& four_samples() {
  static const std::vector<MatrixXd> samples = [] {
    const wind::Simulator along = simulator_of(wind::Component::along, 2.0), vertical = simulator_of(wind::Component::vertical);
    std::vector<MatrixXd> out;
    for (std::uint64_t seed = 0; seed < kStatisticsSeeds; ++seed) {
      out.emplace_back(along.n_samples(), 10);
      out.back() << along.sample(seed), vertical.sample(seed);
    }
    return out;
  }();
  return samples;
}

/// Checks of four seeds whose gusts are changed by `change`.
std::map<std::string, FieldCheck> checks_of(const std::function<void(MatrixXd&)>& change) {
  const std::vector<wind::Simulator> simulators = {simulator_of(wind::Component::along, 2.0),
                                                   simulator_of(wind::Component::vertical)};
  FieldStatistics statistics("August", simulators, kStatisticsSeeds);
  for (long seed = kStatisticsSeeds - 1; seed >= 0; --seed) {  // in any order
    MatrixXd gusts = four_samples()[static_cast<std::size_t>(seed)];
    change(gusts);
    statistics.add(seed, gusts);
  }
  const std::vector<FieldCheck> checks = statistics.checks();
  EXPECT_EQ(checks.size(), 8U);
  for (const FieldCheck& check : checks) EXPECT_EQ(check.event, "August");
  return by_quantity(checks);
}

const std::map<std::string, FieldCheck>& unchanged() {
  static const std::map<std::string, FieldCheck> checks = checks_of([](MatrixXd&) {});
  return checks;
}

// The target is the deviation of the waves below the cutoff: sigma² less what lies outside. Limits of 20 seeds of 600 s grow by
// sqrt(12000/600) for four of 150 s.
TEST(FieldStatistics, SamplesHaveWhatTheyWereAskedToHave) {
  const auto& found = unchanged();
  const double scatter = std::sqrt(20.0);
  for (const auto& [name, check] : found) EXPECT_LT(std::abs(check.found - check.target), check.allowed) << name;
  const wind::Simulator along = simulator_of(wind::Component::along, 2.0);
  double band = 0.0;
  for (int l = 1; l < 4 * 150; ++l) band += along.field().spectrum(0, l / 150.0) / 150.0;
  const FieldCheck& sigma = found.at("sigma_v_mean_m_s");
  EXPECT_NEAR(sigma.target, std::sqrt(band), 1e-12);
  EXPECT_LT(sigma.target, 2.0);
  EXPECT_NEAR(sigma.allowed, 0.05 * scatter * sigma.target, 1e-12);
  EXPECT_NEAR(found.at("sigma_w_worst_point_m_s").allowed, 0.02 * scatter * found.at("sigma_w_mean_m_s").target, 1e-12);
  EXPECT_NEAR(found.at("psd_v_relative_error").allowed, 0.015 * scatter, 1e-13);
  EXPECT_NEAR(found.at("coherence_w_error").allowed, 0.05 * scatter, 1e-13);
}

// w' twice as strong: its deviation doubles, its spectrum is four times, so the relative error is about 3. Coherence and v'
// stay.
TEST(FieldStatistics, GustsOfAnotherStrengthAreSeen) {
  const auto right = unchanged(), found = checks_of([](MatrixXd&gusts) { gusts.rightCols(5) *= 2.0; });
  EXPECT_NEAR(found.at("sigma_w_mean_m_s").found, 2.0 * right.at("sigma_w_mean_m_s").found, 1e-12);
  EXPECT_NEAR(found.at("psd_w_relative_error").found, 3.0, 4.0 * right.at("psd_w_relative_error").found + 1e-12);
  EXPECT_GT(found.at("psd_w_relative_error").found, found.at("psd_w_relative_error").allowed);
  EXPECT_NEAR(found.at("coherence_w_error").found, right.at("coherence_w_error").found, 1e-12);
  for (const std::string name : {"sigma_v_mean_m_s", "psd_v_relative_error", "coherence_v_error"})
    EXPECT_EQ(found.at(name).found, right.at(name).found) << name;
}

// One point that is still: the worst point has no deviation, the mean four fifths.
TEST(FieldStatistics, TheWorstPointIsSeen) {
  const auto right = unchanged(), found = checks_of([](MatrixXd&gusts) { gusts.col(3) *= 1e-3; });
  EXPECT_LT(found.at("sigma_v_worst_point_m_s").found, 0.01);
  // The deviations of the points scatter by some per cent.
  EXPECT_NEAR(found.at("sigma_v_mean_m_s").found / right.at("sigma_v_mean_m_s").found, 0.8, 0.03);
}

// Each point shifted by seconds of its own: variances and spectra stay, the coherence in phase is lost.
TEST(FieldStatistics, GustsWithoutCoherenceAreSeen) {
  const auto right = unchanged(), found = checks_of([](MatrixXd&gusts) {
                                    for (Index point = 0; point < 5; ++point) {
                                      const Index shift = 331 * point, n = gusts.rows();
                                      const Eigen::VectorXd column = gusts.col(point);
                                      gusts.col(point) << column.tail(n - shift), column.head(shift);  // a sample is periodic
                                    }
                                  });
  EXPECT_NEAR(found.at("sigma_v_mean_m_s").found, right.at("sigma_v_mean_m_s").found, 1e-12);
  EXPECT_GT(found.at("coherence_v_error").found, 2.0 * right.at("coherence_v_error").found);
  EXPECT_EQ(found.at("coherence_w_error").found, right.at("coherence_w_error").found);
}

}  // namespace
}  // namespace twindeck::buffeting
