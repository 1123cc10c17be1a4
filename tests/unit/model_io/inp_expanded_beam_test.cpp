/// Oracles: the stiffness of a rectangle or pipe whose sections stay plane, integrated by hand: E A, E I, G12 A and G13 A, and
/// in torsion the sum of G12 Iy and G13 Iz; Bredt's torsion of thin tubes; the section given to be expanded.
#include "model_io/inp_expanded_beam.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twindeck::model_io {
namespace {

constexpr double kWall = 1e-4;
const fe::Material steel{"steel", 210e9, 81e9, 0.296, 7850.0};

fe::Section profile(const std::string& name, const std::vector<double>& v) {
  const Shape shape = name == "PIPE"   ? circle(v[0], v[0] - v[1])
                      : name == "CIRC" ? circle(v[0])
                      : name == "BOX"  ? box(v[0], v[1], {v[2], v[3], v[2], v[3]})
                      : name == "I"    ? i_shape(v[1], {v[2], v[3]}, {v[4], v[5]}, v[6])
                                       : rectangles({{0.0, 0.0, v[0], v[1]}});
  return profile_section(shape, 0.3).section;
}

struct Stiffness {
  double stretch, bend_y, bend_z, torsion, shear_y, shear_z, mass;
};
/// What CalculiX makes of it.
Stiffness of(const ExpandedBeam& beam) {
  const fe::Section s = profile(beam.profile.name, beam.profile.values);
  return {beam.youngs_modulus_Pa * s.area_m2,
          beam.youngs_modulus_Pa * s.inertia_y_m4,
          beam.youngs_modulus_Pa * s.inertia_z_m4,
          beam.shear_modulus_y_Pa * s.inertia_y_m4 + beam.shear_modulus_z_Pa * s.inertia_z_m4,
          beam.shear_modulus_y_Pa * s.area_m2,
          beam.shear_modulus_z_Pa * s.area_m2,
          beam.density_kg_m3 * s.area_m2};
}

void expect_stretching_bending_and_mass(const fe::Section& s, const Stiffness& k) {
  EXPECT_NEAR(k.stretch / (steel.youngs_modulus_Pa * s.area_m2), 1.0, 1e-12);
  EXPECT_NEAR(k.bend_y / (steel.youngs_modulus_Pa * s.inertia_y_m4), 1.0, 1e-12);
  EXPECT_NEAR(k.bend_z / (steel.youngs_modulus_Pa * s.inertia_z_m4), 1.0, 1e-12);
  EXPECT_NEAR(k.mass / (steel.density_kg_m3 * s.area_m2), 1.0, 1e-12);
}

TEST(InpExpandedBeam, ClosedSectionsKeepTheirTorsion) {
  const std::vector<double> flat = {0.4, 0.2, kWall, kWall, kWall, kWall}, square = {0.3, 0.3, kWall, kWall, kWall, kWall};
  for (const fe::Section& s :
       {profile("PIPE", {0.1, 0.01}), profile("CIRC", {0.03}), profile("BOX", square), profile("BOX", flat)}) {
    const ExpandedBeam beam = expanded_beam(s, steel);
    const Stiffness k = of(beam);
    expect_stretching_bending_and_mass(s, k);
    // Whether sections may warp or not.
    EXPECT_NEAR(k.torsion / (steel.shear_modulus_Pa * s.torsion_m4), 1.0, 1e-12);
    EXPECT_NEAR(beam.torsion[0], 1.0, 1e-12);
    EXPECT_NEAR(beam.torsion[1], 1.0, 1e-12);
    EXPECT_NEAR(k.shear_y / (steel.shear_modulus_Pa * s.shear_area_y_m2), beam.shear[0], 1e-9);
    EXPECT_NEAR(k.shear_z / (steel.shear_modulus_Pa * s.shear_area_z_m2), beam.shear[1], 1e-9);
    EXPECT_GE(beam.shear[0], 0.5);
    EXPECT_LT(beam.shear[0], 2.1);  // a thin tube shears over half of its area
  }
  EXPECT_EQ(expanded_beam(profile("PIPE", {0.1, 0.01}), steel).profile.name, "PIPE");
  EXPECT_EQ(expanded_beam(profile("BOX", square), steel).profile.name, "RECT");
}

TEST(InpExpandedBeam, OpenSectionsKeepTheirShear) {
  const fe::Section s = profile("I", {0.15, 0.3, 0.15, 0.15, 0.01, 0.01, 0.007});
  const ExpandedBeam beam = expanded_beam(s, steel);
  const Stiffness k = of(beam);
  expect_stretching_bending_and_mass(s, k);
  EXPECT_NEAR(k.shear_y / (steel.shear_modulus_Pa * s.shear_area_y_m2), 1.0, 1e-12);
  EXPECT_NEAR(k.shear_z / (steel.shear_modulus_Pa * s.shear_area_z_m2), 1.0, 1e-12);
  EXPECT_NEAR(beam.torsion[1], k.torsion / (steel.shear_modulus_Pa * s.torsion_m4), 1e-9);
  EXPECT_GT(beam.torsion[0], 10.0);  // said in the file, not hidden
}

TEST(InpExpandedBeam, ASectionWithoutShearAreasIsMeasuredAgainstItsArea) {
  fe::Section s = profile("PIPE", {0.1, 0.01});
  s.shear_area_y_m2 = s.shear_area_z_m2 = 0.0;
  const ExpandedBeam beam = expanded_beam(s, steel);
  EXPECT_NEAR(beam.shear[0], 1.0, 1e-12);
  EXPECT_NEAR(beam.torsion[0], 1.0, 1e-12);
}

TEST(InpExpandedBeam, ReadBackAsTheSectionThatCalculixSees) {
  const fe::Section s = profile("BOX", {0.4, 0.2, kWall, kWall, kWall, kWall});
  const ExpandedBeam beam = expanded_beam(s, steel);
  const fe::Section back =
      contracted_beam(profile("RECT", beam.profile.values), beam.shear_modulus_y_Pa, beam.shear_modulus_z_Pa);
  EXPECT_NEAR(beam.youngs_modulus_Pa * back.inertia_y_m4 / (steel.youngs_modulus_Pa * s.inertia_y_m4), 1.0, 1e-12);
  EXPECT_NEAR(beam.shear_modulus_y_Pa * back.torsion_m4 / (steel.shear_modulus_Pa * s.torsion_m4), 1.0, 1e-12);
  EXPECT_NEAR(beam.shear_modulus_y_Pa * back.shear_area_y_m2 / (steel.shear_modulus_Pa * s.shear_area_y_m2), beam.shear[0],
              1e-9);
  EXPECT_NEAR(beam.shear_modulus_y_Pa * back.shear_area_z_m2 / (steel.shear_modulus_Pa * s.shear_area_z_m2), beam.shear[1],
              1e-9);
}

}  // namespace
}  // namespace twindeck::model_io
