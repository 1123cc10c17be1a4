// Oracle: the sentence for a body whose numbers are given.
#include <gtest/gtest.h>

#include "fe/mass_properties.hpp"

namespace twindeck::fe {
namespace {

TEST(ImportedMass, IsSaidInOneLine) {
  MassProperties p;
  EXPECT_EQ(mass_words(p), "the model has no mass");
  p.mass_kg = Eigen::Vector3d::Constant(275.0702);
  p.centre_m = {1.0, 1e-15, 2.5};
  p.inertia_kg_m2 << 12.0, -3.0, 1e-12, -3.0, 20.0, 0.0, 1e-12, 0.0, 30.0;
  EXPECT_EQ(mass_words(p),
            "mass 275.07 kg, centre of mass at (1, 0, 2.5) m; inertia about it, axes x y z: xx 12, yy 20, zz 30, xy -3, xz 0, "
            "yz 0 kg m2");
  p.mass_kg[2] = 300.0;
  EXPECT_NE(mass_words(p).find("mass 275.07 kg along x, 275.07 kg along y, 300 kg along z, centre"), std::string::npos);
}

}  // namespace
}  // namespace twindeck::fe
