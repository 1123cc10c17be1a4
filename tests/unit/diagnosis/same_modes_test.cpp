// Modes of several conditions under one name. Oracle: modes of one structure, renumbered and shifted by hand.
#include "diagnosis/features/same_modes.hpp"

#include <gtest/gtest.h>

#include "chain.hpp"

namespace twindeck::tests {
namespace {

TEST(SameModes, AreKnownByTheirShapesWhateverTheirNumbers) {
  const Chain chain({.masses = 8, .modes = 5});
  auto features = chain.measure(chain.as_modelled());
  const auto first = features.rows;
  diagnosis::Condition on;
  on.name = "on";
  features.conditions.push_back(on);
  // The second condition lacks mode 2 and so numbers the others from one; mode 1 is 20 % higher; one shape is like none.
  for (auto row : first) {
    if (row.mode == "2") continue;
    const int number = std::stoi(row.mode);
    row.condition = 1;
    if (row.type == diagnosis::RowType::frequency && number == 1) row.value *= 1.2;
    if (row.type == diagnosis::RowType::shape && number == 4) row.value = row.channel == 0 ? 1.0 : 0.01;
    if (row.type == diagnosis::RowType::shape && number == 5) row.value = -0.3 * row.value;
    row.mode = std::to_string(number == 1 ? 1 : number - 1);
    features.rows.push_back(row);
  }
  diagnosis::name_modes_alike(features);
  std::vector<std::string> names;
  for (const auto& row : features.rows)
    if (row.condition == 1 && row.type == diagnosis::RowType::frequency) names.push_back(row.mode);
  EXPECT_EQ(names, (std::vector<std::string>{"1", "3", "on 3", "5"}));
  // Names of the first condition stand.
  for (std::size_t r = 0; r < first.size(); ++r) EXPECT_EQ(features.rows[r].mode, first[r].mode);
}

}  // namespace
}  // namespace twindeck::tests
