// Oracle: three masses as a deck lists them, two of which are equal.
#include "model_io/deck_model.hpp"

#include <gtest/gtest.h>

namespace twindeck::model_io {
namespace {

TEST(EqualMasses, AreOneGroup) {
  std::vector<fe::PointMass> masses = {{.group = "conm2_1", .node = 0, .mass_kg = 1500.0},
                                       {.group = "conm2_2", .node = 1, .mass_kg = 20.5},
                                       {.group = "conm2_3", .node = 2, .mass_kg = 1500.0}};
  group_equal_masses(masses);
  EXPECT_EQ(masses[0].group, "mass_of_1500");
  EXPECT_EQ(masses[1].group, "conm2_2");
  EXPECT_EQ(masses[2].group, "mass_of_1500");
}

}  // namespace
}  // namespace twindeck::model_io
