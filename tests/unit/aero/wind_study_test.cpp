// Oracles: galloping of one degree of freedom in closed form, with and without a dashpot; influence lines of a simply supported
// beam; largest differences and least values by hand.
#include "aero/wind_study.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "known_derivatives.hpp"
#include "linear_polar.hpp"
#include "unit/aero/beam_deck.hpp"
#include "verification/wind_sections.hpp"

namespace {

using namespace twindeck;
using tests::BeamDeck;

constexpr double study_mass = 1500.0, study_chord = 4.5, study_h1 = -2.0, study_omega = 4.4;

// V = 4 (m ωξ + c/2)/(ρB|h1|) of the heave of one strip of a metre with a dashpot c.
double heave_speed(double omega, double ratio, double dashpot = 0.0) {
  return 4 * (study_mass * omega * ratio + 0.5 * dashpot) / (1.25 * study_chord * std::abs(study_h1));
}

// A strip at a yaw that heaves in one mode and pitches in another.
aero::WindModel heaving_model(double yaw_rad = 0.0) {
  aero::WindModel model;
  model.strips = {aero::make_strip("deck", 0, 0, 1.0, {0, 0, 0}, {std::cos(yaw_rad), -std::sin(yaw_rad), 0}, {})};
  model.modes.eigenvalue = Eigen::Vector2d(study_omega, 3 * study_omega).cwiseAbs2();
  const double size = 1 / std::sqrt(study_mass);
  model.motions = {wind_test::motion({{0, size, 0}, {0, 0, 0.3 * size}})};
  return model;
}

aero::FittedSet fitted_heave(const std::string& name = "standin") {
  return {name,
          1.0,
          {{"deck", study_chord, aero::linear_polar({0.2, 0, 0, 0, study_h1 - 0.2, 0}), BeamDeck::heave_table(study_h1)}}};
}

aero::WindSettings study_settings() {
  aero::WindSettings settings = BeamDeck().settings();
  settings.models = {"A", "C"};
  settings.max_speed_m_s = 60.0;
  settings.followed_modes = 2;
  settings.damped_modes = 1;
  settings.structural_damping = 0.005;
  settings.identified_damping = 0.011;
  return settings;
}

// A row a rule, then one with the identified damping. V_C = V_A/cos: only the normal component acts.
TEST(FindInstabilities, RowsHaveTheClosedFormOfTheirRuleAndDamping) {
  const double yaw = 0.5;
  const aero::Instabilities found = aero::find_instabilities(study_settings(), {fitted_heave()}, heaving_model(yaw), {});
  ASSERT_EQ(found.critical.size(), 3U);
  const double expected = heave_speed(study_omega, 0.005);
  const std::vector<double> speed = {expected, expected / std::cos(yaw), heave_speed(study_omega, 0.011)};
  const std::vector<std::string> rule = {"A", "C", "A"};
  for (std::size_t i = 0; i < 3; ++i) {
    const aero::CriticalRow& row = found.critical[i];
    EXPECT_EQ(row.set, "standin");
    EXPECT_EQ(row.model, rule[i]);
    EXPECT_EQ(row.group, aero::published_yaw_rule(rule[i]).group);
    EXPECT_FALSE(row.dampers);
    EXPECT_EQ(row.structural_damping, i == 2 ? 0.011 : 0.005);
    ASSERT_TRUE(row.point.has_value());
    EXPECT_NEAR(row.point->speed_m_s / speed[i], 1.0, 1e-9);
    EXPECT_EQ(row.point->mode, 1);
    EXPECT_NEAR(row.single_mode_m_s.value() / speed[i], 1.0, 1e-9);  // the modes are not coupled
    // The polars alone, without a rule: the same number, since C_L' + C_D = h1.
    EXPECT_NEAR(row.den_hartog_m_s.value() / heave_speed(study_omega, row.structural_damping), 1.0, 1e-12);
    EXPECT_FALSE(row.divergence_m_s.has_value());
    EXPECT_EQ(row.character.deck, "deck");
    EXPECT_NEAR(row.character.theta_rms_rad, yaw, 1e-12);
    EXPECT_NEAR(row.character.exponent, 0.0, 1e-9);  // a constant h1*
    EXPECT_TRUE(row.lost.empty());
  }
  // Curves of the rule to fit: with the structural damping all followed modes, with the identified one the first.
  ASSERT_EQ(found.damping.size(), 2U);
  EXPECT_EQ(found.damping[0].branches.size(), 2U);
  EXPECT_EQ(found.damping[1].branches.size(), 1U);
  EXPECT_EQ(found.damping[0].branches[0].speed_m_s.size(), 60U);
  EXPECT_EQ(found.damping[0].branches[0].speed_m_s.back(), 60.0);
}

// Every set has its rows, in the order of the sets; a hybrid is named as such.
TEST(FindInstabilities, SetsAndTheHybridHaveTheirRows) {
  aero::WindSettings settings = study_settings();
  settings.models = {"A"};
  settings.hybrid = {{"deck", 20.0}};
  settings.hybrid_outer = "C";
  const double yaw = 0.5;  // beyond 20 degrees: the hybrid is C here
  const auto found =
      aero::find_instabilities(settings, {fitted_heave("standin"), fitted_heave("quasi_steady")}, heaving_model(yaw), {});
  ASSERT_EQ(found.critical.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(found.critical[i].set, i < 3 ? "standin" : "quasi_steady");
  EXPECT_EQ(found.critical[1].model, "hybrid");
  EXPECT_EQ(found.critical[1].group, "Hybrid");
  EXPECT_EQ(found.critical[1].description, "Table 14");
  EXPECT_NEAR(found.critical[1].point.value().speed_m_s / (heave_speed(study_omega, 0.005) / std::cos(yaw)), 1.0, 1e-9);
}

// With a dashpot of c the speed is that of mωξ + c/2. Mode 1 alone and Den Hartog's speed are told without dampers only.
TEST(FindInstabilities, DampersRaiseTheCriticalSpeed) {
  const aero::WindModel model = heaving_model();
  aero::DampedModel damped;
  damped.dampers = 1;
  damped.structure = aero::bare_structure(model, 0.005);
  const double dashpot = 70.0;
  damped.structure.viscous = Eigen::Vector2d(dashpot / study_mass, 0.0).asDiagonal();
  damped.motions = model.motions;
  const auto found = aero::find_instabilities(study_settings(), {fitted_heave()}, model, damped);
  ASSERT_EQ(found.critical.size(), 4U);
  const aero::CriticalRow& row = found.critical.back();
  EXPECT_TRUE(row.dampers);
  EXPECT_NEAR(row.point.value().speed_m_s / heave_speed(study_omega, 0.005, dashpot), 1.0, 1e-9);
  EXPECT_FALSE(row.single_mode_m_s.has_value());
  EXPECT_FALSE(row.den_hartog_m_s.has_value());
  EXPECT_EQ(found.damping.back().branches.size(), 1U);
  EXPECT_TRUE(found.damping.back().dampers);
}

// Two heave modes: the second, at 3 ω with three times the motion, gallops at 3/9 of the speed of the first. It counts if it is
// followed.
TEST(FindInstabilities, TheLowestOfTheFollowedModesCounts) {
  aero::WindModel model = heaving_model();
  const double size = 1 / std::sqrt(study_mass);
  // Two strips that each move in one mode alone: nothing couples them.
  model.strips.push_back(model.strips[0]);
  model.motions = {wind_test::motion({{0, size, 0}, {0, 0, 0}}), wind_test::motion({{0, 0, 0}, {0, 3 * size, 0}})};
  aero::WindSettings settings = study_settings();
  const auto both = aero::find_instabilities(settings, {fitted_heave()}, model, {});
  EXPECT_EQ(both.critical[0].point.value().mode, 2);
  EXPECT_NEAR(both.critical[0].point.value().speed_m_s / (3.0 / 9.0 * heave_speed(study_omega, 0.005)), 1.0, 1e-9);
  EXPECT_NEAR(both.critical[0].single_mode_m_s.value() / heave_speed(study_omega, 0.005), 1.0, 1e-9);
  settings.followed_modes = 1;
  const auto first = aero::find_instabilities(settings, {fitted_heave()}, model, {});
  EXPECT_EQ(first.critical[0].point.value().mode, 1);
}

// A mode that stops oscillating before it is unstable is told.
TEST(FindInstabilities, ALostModeIsTold) {
  aero::FittedSet set = fitted_heave();
  set.sections[0].derivatives = BeamDeck::heave_table(300.0);
  const auto found = aero::find_instabilities(study_settings(), {set}, heaving_model(), {});
  EXPECT_FALSE(found.critical[0].point.has_value());
  EXPECT_FALSE(found.critical[0].single_mode_m_s.has_value());
  EXPECT_NE(found.critical[0].lost.find("mode 1 cannot be followed"), std::string::npos) << found.critical[0].lost;
}

// Eq. (7) on each strip, and displacements by the influence lines of the beam: drag bends it laterally, lift vertically, the
// moment twists it.
TEST(StaticResponse, IsThatOfTheBeamUnderItsStripForces) {
  const BeamDeck deck;
  const dynamics::LoadedModel loaded = dynamics::from_model(deck.model());
  aero::WindSettings settings = deck.settings();
  settings.design_speed_m_s = 30.0;
  const aero::WindModel model = aero::prepare_wind_model(settings, loaded);
  const aero::StaticCoefficients c{0.2, -0.3, 0.05, 0, 0, 0};
  const aero::FittedSet set{"standin", 1.0, {{"deck", deck.chord, aero::linear_polar(c), BeamDeck::heave_table(-1.0)}}};
  linalg::Cholesky factor;
  ASSERT_TRUE(factor.factorize(loaded.system.stiffness(loaded.theta)).converged);
  const aero::StaticResponse found =
      aero::static_response(settings, set, aero::everywhere(aero::published_yaw_rule("A")), model, loaded, factor);
  EXPECT_EQ(found.set, "standin");
  EXPECT_EQ(found.model, "A");
  ASSERT_EQ(found.force.size(), 8U);
  const double q_area = 0.5 * 1.25 * 900.0 * deck.chord * deck.strip_length();
  for (int i = 0; i < deck.strips; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_LT((found.force[at] - q_area * Eigen::Vector3d(0.2, -0.3, 0.05 * deck.chord)).norm(), 1e-9 * q_area);
    double lateral = 0.0, vertical = 0.0, turn = 0.0;
    for (int j = 0; j < deck.strips; ++j) {
      const double x = deck.strip_x(i), a = deck.strip_x(j);
      lateral += 0.2 * q_area * deck.influence(x, a, deck.I_lateral);
      vertical += -0.3 * q_area * deck.influence(x, a, deck.I_vertical);
      turn += 0.05 * deck.chord * q_area * deck.twist(x, a);
    }
    EXPECT_NEAR(found.displacement[at].y() / lateral, 1.0, 1e-8) << i;
    EXPECT_NEAR(found.displacement[at].z() / vertical, 1.0, 1e-8) << i;
    EXPECT_NEAR(found.rotation_rad[at] / turn, 1.0, 1e-8) << i;
  }
}

// By hand: the largest over the strips, of the first response of each name.
TEST(StaticDifference, IsTheLargestOverTheStrips) {
  std::vector<aero::StaticResponse> responses(3);
  responses[0] = {"standin", "G", {}, {{0, 0, 1}, {1, 2, 2}}, {0.01, 0.02}};
  responses[1] = {"standin", "H", {}, {{0, 0, 2}, {1, 5, 6}}, {0.04, 0.03}};
  responses[2] = {"quasi_steady", "H", {}, {{9, 9, 9}, {9, 9, 9}}, {1, 1}};
  const std::optional<aero::StaticDifference> found = aero::static_difference(responses, "G", "H");
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(found->displacement_m, 5.0);
  EXPECT_DOUBLE_EQ(found->rotation_rad, 0.03);
  EXPECT_FALSE(aero::static_difference(responses, "G", "I"));  // no difference to a rule that did not run
}

// By hand: damping ratios 0.6 and -0.8 of a branch, 0.28 of another; the negative one lies beyond the speed.
TEST(LeastDamping, CountsUpToTheSpeed) {
  aero::DampingCurves curves;
  curves.branches.resize(2);
  curves.branches[0].speed_m_s = {10.0, 20.0};
  curves.branches[0].points = {{{-3, 4}, {}}, {{4, 3}, {}}};
  curves.branches[1].speed_m_s = {10.0};
  curves.branches[1].points = {{{-7, 24}, {}}};
  EXPECT_DOUBLE_EQ(aero::least_damping(curves, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(aero::least_damping(curves, 10.0), 0.28);
  EXPECT_DOUBLE_EQ(aero::least_damping(curves, 20.0), -0.8);
}

}  // namespace
