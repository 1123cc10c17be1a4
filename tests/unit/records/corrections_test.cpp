/// Oracle: by construction, and the contract: corrections act in the order of the file, by the names that those before have
/// left.
#include "records/corrections.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"

namespace twindeck::records {
namespace {

using Action = Correction::Action;

Correction reverse(const std::string& channel) { return {channel, Action::reverse, "", 1.0, "", {}}; }
Correction exchange(const std::string& a, const std::string& b) { return {a, Action::exchange, b, 1.0, "", {}}; }
Correction scale(const std::string& channel, double factor) { return {channel, Action::scale, "", factor, "", {}}; }

TEST(Corrected, FollowsNamesThroughTheList) {
  const std::vector<Correction> list = {reverse("a"), exchange("a", "b"), scale("a", 2.0)};
  EXPECT_EQ(corrected(list, "a", "").name, "b");
  EXPECT_EQ(corrected(list, "a", "").factor, -1.0);
  EXPECT_EQ(corrected(list, "b", "").name, "a");
  EXPECT_EQ(corrected(list, "b", "").factor, 2.0);  // it is a by the time that a is scaled
  EXPECT_EQ(corrected(list, "c", "").name, "c");
  EXPECT_EQ(corrected(list, "c", "").factor, 1.0);
}

TEST(Corrected, ThreeChannelsInARing) {
  const std::vector<Correction> ring = {exchange("a", "b"), exchange("b", "c")};
  EXPECT_EQ(corrected(ring, "a", "").name, "c");
  EXPECT_EQ(corrected(ring, "b", "").name, "a");
  EXPECT_EQ(corrected(ring, "c", "").name, "b");
}

TEST(CorrectedRows, TakeSignSizeAndSquareAsTheirTypeNeeds) {
  FeatureRows features;
  const auto add = [&](const std::string& type, const std::string& channel, double value) {
    FeatureRow row;
    row.type = type;
    row.channel = channel;
    row.value = value;
    row.std = 0.1;
    features.rows.push_back(row);
  };
  add("shape", "a", 1.0);
  add("rms_m_s2", "a", 3.0);
  add("psd_floor_m2_s3", "a", 5.0);
  add("static_m", "a", 7.0);
  add("frequency_Hz", "", 2.0);
  add("stay_frequency_Hz", "a", 4.0);  // a stay of that name, no channel
  features.covariance = Eigen::MatrixXd::Constant(6, 6, 0.01);
  correct({reverse("a"), scale("a", 2.0)}, {}, features);
  const std::vector<double> expected = {-2.0, 6.0, 20.0, -14.0, 2.0, 4.0};
  for (std::size_t r = 0; r < expected.size(); ++r)
    EXPECT_DOUBLE_EQ(features.rows[r].value, expected[r]) << features.rows[r].type;
  EXPECT_DOUBLE_EQ(features.rows[0].std, 0.2);
  EXPECT_DOUBLE_EQ(features.rows[2].std, 0.4);
  EXPECT_DOUBLE_EQ(features.covariance(0, 1), -0.04);
  EXPECT_DOUBLE_EQ(features.covariance(0, 3), 0.04);
  EXPECT_DOUBLE_EQ(features.covariance(2, 4), 0.04);
  EXPECT_DOUBLE_EQ(features.covariance(4, 5), 0.01);
}

TEST(CorrectedRows, AFaultOfOneStateIsCorrectedInItsConditionsAlone) {
  std::vector<MeasuredCondition> conditions(2);
  conditions[0].name = "before";
  conditions[1].name = "after";
  conditions[1].state = "repaired";
  FeatureRows features;
  for (const char* condition : {"before", "after"}) {
    FeatureRow row;
    row.type = "shape";
    row.condition = condition;
    row.channel = "a";
    row.value = 1.0;
    features.rows.push_back(row);
  }
  Correction late = scale("a", 2.0);
  late.state = "repaired";
  EXPECT_EQ(words_of(late), "a multiplied by 2 in state repaired");
  correct({late, reverse("a")}, conditions, features);
  EXPECT_DOUBLE_EQ(features.rows[0].value, -1.0);
  EXPECT_DOUBLE_EQ(features.rows[1].value, -2.0);
  late.state = "repared";
  try {
    correct({late}, conditions, features);
    FAIL() << "a state that the measurement has not";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("repaired"), std::string::npos) << e.what();
  }
}

TEST(CorrectedConditions, TheAmplitudesChannelGoesAlong) {
  std::vector<MeasuredCondition> conditions(1);
  conditions[0].amplitude_channel = "a";
  conditions[0].amplitude_m = 0.002;
  correct({exchange("a", "b"), scale("b", 3.0)}, conditions);
  EXPECT_EQ(conditions[0].amplitude_channel, "b");
  EXPECT_DOUBLE_EQ(*conditions[0].amplitude_m, 0.006);
}

TEST(Corrections, ReadBackAsTheyWereWritten) {
  const auto file = std::filesystem::temp_directory_path() / "twindeck_corrections.toml";
  std::ofstream(file) << "# a comment\n"
                      << corrections_toml({reverse("A 5"), exchange("b", "c"), scale("d", 0.7142857142857143)})
                      << "state = \"after\"\n";
  const std::vector<Correction> read = read_corrections(file);
  std::filesystem::remove(file);
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(words_of(read[0]), "A 5 reversed");
  EXPECT_EQ(words_of(read[1]), "b and c exchanged");
  EXPECT_EQ(read[2].factor, 0.7142857142857143);
  EXPECT_EQ(read[1].state, "");
  EXPECT_EQ(read[2].state, "after");
  EXPECT_NE(corrections_toml(read).find("state = \"after\""), std::string::npos);
}

TEST(Corrections, OneIsUndoneByItselfUnlessNamesMeanOthersByThen) {
  EXPECT_EQ(undone_by({reverse("a"), scale("b", 2.0)}, reverse("a")), 0U);
  EXPECT_EQ(undone_by({exchange("a", "b")}, exchange("b", "a")), 0U);
  EXPECT_FALSE(undone_by({reverse("a"), exchange("a", "b")}, reverse("a")));
  EXPECT_FALSE(undone_by({exchange("a", "b"), reverse("a")}, exchange("a", "b")));
  EXPECT_FALSE(undone_by({scale("a", 2.0)}, scale("a", 0.5)));
  Correction late = reverse("a");
  late.state = "after";
  EXPECT_FALSE(undone_by({reverse("a")}, late));
  EXPECT_EQ(undone_by({late}, late), 0U);
}

TEST(ChosenConditions, StatesComeInTheOrderOfTheFileWithTheReferenceFirst) {
  std::vector<MeasuredCondition> conditions(3);  // as read: by name
  conditions[0].name = "a";
  conditions[0].state = "late";
  conditions[0].line = 9;
  conditions[1].name = "b";
  conditions[1].state = "early";
  conditions[1].line = 1;
  conditions[2].name = "c";
  conditions[2].line = 5;
  EXPECT_EQ(states_of(conditions), (std::vector<std::string>{"reference", "early", "late"}));
  EXPECT_EQ(choose_condition("f", conditions, {}), "c");
  EXPECT_EQ(choose_condition("f", conditions, {"", "late"}), "a");
  EXPECT_THROW((void)choose_condition("f", conditions, {"b", "late"}), InputError);
  EXPECT_EQ(chosen_conditions("f", conditions, {}).size(), 3U);
}

}  // namespace
}  // namespace twindeck::records
