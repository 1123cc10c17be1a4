// Oracle: small meshes whose common sides are seen by inspection.
#include <gtest/gtest.h>

#include "assembly_models.hpp"
#include "fe/assembly_elements.hpp"

namespace twindeck::fe {
namespace {

std::vector<std::uint8_t> sides_of(const std::vector<std::vector<int>>& shells) {
  Model model;
  for (const std::vector<int>& nodes : shells) test::add_element(model, ElementType::shell, "", 0, 0, nodes);
  return sides_beside_four_nodes(model);
}

using Sides = std::vector<std::uint8_t>;

TEST(MixedSides, EachSideHasItsBit) {
  EXPECT_EQ(sides_of({{0, 1, 2, 3}, {1, 0, 4}}), (Sides{0, 0b001}));  // the common side runs the other way
  EXPECT_EQ(sides_of({{0, 1, 2, 3}, {4, 2, 1}}), (Sides{0, 0b010}));
  EXPECT_EQ(sides_of({{0, 1, 2, 3}, {0, 4, 3}}), (Sides{0, 0b100}));  // from the last node to the first, in both
  EXPECT_EQ(sides_of({{4, 2, 1}, {0, 1, 2, 3}}), (Sides{0b010, 0}));  // the order of elements does not matter
}

TEST(MixedSides, CornersAndDiagonalsAreNoCommonSides) {
  EXPECT_EQ(sides_of({{0, 1, 2, 3}, {0, 2, 4}, {3, 5, 6}}), (Sides{0, 0, 0}));
  EXPECT_EQ(sides_of({{0, 1, 2}, {2, 1, 3}}), (Sides{0, 0}));
  EXPECT_EQ(sides_of({}), Sides{});
}

TEST(MixedSides, OneTriangleMayLieBetweenSeveralShells) {
  EXPECT_EQ(sides_of({{0, 1, 4, 5}, {1, 2, 6, 7}, {2, 0, 8, 9}, {0, 1, 2}}), (Sides{0, 0, 0, 0b111}));
}

TEST(MixedSides, OtherElementsOfFourNodesDoNotCount) {
  Model model;
  test::add_element(model, ElementType::solid, "", 0, -1, {0, 1, 2, 3});
  test::add_element(model, ElementType::beam, "", 0, 0, {0, 1});
  test::add_element(model, ElementType::shell, "", 0, 0, {0, 1, 2});
  EXPECT_EQ(sides_beside_four_nodes(model), (Sides{0, 0, 0}));
}

}  // namespace
}  // namespace twindeck::fe
