#include "diagnosis/reduction/composite_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace twindeck::tests {
namespace {

using diagnosis::composite_groups;
using Names = std::vector<std::string>;

bool holds(const std::vector<Names>& found, const Names& wanted) {
  return std::find(found.begin(), found.end(), wanted) != found.end();
}

TEST(CompositeGroups, FacesOfAStoreyOfADirectionAndOfTheFrameBelongTogether) {
  Names names;
  for (const char* storey : {"1", "2"})
    for (const char* face : {"x0", "x2", "y0", "y2"}) names.push_back(std::string("braces_") + storey + "_" + face);
  const auto found = composite_groups(names);
  EXPECT_TRUE(holds(found, {"braces_1_x0", "braces_1_x2"}));
  EXPECT_TRUE(holds(found, {"braces_1_x0", "braces_1_x2", "braces_1_y0", "braces_1_y2"}));
  EXPECT_TRUE(holds(found, {"braces_1_y2", "braces_2_y2"}));
  EXPECT_TRUE(holds(found, names));
  EXPECT_FALSE(holds(found, {"braces_1_x0", "braces_1_y2"}));  // equal in no part that differs
  // By storey, direction, side: three of one part free 4 + 4 + 4, of two 2 + 2 + 2, all 1.
  EXPECT_EQ(found.size(), 19U);
}

TEST(CompositeGroups, NamesOfOtherFormsStandAlone) {
  EXPECT_TRUE(composite_groups({"deck", "storey_1", "column_a"}).empty());
  EXPECT_EQ(composite_groups({"storey1", "roof_7", "storey2"}), std::vector<Names>({{"storey1", "storey2"}}));
  EXPECT_TRUE(composite_groups({"deck", "mast"}).empty());
  EXPECT_TRUE(composite_groups({}).empty());
}

}  // namespace
}  // namespace twindeck::tests
