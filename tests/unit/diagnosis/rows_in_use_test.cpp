// Oracles: rows that are listed by hand; a model whose modes are known in closed form.
#include "diagnosis/rows_in_use.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "unit/diagnosis/prediction/hand_made.hpp"

namespace twindeck::tests {
namespace {

using diagnosis::FeatureSet;
using diagnosis::RowChoice;
using diagnosis::RowType;

/// Modes 1 to 3 at 1, 2 and 3 Hz in two conditions with a shape value each, and a stay's frequency at 9 Hz.
FeatureSet two_days() {
  FeatureSet f;
  f.channels = {"c"};
  f.direction = {Eigen::Vector3d::UnitZ()};
  for (const char* day : {"cold", "warm"}) {
    f.conditions.emplace_back();
    f.conditions.back().name = day;
    const auto c = static_cast<int>(f.conditions.size()) - 1;
    for (int i = 1; i <= 3; ++i) {
      f.rows.push_back({RowType::frequency, std::to_string(i), -1, "", c, 1.0 * i, 0.01, false});
      f.rows.push_back({RowType::shape, std::to_string(i), 0, "", c, 1.0, 0.02, false});
    }
  }
  f.rows.push_back({RowType::stay_frequency, "2", -1, "S1", 0, 9.0, 0.1, false});
  f.covariance = Eigen::VectorXd::LinSpaced(13, 1.0, 13.0).asDiagonal();
  return f;
}

/// Rows by "type mode condition", with the number that their variance started as.
std::vector<std::string> listed(const FeatureSet& f) {
  std::vector<std::string> out;
  for (std::size_t r = 0; r < f.rows.size(); ++r) {
    const auto& row = f.rows[r];
    const auto at = static_cast<Eigen::Index>(r);
    out.push_back(std::string(row.type == RowType::frequency ? "f"
                              : row.type == RowType::shape   ? "s"
                                                             : "stay") +
                  row.mode + (row.condition == 0 ? "cold" : "warm") + std::to_string(static_cast<int>(f.covariance(at, at))));
  }
  return out;
}

TEST(ChooseRows, LeavesOutTypesAndModesWithTheirErrors) {
  FeatureSet f = two_days();
  choose_rows({.left_out = {"shape", "mode:2"}}, f);
  EXPECT_EQ(listed(f), (std::vector<std::string>{"f1cold1", "f3cold5", "f1warm7", "f3warm11", "stay2cold13"}));
  EXPECT_EQ(f.covariance.rows(), 5);
}

TEST(ChooseRows, LeavesOutModesAboveAFrequencyButNoStays) {
  FeatureSet f = two_days();
  choose_rows({.left_out = {}, .highest_Hz = 2.5}, f);
  EXPECT_EQ(listed(f), (std::vector<std::string>{"f1cold1", "s1cold2", "f2cold3", "s2cold4", "f1warm7", "s1warm8", "f2warm9",
                                                 "s2warm10", "stay2cold13"}));
  FeatureSet all = two_days();
  choose_rows({}, all);
  EXPECT_EQ(all.rows.size(), 13U);
}

TEST(ChooseRows, RefusesWhatIsNotThere) {
  FeatureSet f = two_days();
  EXPECT_THROW(choose_rows({.left_out = {"mode:8"}}, f), InputError);
  EXPECT_THROW(choose_rows({.left_out = {"shapes"}}, f), InputError);
  EXPECT_THROW(choose_rows({.left_out = {"shape", "frequency_Hz", "stay_frequency_Hz"}}, f), InputError);
  EXPECT_EQ(f.rows.size(), 13U);  // nothing was taken
}

std::vector<int> held(const FeatureSet& f) {
  std::vector<int> out;
  for (std::size_t r = 0; r < f.rows.size(); ++r)
    if (f.rows[r].held_out) out.push_back(static_cast<int>(r));
  return out;
}

TEST(HoldOut, ByConditionModeAndType) {
  const auto by = [](const std::vector<std::string>& rules) {
    FeatureSet f = two_days();
    f.rows[0].held_out = true;  // a mark gives way to rules
    hold_out(rules, f);
    return held(f);
  };
  EXPECT_EQ(by({"warm"}), (std::vector<int>{6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(by({"warm/3"}), (std::vector<int>{10, 11}));
  EXPECT_EQ(by({"warm/3/shape"}), std::vector<int>{11});
  EXPECT_EQ(by({"cold/1/frequency_Hz", "warm/2"}), (std::vector<int>{0, 8, 9}));
  EXPECT_EQ(by({"none"}), std::vector<int>{});
}

TEST(HoldOut, EverySecondModeInAscendingFrequency) {
  // Modes at 3, 1, 4 and 2 Hz: those at 2 and 4 Hz are the second and the fourth.
  FeatureSet f = two_days();
  f.rows.erase(f.rows.begin(), f.rows.end());
  for (const double hertz : {3.0, 1.0, 4.0, 2.0})
    f.rows.push_back({RowType::frequency, std::to_string(static_cast<int>(hertz)), -1, "", 0, hertz, 0.01, false});
  hold_out({"cold/every_second"}, f);
  EXPECT_EQ(held(f), (std::vector<int>{2, 3}));
}

TEST(HoldOut, WithoutRulesNoModeIsAndOfLoadTestsTheWarmestIs) {
  FeatureSet f = two_days();
  hold_out({}, f);
  EXPECT_TRUE(held(f).empty());
  // Load tests alone at three temperatures: those of the highest are held out.
  f.rows.clear();
  f.conditions.resize(3);
  for (int c = 0; c < 3; ++c) {
    f.conditions[static_cast<std::size_t>(c)].temperature_C = 10.0 * c;
    f.rows.push_back({RowType::static_strain, "", -1, "", c, 1e-4, 1e-6, false});
  }
  hold_out({}, f);
  EXPECT_EQ(held(f), std::vector<int>{2});
}

TEST(HoldOut, RefusesARuleThatMatchesNothing) {
  for (const char* rule : {"hot", "warm/4", "warm/3/rms_m_s2", "hot/every_second"}) {
    FeatureSet f = two_days();
    EXPECT_THROW(hold_out({rule}, f), InputError) << rule;
  }
}

TEST(HasRowsOfModes, NotOfLoadTestsAlone) {
  FeatureSet f = two_days();
  EXPECT_TRUE(diagnosis::has_rows_of_modes(f));
  for (auto& row : f.rows) row.type = RowType::static_strain;
  EXPECT_FALSE(diagnosis::has_rows_of_modes(f));
}

/// Five equal masses in a row, whose shapes are sines, with two measured modes and a third of no likeness.
std::unique_ptr<Predicted> with_a_stranger() {
  auto model = std::make_unique<Predicted>(nodes_in_a_row(5), springs_in_a_row(Eigen::VectorXd::Constant(6, 2e6)),
                                           Eigen::MatrixXd(1000.0 * Eigen::MatrixXd::Identity(5, 5)));
  const auto add = [&](int mode, const std::string& label, const std::function<double(int)>& shape) {
    const double hertz = 2.0 * std::sqrt(2000.0) * std::sin(mode * std::numbers::pi / 12.0) / (2.0 * std::numbers::pi);
    model->add_row(RowType::frequency, label, -1, hertz, 0.01 * hertz);
    for (int c = 0; c < 5; ++c) model->add_row(RowType::shape, label, c, shape(c), 0.02);
  };
  add(1, "1", [](int c) { return std::sin((c + 1) * std::numbers::pi / 6.0); });
  add(2, "2", [](int c) { return c == 1 ? 1.0 : 0.0; });  // one channel alone: a third of it in any mode at most
  add(3, "3", [](int c) { return std::sin(3 * (c + 1) * std::numbers::pi / 6.0); });
  return model;
}

TEST(LeaveOutUnpaired, TakesTheModesThatAreLikeNone) {
  auto model = with_a_stranger();
  const auto found = leave_out_unpaired(0.6, {}, model->reduced(), model->features);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->names.size(), 1U);
  EXPECT_EQ(found->names[0].substr(0, 9), "2 of calm");
  EXPECT_EQ(model->features.rows.size(), 12U);
  for (const auto& row : model->features.rows) EXPECT_NE(row.mode, "2");
}

TEST(LeaveOutUnpaired, TakesNothingWhereNothingIsAsked) {
  auto model = with_a_stranger();
  EXPECT_FALSE(leave_out_unpaired(0.0, {}, model->reduced(), model->features).has_value());
  EXPECT_FALSE(leave_out_unpaired(0.2, {}, model->reduced(), model->features).has_value());
  EXPECT_EQ(model->features.rows.size(), 18U);
}

TEST(LeaveOutUnpaired, RefusesToTakeAll) {
  auto model = with_a_stranger();
  std::erase_if(model->features.rows, [](const auto& row) { return row.mode != "2"; });
  EXPECT_THROW((void)leave_out_unpaired(0.6, {}, model->reduced(), model->features), InputError);
}

}  // namespace
}  // namespace twindeck::tests
