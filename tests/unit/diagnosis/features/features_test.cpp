// Oracles: rows that the rule of docs/diagnosis.md holds out, listed by hand; names as in rows.csv.
#include "diagnosis/features/features.hpp"

#include <gtest/gtest.h>

namespace twindeck::tests {
namespace {

using diagnosis::Condition;
using diagnosis::FeatureSet;
using diagnosis::RowType;

/// Conditions with one frequency each.
FeatureSet a_row_each(const std::vector<Condition>& conditions) {
  FeatureSet f;
  f.conditions = conditions;
  for (std::size_t c = 0; c < conditions.size(); ++c)
    f.rows.push_back({RowType::frequency, "1", -1, "", static_cast<int>(c), 1.0, 0.01, false});
  return f;
}

std::vector<int> held_by_rule(FeatureSet f) {
  hold_out_by_rule(f);
  std::vector<int> out;
  for (std::size_t r = 0; r < f.rows.size(); ++r)
    if (f.rows[r].held_out) out.push_back(static_cast<int>(r));
  return out;
}

std::vector<Condition> with(std::optional<double> Condition::*key, const std::vector<std::optional<double>>& values) {
  std::vector<Condition> out(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) out[i].*key = values[i];
  return out;
}

TEST(HoldOutByRule, TakesTheLargestOfThreeOrMore) {
  for (const auto key : {&Condition::amplitude_m, &Condition::temperature_C, &Condition::wind_m_s}) {
    EXPECT_EQ(held_by_rule(a_row_each(with(key, {1.0, 3.0, 2.0, 3.0, std::nullopt}))), (std::vector<int>{1, 3}));
    EXPECT_TRUE(held_by_rule(a_row_each(with(key, {1.0, 3.0, 3.0, std::nullopt}))).empty());  // two different values
    EXPECT_EQ(held_by_rule(a_row_each(with(key, {-5.0, -3.0, -9.0}))), std::vector<int>{1});
  }
  EXPECT_TRUE(held_by_rule(a_row_each(with(&Condition::people, {1.0, 2.0, 3.0}))).empty());
}

TEST(HoldOutByRule, TakesTheHighestOfFourModes) {
  // Mode "b" is the highest, wherever it stands; all its rows are held out, but not a stay's of the same name.
  FeatureSet f;
  f.conditions.resize(2);
  const double hertz[] = {2.0, 7.0, 3.0, 5.0};
  for (int i = 0; i < 4; ++i)
    f.rows.push_back({RowType::frequency, std::string(1, static_cast<char>('a' + i)), -1, "", 0, hertz[i], 0.01, false});
  f.rows.push_back({RowType::damping, "b", -1, "", 0, 0.5, 0.1, false});
  f.rows.push_back({RowType::shape, "b", 0, "", 0, 1.0, 0.1, false});
  f.rows.push_back({RowType::shape_imag, "b", 0, "", 0, 1.0, 0.1, false});
  f.rows.push_back({RowType::stay_frequency, "b", -1, "S", 0, 9.0, 0.1, false});
  f.rows.push_back({RowType::frequency, "b", -1, "", 1, 7.0, 0.01, false});
  EXPECT_EQ(held_by_rule(f), (std::vector<int>{1, 4, 5, 6}));
  f.rows.erase(f.rows.begin());
  EXPECT_TRUE(held_by_rule(f).empty());  // of three modes none
}

TEST(HoldOutByRule, LeavesMarksAsTheyAre) {
  FeatureSet f = a_row_each(with(&Condition::amplitude_m, {1.0, 2.0, 3.0}));
  f.rows[0].held_out = true;
  EXPECT_EQ(held_by_rule(f), std::vector<int>{0});
}

TEST(StatesOf, AreInTheOrderOfTheFile) {
  FeatureSet f;
  for (const auto& [state, line] : {std::pair<const char*, long>{"third", 30}, {"first", 10}, {"second", 20}, {"first", 40}}) {
    f.conditions.emplace_back();
    f.conditions.back().state = state;
    f.conditions.back().line = line;
  }
  for (int c = 0; c < 4; ++c) f.rows.push_back({RowType::frequency, "1", -1, "", c, 1.0, 0.01, false});
  EXPECT_EQ(states_of(f), (std::vector<std::string>{"first", "second", "third"}));
  f.conditions[2].state = "reference";
  EXPECT_EQ(states_of(f), (std::vector<std::string>{"reference", "first", "third"}));
}

TEST(RowTypes, HaveTheirNamesAndScales) {
  EXPECT_EQ(name_of(RowType::frequency), "frequency_Hz");
  EXPECT_EQ(name_of(RowType::psd_floor), "psd_floor_m2_s3");
  EXPECT_EQ(name_of(RowType::static_displacement), "static_m");
  EXPECT_EQ(name_of(RowType::static_force), "static_force_N");
  EXPECT_EQ(diagnosis::row_type_names().size(), static_cast<std::size_t>(RowType::static_force) + 1);
  for (int t = 0; t <= static_cast<int>(RowType::static_force); ++t) {
    const auto type = static_cast<RowType>(t);
    EXPECT_EQ(is_static(type), name_of(type).starts_with("static_")) << name_of(type);
    // What may have either sign has no logarithm.
    EXPECT_EQ(is_logarithmic(type), !is_static(type) && !name_of(type).starts_with("shape")) << name_of(type);
  }
}

}  // namespace
}  // namespace twindeck::tests
