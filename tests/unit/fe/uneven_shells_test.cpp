// Oracles: the header's classes (multiples of 0.7 u to either side, three at most), the mean square of a sum of cosines.
#include "fe/uneven_shells.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly_models.hpp"
#include "core/error.hpp"

namespace twindeck::fe {
namespace {

/// A strip of `n` shells of 1 m by 1 m along X, in two sections of the given names in turn.
Model long_strip(int n, const char* even, const char* odd) {
  Model model = test::with_steel();
  for (const char* name : {even, odd}) {
    Section slab;
    slab.name = name;
    slab.thickness_m = 0.2;
    model.sections.push_back(slab);
  }
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2; ++j) test::add_node(model, i, j, 0.0);
  for (int i = 0; i < n; ++i)
    test::add_element(model, ElementType::shell, "deck", 0, 1 + i % 2, {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  return model;
}

double step_of(const Model& model, std::size_t element, double u) {
  return (model.sections[slot(model.elements[element].section)].thickness_m / 0.2 - 1.0) / (0.7 * u);
}

// Oracle: over 2000 m of waves up to 30 m the steps are whole, three at most, have mean 0 and the mean square 1/0.7² of f;
// rounding to classes adds 1/12 and the outer classes take a little away: 20 % are allowed.
TEST(UnevenShells, ThicknessHasTheStatedSpread) {
  const int n = 2000;
  const Model model = with_uneven_shells(long_strip(n, "slab_foot_B", "slab_foot_C"), 0.1, 30.0);
  double mean = 0.0, square = 0.0;
  for (int i = 0; i < n; ++i) {
    const double step = step_of(model, static_cast<std::size_t>(i), 0.1);
    EXPECT_NEAR(step, std::round(step), 1e-12);
    EXPECT_LE(std::abs(step), 3.0 + 1e-12);
    mean += step / n, square += step * step / n;
  }
  EXPECT_NEAR(mean, 0.0, 0.1);
  EXPECT_NEAR(square * 0.49, 1.0, 0.2);
}

// Oracle: names agree up to the second underscore: one deck, so neighbours seldom differ by more than one class; other decks
// have other phases.
TEST(UnevenShells, OneDeckIsEvenlyUneven) {
  const Model one = with_uneven_shells(long_strip(400, "slab_foot_B", "slab_foot_C"), 0.1, 60.0);
  const Model two = with_uneven_shells(long_strip(400, "slab_foot_B", "slab_road_B"), 0.1, 60.0);
  int jumps_one = 0, jumps_two = 0;
  for (std::size_t i = 1; i < 400; ++i) {
    jumps_one += std::abs(step_of(one, i, 0.1) - step_of(one, i - 1, 0.1)) > 1.5;
    jumps_two += std::abs(step_of(two, i, 0.1) - step_of(two, i - 1, 0.1)) > 1.5;
  }
  EXPECT_EQ(jumps_one, 0);
  EXPECT_GT(jumps_two, 40);
}

// Oracle: the header's names; nothing but the thickness changes; seven classes at most for a section, the nominal one included.
TEST(UnevenShells, AddsOneSectionAClass) {
  const Model before = long_strip(500, "slab_foot_B", "slab");
  const Model model = with_uneven_shells(before, 0.3, 20.0);
  EXPECT_LE(model.sections.size(), 3U + 2U * 6U);
  EXPECT_EQ(model.sections[1].thickness_m, 0.2);
  for (std::size_t i = 3; i < model.sections.size(); ++i) {
    const Section& s = model.sections[i];
    const int step = static_cast<int>(std::lround((s.thickness_m / 0.2 - 1.0) / 0.21));
    const std::string ending = (step > 0 ? "~+" : "~") + std::to_string(step);
    EXPECT_TRUE(s.name == "slab_foot_B" + ending || s.name == "slab" + ending) << s.name;
    EXPECT_GT(s.thickness_m, 0.0);
  }
  EXPECT_EQ(with_uneven_shells(before, 0.0, 20.0).sections.size(), 3U);
  EXPECT_THROW((void)with_uneven_shells(before, 0.31, 20.0), InternalError);
  EXPECT_THROW((void)with_uneven_shells(before, 0.1, 0.0), InternalError);
}

// Oracle: beams have no thickness.
TEST(UnevenShells, OtherElementsStayAsTheyAre) {
  const Model model = with_uneven_shells(test::cantilever(), 0.2, 10.0);
  EXPECT_EQ(model.sections.size(), 1U);
  EXPECT_EQ(model.elements[0].section, 0);
}

}  // namespace
}  // namespace twindeck::fe
