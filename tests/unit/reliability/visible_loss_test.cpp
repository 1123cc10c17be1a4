/// Oracles: a mass on a massless cantilever, whose frequency goes with the root of the wall, so that the smallest loss has a
/// closed form; two walls that move one frequency alike cannot be told apart, with a second mode they can; a wall that carries
/// nothing is never seen.
#include "reliability/visible_loss.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/distributions.hpp"
#include "dynamics/eigenmodes.hpp"

namespace twindeck::reliability {
namespace {

constexpr double kWall_m = 0.01;

/// Two beams of 2 m along X, the first clamped; masses at their ends; motion in the plane x-z. Section "apart" belongs to no
/// element.
fe::Model cantilever() {
  fe::Model model;
  model.source = "cantilever";
  model.nodes = {{1, {0, 0, 0}}, {2, {2, 0, 0}}, {3, {4, 0, 0}}};
  model.materials = {{"steel", 2.1e11, 8.1e10, 0.3, 1e-6}};
  for (const char* name : {"inner", "outer", "apart"}) {
    fe::Section section;
    section.name = name;
    section.area_m2 = 0.01;
    section.inertia_y_m4 = section.inertia_z_m4 = 1e-5;
    section.torsion_m4 = 2e-5;
    model.sections.push_back(section);
  }
  for (int i = 0; i < 2; ++i) {
    fe::Element beam;
    beam.id = i + 1;
    beam.type = fe::ElementType::beam;
    beam.name = i == 0 ? "a" : "b";
    beam.material = 0;
    beam.section = i;
    beam.nodes = {i, i + 1};
    model.elements.push_back(beam);
  }
  model.supports = {{"clamp", 0, {true, true, true, true, true, true}}};
  for (const int node : {1, 2}) model.supports.push_back({"plane", node, {true, true, false, true, false, true}});
  for (const int node : {1, 2}) {
    fe::PointMass mass;
    mass.node = node;
    mass.mass_kg = 1000.0;
    model.masses.push_back(mass);
  }
  return model;
}

Wall wall(std::vector<std::string> sections) { return {std::move(sections), kWall_m, 1, {1e-4, 0.5, 0.0}}; }

std::vector<VisibleLoss> losses(const std::vector<Wall>& walls, const std::vector<MonitoredMode>& monitored) {
  const fe::Model model = cantilever();
  const dynamics::LoadedModel loaded = dynamics::from_model(model);
  const dynamics::EigenModes modes = dynamics::available_modes(loaded.system, loaded.theta, 4);
  return visible_losses(model, modes.shapes, modes.frequency_Hz, walls, monitored);
}

TEST(VisibleLoss, OfAllBendingStiffnessIsTheClosedForm) {
  // ln f falls by -0.5 ln(1 - D/t) in both modes: D(s) = 0.5 |ln(1 - D/t)| sqrt(1/(2 s1²) + 1/(2 s2²)) = 2 Phi^-1(0.95).
  const double s1 = 0.004, s2 = 0.008, seen = 2.0 * normal_quantile(0.95);
  const double root = std::sqrt(0.5 / (s1 * s1) + 0.5 / (s2 * s2));
  const auto found = losses({wall({"inner", "outer"})}, {{0, s1}, {1, s2}});
  ASSERT_TRUE(found[0].loss_m.has_value());
  EXPECT_NEAR(*found[0].loss_m / (kWall_m * (1.0 - std::exp(-2.0 * seen / root))), 1.0, 0.01);  // the search's own width
  EXPECT_NEAR(found[0].change[0], 0.5 * std::log(1.0 - *found[0].loss_m / kWall_m), 1e-6);
  EXPECT_NEAR(found[0].change[1], found[0].change[0], 1e-6);
  EXPECT_NEAR(*found[0].located_m, *found[0].loss_m, 1e-12);  // there is no other wall
}

TEST(VisibleLoss, IsLocatedOnlyWhereModesTellTheWallsApart) {
  const std::vector<Wall> walls = {wall({"inner"}), wall({"outer"})};
  const auto one = losses(walls, {{0, 0.002}}), two = losses(walls, {{0, 0.002}, {1, 0.002}});
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(two[i].loss_m.has_value());
    EXPECT_FALSE(one[i].located_m.has_value());
    ASSERT_TRUE(two[i].located_m.has_value());
    EXPECT_GT(*two[i].located_m, *two[i].loss_m);
  }
}

TEST(VisibleLoss, AWallThatCarriesNothingIsNotSeen) {
  const auto found = losses({wall({"apart"})}, {{0, 0.002}, {1, 0.002}});
  EXPECT_FALSE(found[0].loss_m.has_value());
  EXPECT_NEAR(found[0].distance, 0.0, 1e-6);
}

}  // namespace
}  // namespace twindeck::reliability
