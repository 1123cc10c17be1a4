/// Oracles: both ways to an RMS are of the same equations, so they agree within the period error (ω dt)²/12 of the step and
/// within what the static shapes leave; which checks there are, by hand.
#include "buffeting/time_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/buffeting/gusty_beam.hpp"

namespace twindeck::buffeting {
namespace {

using tests::GustyBeam;

CheckedCase first_case(const GustyBeam& beam) { return {beam.config.events[0], beam.config.runs[0]}; }

// Two points and no full model: two checks. The period of the mode at 1.1 Hz errs by (7.1/64)²/12 = 0.1 %.
TEST(TimeChecks, HalfTheStepGivesTheSameRms) {
  const GustyBeam beam;
  const std::vector<TimeCheck> found = check_time_integration(beam.bridge(), beam.set, beam.config, first_case(beam), 7);
  ASSERT_EQ(found.size(), 2U);
  for (std::size_t p = 0; p < 2; ++p) {
    EXPECT_EQ(found[p].name, "half_step");
    EXPECT_EQ(found[p].channel, p == 0 ? "M1" : "M2");
    EXPECT_EQ(found[p].allowed_pct, 1.0);
    EXPECT_GT(found[p].reference_m_s2, 0.0);
    EXPECT_NEAR(found[p].found_m_s2 / found[p].reference_m_s2, 1.0, 0.01);
    EXPECT_NE(found[p].found_m_s2, found[p].reference_m_s2);  // a step of its own
  }
}

// At 1/8 s the period errs by (7.1/8)²/12 = 6.6 %: the resonance meets other gusts than at half the step.
TEST(TimeChecks, AStepThatIsTooWideIsSeen) {
  GustyBeam beam;
  beam.config.step_s = 1.0 / 8;
  beam.config.cutoff_Hz = 2.0;
  const std::vector<TimeCheck> found = check_time_integration(beam.bridge(), beam.set, beam.config, first_case(beam), 7);
  EXPECT_GT(std::abs(found[0].found_m_s2 / found[0].reference_m_s2 - 1.0), 0.01);
}

// The reduced structure under the same forces as the whole one, with a damper that is eliminated in one and a coordinate in the
// other. Vertical motion below 4 Hz is that of two modes, a static shape a point and one of the damper.
TEST(TimeChecks, ReducedAndFullModelAgree) {
  for (const bool damper : {false, true}) {
    GustyBeam beam;
    beam.config.full_model_check_s = 10.0;
    const std::vector<TimeCheck> found =
        check_time_integration(beam.bridge(1.0, damper), beam.set, beam.config, first_case(beam), 7);
    ASSERT_EQ(found.size(), 4U);
    for (std::size_t p = 2; p < 4; ++p) {
      EXPECT_EQ(found[p].name, "full_model");
      EXPECT_EQ(found[p].channel, p == 2 ? "M1" : "M2");
      EXPECT_GT(found[p].reference_m_s2, 0.0);
      EXPECT_NEAR(found[p].found_m_s2 / found[p].reference_m_s2, 1.0, 0.01) << damper;
    }
  }
}

// A spring beside the dashpot counts once in both, whether the damper is active in the model (its matrix holds the spring) or
// not.
TEST(TimeChecks, ASpringBesideADashpotCountsOnce) {
  for (const bool active : {true, false}) {
    GustyBeam beam;
    beam.config.full_model_check_s = 10.0;
    fe::Model model = beam.deck.model();
    tests::BeamDeck::add_damper(model, beam.deck.middle(), 4e4);
    model.springs.back().stiffness = 3e5;
    model.springs.back().active = active;
    const BridgeInWind bridge =
        prepare_bridge_in_wind(beam.config, beam.aerodynamics, dynamics::valid_model(model), beam.sections());
    const std::vector<TimeCheck> found = check_time_integration(bridge, beam.set, beam.config, first_case(beam), 7);
    for (std::size_t p = 2; p < 4; ++p) EXPECT_NEAR(found[p].found_m_s2 / found[p].reference_m_s2, 1.0, 0.01) << active << p;
  }
}

// With dampers left out of the reduced structure they are left out of the whole one too, though the model has them.
TEST(TimeChecks, DampersAreLeftOutOfBoth) {
  GustyBeam beam;
  beam.config.full_model_check_s = 10.0;
  const auto with = check_time_integration(beam.bridge(1.0, true), beam.set, beam.config, first_case(beam), 7);
  beam.config.dampers = false;
  const auto without = check_time_integration(beam.bridge(1.0, true), beam.set, beam.config, first_case(beam), 7);
  EXPECT_NEAR(without[2].found_m_s2 / without[2].reference_m_s2, 1.0, 0.01);
  EXPECT_GT(without[2].reference_m_s2, 1.05 * with[2].reference_m_s2);
}

}  // namespace
}  // namespace twindeck::buffeting
