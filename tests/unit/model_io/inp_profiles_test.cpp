/// Oracles: Timoshenko and Goodier's table of torsion constants of rectangles (Theory of Elasticity, section 109), Cowper's
/// shear coefficients, closed forms of thin sections, and the way back from the numbers to the profile.
#include "model_io/inp_profiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twindeck::model_io {
namespace {

fe::Section section(const std::string& profile, const std::vector<double>& values, double nu = 0.3) {
  std::string problem;
  const fe::Section s = profile_section(profile, values, nu, problem);
  EXPECT_EQ(problem, "");
  return s;
}

TEST(InpProfiles, TorsionOfRectangles) {
  // b/a -> k1 of J = k1 (2a)³ (2b), printed to three digits or four
  EXPECT_NEAR(rectangle_torsion(1.0, 1.0), 0.1406, 5e-5);
  EXPECT_NEAR(rectangle_torsion(2.0, 1.0), 2 * 0.229, 1e-3);
  EXPECT_NEAR(rectangle_torsion(1.0, 5.0), 5 * 0.291, 2.5e-3);
  EXPECT_NEAR(rectangle_torsion(1.0, 1000.0) / 1000.0, 1.0 / 3.0, 3e-4);
}

TEST(InpProfiles, AxesOfARectangle) {
  const fe::Section s = section("RECT", {0.2, 0.1});  // 0.2 along n1 = local y
  EXPECT_DOUBLE_EQ(s.inertia_z_m4, 0.1 * std::pow(0.2, 3) / 12);
  EXPECT_DOUBLE_EQ(s.inertia_y_m4, 0.2 * std::pow(0.1, 3) / 12);
}

TEST(InpProfiles, ThinSections) {
  const double r = 0.5, t = 1e-4;
  const fe::Section pipe = section("PIPE", {r, t});
  EXPECT_NEAR(pipe.inertia_y_m4, std::numbers::pi * r * r * r * t, 1e-3 * pipe.inertia_y_m4);
  EXPECT_NEAR(pipe.shear_area_y_m2 / pipe.area_m2, 2 * 1.3 / (4 + 3 * 0.3), 1e-3);  // Cowper, thin tube
  const fe::Section box = section("BOX", {1.0, 1.0, t, t, t, t});
  EXPECT_NEAR(box.torsion_m4, t, 1e-3 * t);  // Bredt: a³ t
  EXPECT_NEAR(box.inertia_y_m4, 2.0 / 3.0 * t, 1e-3 * t);
}

TEST(InpProfiles, RecognisesPipes) {
  const auto found = recognise_pipe(section("PIPE", {0.1, 0.01}));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->name, "PIPE");
  EXPECT_NEAR(found->values[0], 0.1, 1e-9);
  EXPECT_NEAR(found->values[1], 0.01, 1e-9);
  EXPECT_FALSE(recognise_pipe(section("CIRC", {0.03})).has_value());
  EXPECT_FALSE(recognise_pipe(section("RECT", {0.3, 0.12})).has_value());
  EXPECT_FALSE(recognise_pipe(section("I", {0.15, 0.3, 0.15, 0.15, 0.01, 0.01, 0.007})).has_value());
}

TEST(InpProfiles, SaysWhatIsWrong) {
  std::string problem;
  (void)profile_section("PIPE", {0.1, 0.2}, 0.3, problem);
  EXPECT_NE(problem.find("thicker"), std::string::npos);
  problem.clear();
  (void)profile_section("BOX", {0.2, 0.2, 0.01, 0.01, 0.02, 0.01}, 0.3, problem);
  EXPECT_NE(problem.find("opposite walls"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::model_io
