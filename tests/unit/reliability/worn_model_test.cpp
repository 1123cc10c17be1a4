/// Oracles: shares of area and inertia worked by hand; what a damper's spring is when its dashpot is gone or held.
#include "reliability/worn_model.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace twindeck::reliability {
namespace {

fe::Model tube_and_rope() {
  fe::Model model;
  fe::Section tube, rope;
  tube.name = "tube";
  tube.area_m2 = 0.01;
  tube.shear_area_y_m2 = 0.005;
  tube.inertia_y_m4 = 2e-5;
  tube.torsion_m4 = 4e-5;
  rope.name = "rope";
  rope.area_m2 = 0.25 * 3.14159265358979 * 0.04 * 0.04;
  model.sections = {tube, rope};
  fe::Spring series, parallel;
  series.name = "A1";
  series.group = "damper_A";
  series.stiffness = 1e5;
  series.damping = 1e5;
  series.series = true;
  parallel.name = "C1";
  parallel.group = "damper_C";
  parallel.damping = 8e5;
  model.springs = {series, parallel};
  return model;
}

TEST(WornModel, TakesWallsOfTubesAndDiametersOfRopes) {
  // 1 mm in the first year, nothing more to the end of it: of 8 mm from one side 7/8, of a diameter of 40 mm 38/40 squared.
  const Corrosion corrosion{1e-3, 0.5, 10.0};
  const std::vector<Wall> walls = {{{"tube"}, 8e-3, 1, corrosion}, {{"rope"}, 0.0, 1, corrosion}};
  const fe::Model before = tube_and_rope(), after = worn_model(before, walls, 11.0);
  EXPECT_NEAR(after.sections[0].area_m2 / before.sections[0].area_m2, 7.0 / 8.0, 1e-12);
  EXPECT_NEAR(after.sections[0].shear_area_y_m2 / before.sections[0].shear_area_y_m2, 7.0 / 8.0, 1e-12);
  EXPECT_NEAR(after.sections[0].inertia_y_m4 / before.sections[0].inertia_y_m4, 7.0 / 8.0, 1e-12);
  EXPECT_NEAR(after.sections[0].torsion_m4 / before.sections[0].torsion_m4, 7.0 / 8.0, 1e-12);
  EXPECT_NEAR(after.sections[1].area_m2 / before.sections[1].area_m2, 38.0 * 38.0 / 1600.0, 1e-12);
  EXPECT_EQ(worn_model(before, walls, 10.0).sections[0].area_m2, before.sections[0].area_m2);
}

TEST(WornModel, RefusesASectionThatIsNotThereOrIsEaten) {
  EXPECT_THROW((void)worn_model(tube_and_rope(), {{{"tubes"}, 8e-3, 1, {1e-3, 0.5, 0.0}}}, 1.0), InputError);
  EXPECT_THROW((void)worn_model(tube_and_rope(), {{{"tube"}, 8e-3, 2, {1e-3, 0.5, 0.0}}}, 16.0), InputError);
}

TEST(DamperFault, ALostDamperIsGoneAndAHeldOneIsASpring) {
  const fe::Model lost = with_damper_fault(tube_and_rope(), "A1", DamperFault::lost, 1e7);
  ASSERT_EQ(lost.springs.size(), 1U);
  EXPECT_EQ(lost.springs[0].name, "C1");
  const fe::Model series = with_damper_fault(tube_and_rope(), "A1", DamperFault::held, 1e7);
  EXPECT_FALSE(series.springs[0].series);
  EXPECT_EQ(series.springs[0].damping, 0.0);
  EXPECT_EQ(series.springs[0].stiffness, 1e5);
  EXPECT_EQ(with_damper_fault(tube_and_rope(), "C1", DamperFault::held, 1e7).springs[1].stiffness, 1e7);
  EXPECT_THROW((void)with_damper_fault(tube_and_rope(), "C9", DamperFault::lost, 1e7), InputError);
}

}  // namespace
}  // namespace twindeck::reliability
