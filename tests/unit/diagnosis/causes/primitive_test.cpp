#include "diagnosis/causes/primitive.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace twindeck::tests {
namespace {

TEST(Primitives, StandInTheOrderOfTheEnumerationUnderNamesOfTheirOwn) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < diagnosis::primitives().size(); ++i) {
    const diagnosis::PrimitiveKind& kind = diagnosis::primitives()[i];
    EXPECT_EQ(static_cast<std::size_t>(kind.primitive), i) << kind.name;
    EXPECT_EQ(diagnosis::primitive_named(kind.name), kind.primitive);
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(std::set<std::string>(kind.numbers.begin(), kind.numbers.end()).size(), kind.numbers.size()) << kind.name;
  }
  EXPECT_EQ(diagnosis::primitive_named("scale.stifness"), std::nullopt);
}

TEST(Primitives, ChangeTheStructureOrScaleAStiffness) {
  using enum diagnosis::Primitive;
  for (const auto p : {scale_stiffness, scale_mass, support_move, mass_add, element_spring, element_string})
    EXPECT_TRUE(diagnosis::changes_structure(p)) << diagnosis::kind_of(p).name;
  for (const auto p : {field_stiffness, support_settle, mass_per_count, damper_absent, channel_gain})
    EXPECT_FALSE(diagnosis::changes_structure(p)) << diagnosis::kind_of(p).name;
  for (const auto p : {scale_stiffness, field_stiffness, step_stiffness, slip_stiffness, soften_stiffness})
    EXPECT_TRUE(diagnosis::scales_stiffness(p)) << diagnosis::kind_of(p).name;
  EXPECT_FALSE(diagnosis::scales_stiffness(scale_mass));
}

}  // namespace
}  // namespace twindeck::tests
