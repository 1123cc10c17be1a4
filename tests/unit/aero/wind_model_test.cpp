// Oracles: a simply supported beam in closed form (modes, influence lines, twist); galloping of a mode in closed form; scaling
// of derivatives and lift slopes by hand.
#include "aero/wind_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "linalg/cholesky.hpp"
#include "linear_polar.hpp"
#include "unit/aero/beam_deck.hpp"

namespace {

using namespace twindeck;
using tests::BeamDeck;

// Deflection that a reduced structure gives under a unit force with pattern d: sum d_i²/ω_i².
double flexibility(const aero::ReducedStructure& s, const Eigen::VectorXd& d) {
  return d.cwiseQuotient(s.omega_rad_s).squaredNorm();
}

aero::DeckAerodynamics one_deck(double h1 = -2.0) {
  return {aero::linear_polar({0.2, -0.1, 0.03, 0.4, -3.0, 0.5}), BeamDeck::heave_table(h1)};
}

// A level scales the self-excited forces of tables and leaves their polar. Quasi-steady, it scales the slope of lift.
TEST(SectionsOf, TheLevelScalesWhatItsSetSays) {
  aero::WindSettings settings = BeamDeck().settings();
  settings.decks[0].arm_lift = 0.3;
  const auto tables = aero::sections_of(settings, {one_deck()}, "standin", 1.5);
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].name, "deck");
  EXPECT_EQ(tables[0].chord_m, 4.5);
  EXPECT_NEAR(tables[0].derivatives->at(0.0, 2.0).damping(1, 1), -2.0 * 1.5 * -2.0, 1e-13);  // -V* h1
  EXPECT_EQ(tables[0].polar.at(0.0).lift_slope, -3.0);
  const auto quasi = aero::sections_of(settings, {one_deck()}, "quasi_steady", 1.5);
  EXPECT_NEAR(quasi[0].polar.at(0.0).lift_slope, -4.5, 1e-15);
  EXPECT_EQ(quasi[0].polar.at(0.0).lift, -0.1);
  EXPECT_NEAR(quasi[0].derivatives->at(0.0, 2.0).damping(1, 1), -2.0 * (-4.5 + 0.2), 1e-13);
  EXPECT_NEAR(quasi[0].derivatives->at(0.0, 2.0).damping(1, 2), -2.0 * 0.3 * (-4.5 + 0.2), 1e-13);
  try {
    static_cast<void>(aero::sections_of(settings, {one_deck()}, "stand_in", 1.0));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'standin'"), std::string::npos) << error.what();
  }
}

TEST(AeroNodesOf, AMatrixModelIsRefused) {
  EXPECT_THROW(static_cast<void>(aero::aero_nodes_of(BeamDeck().settings(), nullptr, "matrices")), InputError);
}

// Shape sin(jπx/L) sqrt(2/(mL)), frequency (jπ/L)² sqrt(EI/m). Sixteen cubic elements err by (jπ/16)⁴/720: 4e-5 at j = 2.
TEST(PrepareWindModel, ModesAtTheStripsAreThoseOfTheBeam) {
  const BeamDeck deck;
  aero::WindSettings settings = deck.settings();
  settings.attack_deg = 1.5;
  const dynamics::LoadedModel loaded = dynamics::from_model(deck.model());
  const aero::WindModel model = aero::prepare_wind_model(settings, loaded);
  ASSERT_EQ(model.strips.size(), 8U);
  ASSERT_EQ(model.motions.size(), 8U);
  EXPECT_EQ(model.modes.eigenvalue.size(), 4);
  for (int j = 1; j <= 2; ++j) {
    EXPECT_NEAR(std::sqrt(model.modes.eigenvalue[j - 1]) / deck.omega(j), 1.0, 1e-4) << j;
    for (int i = 0; i < 8; ++i) {
      const double shape =
          std::sin(j * std::numbers::pi * deck.strip_x(i) / deck.length) * std::sqrt(2.0 / (deck.mass() * deck.length));
      EXPECT_NEAR(std::abs(model.motions[static_cast<std::size_t>(i)](2, j - 1)), std::abs(shape), 1e-4 * 5.8e-3)
          << i;  // of the amplitude
    }
  }
  for (int i = 0; i < 8; ++i) {
    const aero::Strip& strip = model.strips[static_cast<std::size_t>(i)];
    EXPECT_NEAR(strip.x_m.x(), deck.strip_x(i), 1e-12);
    EXPECT_NEAR(strip.length_m, deck.strip_length(), 1e-12);
    EXPECT_NEAR(strip.alpha_rad, 1.5 * radians, 1e-9);  // a symmetric beam does not turn under its weight
  }
  settings.n_modes = 100000;  // as many as there are
  EXPECT_EQ(aero::prepare_wind_model(settings, loaded).modes.eigenvalue.size(), loaded.system.size());
}

// A mass of 2000 kg on an arm of 1.5 m to the windward side pulls the nose down: alpha = -m g e x/(2 G J) up to the middle.
TEST(PrepareWindModel, TheAngleOfAttackIsThatUnderDeadLoad) {
  const BeamDeck deck;
  fe::Model model = deck.model();
  model.nodes.push_back({99, {0.5 * deck.length, -1.5, 0.0}});
  model.links.push_back({"arm", deck.middle(), static_cast<int>(model.nodes.size()) - 1});
  fe::PointMass mass;
  mass.group = "mass";
  mass.node = static_cast<int>(model.nodes.size()) - 1;
  mass.mass_kg = 2000.0;
  model.masses.push_back(mass);
  model.prestress.rule = fe::PullRule::given;  // the shape under dead load is found with the cable forces, here none
  model.prestress.geometric_stiffness = false;
  aero::WindSettings settings = deck.settings();
  settings.attack_deg = 2.0;
  const aero::WindModel found = aero::prepare_wind_model(settings, dynamics::from_model(model));
  const double couple = 2000.0 * model.gravity_m_s2 * 1.5;
  for (int i = 0; i < 8; ++i) {
    const double turned = -couple * deck.twist(deck.strip_x(i), 0.5 * deck.length);
    EXPECT_NEAR(found.strips[static_cast<std::size_t>(i)].alpha_rad - 2.0 * radians, turned, 1e-9) << i;  // of 1e-4
  }
}

TEST(Dampers, AreTheSpringsOfTheirGroupAlongTheirDirection) {
  const BeamDeck deck;
  fe::Model model = deck.model();
  BeamDeck::add_damper(model, deck.middle(), 3e4);
  fe::Spring other = model.springs[0];
  other.group = "bearing";
  model.springs.push_back(other);
  fe::Spring between = model.springs[0];  // between two nodes, along a direction that is no unit vector, about an axis
  between.group = "damper_between";
  between.node = 3;
  between.node2 = 5;
  between.direction = {0.0, 3.0, 4.0};
  model.springs.push_back(between);
  between.rotation = true;
  between.direction = {2.0, 0.0, 0.0};
  model.springs.push_back(between);
  const dynamics::LoadedModel loaded = dynamics::from_model(model);
  const auto dampers = aero::dampers_of(*loaded.model);
  ASSERT_EQ(dampers.size(), 3U);
  // A pattern gives the elongation: at free nodes, motions of the first node less those of the second.
  const Eigen::MatrixXd patterns = aero::damper_patterns(loaded, dampers);
  Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(loaded.system.size(), 1.0, 3.0);
  q = q.array().sin();
  const Eigen::VectorXd u = loaded.system.expand(q), elongation = patterns.transpose() * q;
  EXPECT_NEAR(elongation(0), u(6 * deck.middle() + 2), 1e-14);
  EXPECT_NEAR(elongation(1), 0.6 * (u(19) - u(31)) + 0.8 * (u(20) - u(32)), 1e-14);
  EXPECT_NEAR(elongation(2), u(21) - u(33), 1e-14);
}

// What is not taken is named: a dashpot of a bearing, friction of a damper. A damper of its group is taken, a spring is none,
// and one that is carried as data in another group is no part of the model.
TEST(Dampers, WhatIsNotTakenIsNamed) {
  const BeamDeck deck;
  fe::Model model = deck.model();
  BeamDeck::add_damper(model, deck.middle(), 3e4);
  EXPECT_EQ(aero::untaken_in_words(model), "");
  for (const bool active : {true, false}) {
    BeamDeck::add_damper(model, 3, 3e4);
    model.springs.back().name = active ? "pot" : "spare";
    model.springs.back().group = "bearing";
    model.springs.back().active = active;
  }
  EXPECT_EQ(aero::untaken_in_words(model),
            "the dashpots of pot are not taken in wind: dampers are the springs of a group that begins with 'damper'");
  model.springs.front().friction_N = 100.0;
  EXPECT_NE(aero::untaken_in_words(model).find("'damper'; the friction of damper is not taken"), std::string::npos);
}

// A damper's own static shape makes the flexibility at it exact with any number of modes: L³/48EI in the middle.
TEST(WithDampers, TheStructureYieldsAtTheDamperAsTheBeamDoes) {
  const BeamDeck deck;
  aero::WindSettings settings = deck.settings();
  settings.n_modes = 1;
  for (const double series : {0.0, 5e5}) {
    fe::Model model = deck.model();
    BeamDeck::add_damper(model, deck.middle(), 3e4, series);
    const dynamics::LoadedModel loaded = dynamics::from_model(model);
    const aero::WindModel prepared = aero::prepare_wind_model(settings, loaded);
    const aero::DampedModel damped = aero::with_dampers(prepared, loaded, 0.02);
    EXPECT_EQ(damped.dampers, 1);
    ASSERT_EQ(damped.structure.size(), 2);
    EXPECT_EQ(damped.structure.damping_ratio, Eigen::Vector2d::Constant(0.02));
    const Eigen::VectorXd d = loaded.system.expand(damped.vectors).row(6 * deck.middle() + 2).transpose();
    const double beam = std::pow(deck.length, 3) / (48 * deck.E * deck.I_vertical);
    EXPECT_NEAR(flexibility(damped.structure, d) / beam, 1.0, 1e-8) << series;
    // Mode 1 alone holds 96/π⁴ = 98.6 % of it.
    EXPECT_NEAR(std::pow(d(0) / damped.structure.omega_rad_s(0), 2) / beam, 96 / std::pow(std::numbers::pi, 4), 1e-3);
    if (series == 0.0) {
      EXPECT_LT((damped.structure.viscous - 3e4 * d * d.transpose()).norm(), 1e-9 * 3e4 * d.squaredNorm());
      EXPECT_TRUE(damped.structure.maxwell.empty());
    } else {
      EXPECT_EQ(damped.structure.viscous.norm(), 0.0);
      ASSERT_EQ(damped.structure.maxwell.size(), 1U);
      EXPECT_EQ(damped.structure.maxwell[0].stiffness_N_m, series);
      EXPECT_EQ(damped.structure.maxwell[0].damping_N_s_m, 3e4);
      EXPECT_LT((damped.structure.maxwell[0].direction - d).norm(), 1e-10 * d.norm());
    }
  }
}

// Mass is the unit matrix and stiffness diagonal in the coordinates; the motions at the strips are those of the vectors.
TEST(Reduce, CoordinatesAreNormalAndKeepTheModes) {
  const BeamDeck deck;
  fe::Model model = deck.model();
  BeamDeck::add_damper(model, 3, 3e4);
  const dynamics::LoadedModel loaded = dynamics::from_model(model);
  const aero::WindModel prepared = aero::prepare_wind_model(deck.settings(), loaded);
  const aero::DampedModel damped = aero::with_dampers(prepared, loaded, 0.01);
  const Eigen::MatrixXd& v = damped.vectors;
  const linalg::SparseMatrix k = loaded.system.stiffness(loaded.theta), m = loaded.system.mass(loaded.theta);
  const Eigen::MatrixXd mass = v.transpose() * (m.selfadjointView<Eigen::Lower>() * v),
                        stiffness = v.transpose() * (k.selfadjointView<Eigen::Lower>() * v);
  EXPECT_LT((mass - Eigen::MatrixXd::Identity(5, 5)).norm(), 1e-9);
  const Eigen::MatrixXd squares = damped.structure.omega_rad_s.cwiseAbs2().asDiagonal();
  EXPECT_LT((stiffness - squares).norm(), 1e-9 * squares.norm());
  EXPECT_NEAR(damped.structure.omega_rad_s(0) / std::sqrt(prepared.modes.eigenvalue(0)), 1.0, 1e-9);
  const auto motions = aero::motions_of(prepared.nodes, loaded.system.expand(v));
  for (std::size_t i = 0; i < motions.size(); ++i) EXPECT_EQ(motions[i], damped.motions[i]);
}

// The static shape of a point gives its flexibility exactly: 3 L³/256EI at a quarter of the beam. Without dampers there are
// none.
TEST(Reduce, PointsAndPatternsCompleteTheModes) {
  const BeamDeck deck;
  fe::Model model = deck.model();
  BeamDeck::add_damper(model, deck.middle(), 3e4);
  const dynamics::LoadedModel loaded = dynamics::from_model(model);
  aero::WindSettings settings = deck.settings();
  settings.n_modes = 1;
  const aero::WindModel prepared = aero::prepare_wind_model(settings, loaded);
  const Eigen::VectorXd force = Eigen::MatrixXd(loaded.system.expansion).row(6 * (deck.middle() / 2) + 2).transpose();
  const double beam = 3 * std::pow(deck.length, 3) / (256 * deck.E * deck.I_vertical);
  aero::Reduction by_point;
  by_point.dampers = false;
  by_point.points = force;
  by_point.point_generations = 1;
  aero::Reduction by_pattern;
  by_pattern.dampers = false;
  by_pattern.patterns = 100.0 * force;
  by_pattern.static_shapes = 3;
  for (const aero::Reduction& reduction : {by_point, by_pattern}) {
    const aero::DampedModel found = aero::reduce(prepared, loaded, 0.01, reduction);
    EXPECT_EQ(found.dampers, 0);
    EXPECT_EQ(found.structure.size(), 2);
    EXPECT_EQ(found.structure.viscous.norm(), 0.0);
    EXPECT_NEAR(flexibility(found.structure, found.vectors.transpose() * force) / beam, 1.0, 1e-8);
  }
}

// Heave galloping at level 1 begins at V1 = 4 mωξ/(ρB|h1|), and the level is as 1/V: to be critical at V it is V1/V.
TEST(FitLevel, IsTheRatioOfTheSpeeds) {
  const BeamDeck deck;
  const dynamics::LoadedModel loaded = dynamics::from_model(deck.model());
  aero::WindSettings settings = deck.settings();
  const aero::WindModel model = aero::prepare_wind_model(settings, loaded);
  const double at_level_1 = deck.galloping_speed(-2.0, settings.structural_damping);
  EXPECT_EQ(aero::fit_level(settings, {one_deck()}, "standin", model), 1.0);  // nothing to be fitted
  for (const double level : {0.3, 1.7, 6.0}) {
    settings.fit_speed_m_s = at_level_1 / level;
    const auto found = aero::fit_level(settings, {one_deck()}, "standin", model);
    ASSERT_TRUE(found.has_value()) << level;
    EXPECT_NEAR(*found / level, 1.0, 1e-5) << level;  // the mesh errs by 2e-6 in the frequency
  }
  // Quasi-steady, C_D does not take part in the level: level · C_L' + C_D = h1.
  settings.fit_speed_m_s = 0.8 * at_level_1;
  const auto quasi = aero::fit_level(settings, {one_deck()}, "quasi_steady", model);
  ASSERT_TRUE(quasi.has_value());
  EXPECT_NEAR(*quasi, (2.0 / 0.8 + 0.2) / 3.0, 1e-5);
}

// A section that damps has no level, one that gallops at once at the lowest level neither.
TEST(FitLevel, IsEmptyWhereNoLevelDoesIt) {
  const BeamDeck deck;
  const dynamics::LoadedModel loaded = dynamics::from_model(deck.model());
  aero::WindSettings settings = deck.settings();
  const aero::WindModel model = aero::prepare_wind_model(settings, loaded);
  settings.fit_speed_m_s = deck.galloping_speed(-2.0, settings.structural_damping);
  EXPECT_FALSE(aero::fit_level(settings, {one_deck(0.1)}, "standin", model).has_value());
  EXPECT_FALSE(aero::fit_level(settings, {one_deck(-0.05)}, "standin", model).has_value());  // needs 40
  EXPECT_FALSE(aero::fit_level(settings, {one_deck(-80.0)}, "standin", model).has_value());  // needs 0.025
}

}  // namespace
