#include "core/lists.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

namespace {

struct Part {
  std::string name;
  int number = 0;
};

// Oracle: the lists themselves, written out.
TEST(Lists, ContainWhatTheyHold) {
  EXPECT_TRUE(twindeck::contains(std::vector<std::string>{"a", "b"}, "b"));
  EXPECT_FALSE(twindeck::contains(std::vector<std::string>{"a", "b"}, "c"));
  EXPECT_FALSE(twindeck::contains(std::vector<int>{}, 1));
  EXPECT_TRUE(twindeck::contains(std::array<const char*, 2>{"x", "y"}, std::string("y")));
}

TEST(Lists, GiveSomethingOfEachPartInOrder) {
  const std::vector<Part> parts = {{"a", 2}, {"b", 1}};
  EXPECT_EQ(twindeck::each_of(parts, &Part::name), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(twindeck::each_of(parts, [](const Part& part) { return 2 * part.number; }), (std::vector<int>{4, 2}));
  const std::map<std::string, int> known = {{"x", 1}, {"y", 2}};
  EXPECT_EQ(twindeck::each_of(known, [](const auto& entry) { return entry.first; }), (std::vector<std::string>{"x", "y"}));
}

}  // namespace
