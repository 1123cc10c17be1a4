// Oracles: numbers and texts typed in here; the study's own file must be readable and its trials complete.
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.hpp"
#include "ponte/calibration/calibration_files.hpp"
#include "test_places.hpp"

namespace twindeck::ponte {
namespace {

const std::string kSmall = R"([[target]]
variant = "refined"
source = "made up"
modes = [1]
frequency_Hz = [0.7]
[[force]]
variant = "refined"
source = "made up"
stays = ["NE5", "NE7"]
force_kN = [368.0, 263.0]
std_pct = 5.0
reason = "made up"
[[mass]]
variant = "refined"
name = "foot deck"
groups = ["foot"]
length_m = 173.0
mass_kg_m = 1350.0
std_kg_m = 175.0
lower_kg_m = 1000.0
upper_kg_m = 1700.0
reason = "made up"
[[displacement]]
variant = "refined"
limit_mm = 10.0
std_mm = 2.0
reason = "made up"
[fit]
frequency_std_pct = 1.0
whole_range_costs = 0.002
max_iterations = 5
[[value]]
name = "depth"
paths = ["deck.foot.truss_depth"]
unit = "m"
start = 1.4
lower = 1.0
upper = 1.8
reason = "made up"
[[value]]
name = "offset"
paths = ["deck.foot.bottom_chord_offset"]
unit = "m"
start = 0.3
lower = 0.0
upper = 1.2
scale = "linear"
reason = "made up"
[[form]]
name = "rectangle"
meaning = "made up"
[form.set]
"deck.foot.bottom_chord_offset" = 0
"deck.foot.bottom_chord_spacing" = 3.0
[[trial]]
name = "all"
form = "rectangle"
use = ["frequencies", "forces"]
whole_range_costs = 0.02
)";

std::filesystem::path written(const std::string& text) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      ("calibration_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".toml");
  std::ofstream(file) << text;
  return file;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string refused(const std::string& text) {
  try {
    (void)read_calibration(written(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CalibrationFile, KnownForcesMassesAndLimitsAreInSiUnits) {
  const Calibration c = read_calibration(written(kSmall));
  ASSERT_EQ(c.forces.size(), 1u);
  EXPECT_EQ(c.forces[0].force_N, (std::vector<double>{368e3, 263e3}));
  EXPECT_DOUBLE_EQ(c.forces[0].relative_std, 0.05);
  EXPECT_DOUBLE_EQ(c.masses.at(0).known.mass_kg_m, 1350.0);
  EXPECT_DOUBLE_EQ(c.limits.at(0).limit.limit_m, 0.01);
  EXPECT_DOUBLE_EQ(c.limits.at(0).limit.std_m, 0.002);
  EXPECT_DOUBLE_EQ(c.frequency_std, 0.01);
  // The plain fit is to frequencies alone.
  EXPECT_EQ(c.weight, (std::array<double, 4>{1.0, 0.0, 0.0, 0.0}));
}

TEST(CalibrationFile, ATrialTakesItsFormAndLeavesOutWhatTheFormGives) {
  const Calibration c = for_trial(read_calibration(written(kSmall)), "all");
  EXPECT_EQ(c.weight, (std::array<double, 4>{1.0, 1.0, 0.0, 0.0}));
  EXPECT_DOUBLE_EQ(c.whole_range_costs, 0.02);
  ASSERT_EQ(c.values.size(), 1u);
  const ponte::Values values = bridge_values(c, Eigen::VectorXd::Constant(1, 1.0));
  EXPECT_DOUBLE_EQ(values.at("deck.foot.truss_depth"), 1.8);
  EXPECT_DOUBLE_EQ(values.at("deck.foot.bottom_chord_offset"), 0.0);
  EXPECT_DOUBLE_EQ(values.at("deck.foot.bottom_chord_spacing"), 3.0);
}

TEST(CalibrationFile, WrongDataAreNamed) {
  EXPECT_NE(refused(replaced(kSmall, "[368.0, 263.0]", "[368.0]")).find("force_kN"), std::string::npos);
  EXPECT_NE(refused(replaced(kSmall, "std_pct = 5.0", "std_pct = 0.0")).find("std_pct"), std::string::npos);
  EXPECT_NE(refused(replaced(kSmall, "\"forces\"]", "\"forrces\"]")).find("forrces"), std::string::npos);
  EXPECT_NE(refused(replaced(kSmall, "form = \"rectangle\"", "form = \"rectangel\"")).find("rectangle"), std::string::npos);
  EXPECT_NE(refused(replaced(kSmall, "variant = \"refined\"\nlimit_mm", "variant = \"refind\"\nlimit_mm")).find("refined"),
            std::string::npos);
  EXPECT_NE(refused(replaced(kSmall, "lower_kg_m = 1000.0", "lower_kg_m = 1800.0")).find("lower_kg_m"), std::string::npos);
  EXPECT_THROW((void)for_trial(read_calibration(written(kSmall)), "al"), InputError);
}

TEST(CalibrationFile, TheStudysTrialsAreReadable) {
  const Calibration c = read_calibration(std::filesystem::path(TWINDECK_SOURCE_DIR) / "data/ponte_del_mare/calibration.toml");
  ASSERT_FALSE(c.trials.empty());
  for (const CalibrationTrial& trial : c.trials) EXPECT_FALSE(for_trial(c, trial.name).values.empty()) << trial.name;
}

}  // namespace
}  // namespace twindeck::ponte
