/// Oracles: the closed form of galloping by a constant h1*; linearity in the static coefficients; the same rule gives the same
/// run, in the same wind; seeds repeat and differ; the mean square over seeds is the integral of the spectrum, within the
/// scatter of the samples.
#include "buffeting/simulated_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/buffeting/gusty_beam.hpp"

namespace twindeck::buffeting {
namespace {

using tests::GustyBeam;

/// Counts what is told.
class CountingReporter : public Reporter {
 public:
  void progress(const std::string& what, double done, double total) const override {
    EXPECT_EQ(what, "August");
    EXPECT_EQ(total, 3.0);
    last_ = std::max(last_, done);
    ++calls_;
  }
  [[nodiscard]] int calls() const { return calls_; }
  [[nodiscard]] double last() const { return last_; }

 private:
  mutable int calls_ = 0;
  mutable double last_ = 0.0;
};

SimulatedEvent simulated(const GustyBeam& beam, double factor = 1.0, std::uint64_t first_seed = 5) {
  return simulate_event(beam.bridge(factor), beam.set, beam.config, beam.config.events[0], first_seed, Reporter());
}

// A row a sensor, a column a seed; spectra of the monitoring points alone. One line of progress a seed.
TEST(SimulatedRuns, HaveARowASensorAndAColumnASeed) {
  GustyBeam beam;
  beam.config.runs = {{"NS1", "A"}, {"again", "A"}, {"NS2", "H"}};
  const CountingReporter reporter;
  const SimulatedEvent found = simulate_event(beam.bridge(), beam.set, beam.config, beam.config.events[0], 5, reporter);
  EXPECT_EQ(reporter.calls(), 3);
  EXPECT_EQ(reporter.last(), 3.0);
  ASSERT_EQ(found.runs.size(), 3U);
  EXPECT_EQ(found.checks.size(), 8U);
  for (const RunResult& run : found.runs) {
    EXPECT_EQ(run.event, "August");
    EXPECT_EQ(run.rms.rows(), 12);
    EXPECT_EQ(run.rms.cols(), 3);
    EXPECT_EQ(run.spectral_rms.size(), 6);
    EXPECT_TRUE((run.peak.array() >= run.rms.array()).all());
  }
  EXPECT_EQ(found.runs[1].run, "again");
  EXPECT_EQ(found.runs[2].model, "H");
  // The same rule in the same wind is the same run; so is H, in a wind along the normal.
  EXPECT_EQ(found.runs[0].rms, found.runs[1].rms);
  EXPECT_LT((found.runs[0].rms - found.runs[2].rms).norm(), 1e-10 * found.runs[0].rms.norm());
}

// Twice the coefficients, twice the response: gust forces are linear in them, and there are no self-excited ones.
TEST(SimulatedRuns, AreLinearInTheCoefficients) {
  const GustyBeam beam;
  const RunResult one = simulated(beam).runs[0], two = simulated(beam, 2.0).runs[0];
  // Shapes of the reduction are the same for twice the patterns, to rounding.
  EXPECT_LT((two.rms - 2.0 * one.rms).norm(), 1e-6 * two.rms.norm());
  EXPECT_LT((two.peak - 2.0 * one.peak).norm(), 1e-6 * two.peak.norm());
  EXPECT_LT((two.spectral_rms - 2.0 * one.spectral_rms).norm(), 1e-6 * two.spectral_rms.norm());
  // Without self-excited forces it does not matter where derivatives are taken.
  EXPECT_LT((one.spectral_rms - one.spectral_rms_each_frequency).norm(), 1e-12 * one.spectral_rms.norm());
}

// A seed is what counts: it repeats, another differs, and those of an event do.
TEST(SimulatedRuns, RepeatByTheirSeed) {
  const GustyBeam beam;
  const RunResult a = simulated(beam).runs[0], b = simulated(beam).runs[0], other = simulated(beam, 1.0, 6).runs[0];
  EXPECT_EQ(a.rms, b.rms);
  EXPECT_EQ(a.peak, b.peak);
  EXPECT_GT((a.rms - other.rms).norm(), 0.01 * a.rms.norm());
  EXPECT_GT((a.rms.col(0) - a.rms.col(1)).norm(), 0.01 * a.rms.norm());
}

// In time and in the frequency domain. A mode of 1.1 Hz at 2 % has about 2ξω T = 0.28 · 120 s = 34 independent values in 3
// seeds of 40 s, so the RMS scatters by 1/sqrt(2 · 34) = 12 %; three of that.
TEST(SimulatedRuns, MeanSquareIsTheIntegralOfTheSpectrum) {
  const GustyBeam beam;
  const RunResult found = simulated(beam).runs[0];
  for (const Eigen::Index row : {2, 5}) {  // vertical, at both points
    const double mean_square = found.rms.row(row).squaredNorm() / 3.0;
    EXPECT_NEAR(std::sqrt(mean_square) / found.spectral_rms[row], 1.0, 0.36) << row;
    EXPECT_GT(found.spectral_rms[row], 0.0);
  }
}

// A mode gallops from V = 4 m ω ξ/(ρ B |h1|) on. Below it the run has its values, above it none, and a line says why; the whole
// event then needs no wind.
TEST(SimulatedRuns, NoValuesOfAnUnstableBridge) {
  GustyBeam beam;
  const double h1 = -2.0, critical = beam.deck.galloping_speed(h1, beam.aerodynamics.structural_damping);
  const auto at = [&](double speed) {
    buffeting::BridgeInWind bridge = beam.bridge();
    bridge.sections[0].derivatives = tests::BeamDeck::heave_table(h1);
    beam.config.events[0].speed_m_s = speed;
    return simulate_event(bridge, beam.set, beam.config, beam.config.events[0], 5, Reporter());
  };
  const SimulatedEvent below = at(0.99 * critical), above = at(1.01 * critical);
  ASSERT_EQ(below.runs.size(), 1U);
  EXPECT_TRUE(below.runs[0].status.converged) << below.runs[0].status.message;
  EXPECT_EQ(below.runs[0].rms.cols(), 3);
  EXPECT_EQ(below.checks.size(), 8U);
  ASSERT_EQ(above.runs.size(), 1U);
  const std::string& told = above.runs[0].status.message;
  EXPECT_FALSE(above.runs[0].status.converged);
  for (const std::string part : {"event August at ", "run NS1 (model A)", "mode 1 grows at 1.1"})
    EXPECT_NE(told.find(part), std::string::npos) << told;
  EXPECT_EQ(above.runs[0].rms.size(), 0);
  EXPECT_EQ(above.runs[0].spectral_rms.size(), 0);
  EXPECT_TRUE(above.checks.empty());
}

// u' does nothing to a deck that takes all wind as normal. In a skew wind it changes the component along the normal of one that
// takes that alone (C), so that its variance adds to those of v' and w'. Its samples are checked as those of the others.
TEST(SimulatedRuns, GustsAcrossAddToASkewWind) {
  GustyBeam beam;
  beam.aerodynamics.direction_deg = 55.0;  // 35 degrees from the normal
  beam.config.runs = {{"NS1", "A"}, {"C", "C"}};
  const SimulatedEvent without = simulated(beam);
  beam.config.across = true;
  const SimulatedEvent with = simulated(beam);
  EXPECT_EQ(with.checks.size(), 12U);
  EXPECT_EQ(with.checks[8].quantity, "sigma_u_mean_m_s");
  EXPECT_LT((with.runs[0].rms - without.runs[0].rms).norm(), 1e-12 * without.runs[0].rms.norm());
  const Eigen::VectorXd before = without.runs[1].spectral_rms, after = with.runs[1].spectral_rms;
  for (const Eigen::Index row : {1, 2}) {                // along the normal and vertical
    EXPECT_GT(after[row], 1.0001 * before[row]) << row;  // u' pulls with 2 C_L alone, w' with C_L'
    EXPECT_NEAR(std::sqrt(with.runs[1].rms.row(row).squaredNorm() / 3.0) / after[row], 1.0, 0.36) << row;
  }
}

// The same law of the gusts by other frequencies: RMS values scatter about the same spectral ones, which stay.
TEST(SimulatedRuns, DoubleIndexedFrequenciesHaveTheSameSpectra) {
  GustyBeam beam;
  const RunResult single = simulated(beam).runs[0];
  beam.config.frequencies = "double_indexed";
  const SimulatedEvent found = simulated(beam);
  EXPECT_EQ(found.runs[0].spectral_rms, single.spectral_rms);
  EXPECT_GT((found.runs[0].rms - single.rms).norm(), 0.01 * single.rms.norm());
  for (const Eigen::Index row : {2, 5})  // as MeanSquareIsTheIntegralOfTheSpectrum
    EXPECT_NEAR(std::sqrt(found.runs[0].rms.row(row).squaredNorm() / 3.0) / single.spectral_rms[row], 1.0, 0.36) << row;
  for (const FieldCheck& check : found.checks) EXPECT_LT(std::abs(check.found - check.target), check.allowed) << check.quantity;
}

// Another spectrum and another coherence are those of the field; half the decays load a span more evenly.
TEST(SimulatedRuns, TakeTheLawsOfTheSet) {
  GustyBeam beam;
  const RunResult von_karman = simulated(beam).runs[0];
  for (wind::Spectrum& spectrum : beam.set.spectrum) spectrum.law = wind::SpectrumLaw::kaimal;
  const RunResult kaimal = simulated(beam).runs[0];
  EXPECT_GT((kaimal.spectral_rms - von_karman.spectral_rms).norm(), 0.01 * von_karman.spectral_rms.norm());
  for (wind::PerComponent& decay : beam.set.decay)
    for (double& c : decay) c *= 0.5;
  EXPECT_GT(simulated(beam).runs[0].spectral_rms[2], 1.05 * kaimal.spectral_rms[2]);
}

}  // namespace
}  // namespace twindeck::buffeting
