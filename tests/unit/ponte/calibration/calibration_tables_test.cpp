// Tables of a calibration. Oracles: cells calculated by hand from numbers set here, and that a table read back gives the same
// parts.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/error.hpp"
#include "ponte/calibration/calibration_files.hpp"

namespace twindeck::ponte {
namespace {

using Eigen::VectorXd;
using io::CsvTable;

std::filesystem::path table_file() {
  return std::filesystem::path(testing::TempDir()) /
         ("calibration_tables_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
}

/// Two variants: two frequencies and one stay in the first, one frequency, a mass and a limit in the second.
Calibration two_variants() {
  Calibration out;
  out.targets = {{"old", "paper", {1, 3}, {2.0, 4.0}}, {"new", "report", {2}, {5.0}}};
  out.forces = {{"old", "tests", "", {"S1"}, {200e3}, 0.05}, {"old", "again", "", {"S1"}, {250e3}, 0.10}};
  out.masses = {{"new", "drawing", {"foot deck", {"foot"}, 10.0, 1000.0, 50.0}, 900.0, 1200.0}};
  out.limits = {{"new", "levels", {0.010, 0.002}}};
  CalibrationValue depth, offset;
  depth.name = "depth", depth.unit = "m", depth.reason = "drawn";
  depth.start = 2.0, depth.lower = 1.0, depth.upper = 16.0;
  offset.name = "offset", offset.unit = "m", offset.reason = "seen";
  offset.start = 0.5, offset.lower = -1.0, offset.upper = 1.0, offset.linear = true;
  out.values = {depth, offset};
  return out;
}

CalibrationResult result_of_two_variants() {
  CalibrationResult out;
  out.part = Eigen::Vector2d(0.5, 1.0);
  out.untuned = Eigen::Vector3d(2.2, 3.0, 5.0);
  out.fitted = Eigen::Vector3d(2.06, 3.84, 5.05);
  updating::StructureAnswer old_one, new_one;
  old_one.force_N = Eigen::Vector2d(190e3, 190e3);
  new_one.mass_kg_m = VectorXd::Constant(1, 1100.0);
  new_one.displacement_m = Eigen::Vector2d(0.004, -0.012);
  out.answers = {old_one, new_one};
  old_one.force_N.setConstant(150e3);
  new_one.mass_kg_m(0) = 800.0;
  new_one.displacement_m *= 2.0;
  out.untuned_answers = {old_one, new_one};
  out.costs = {0.1, 0.2, 0.3, 0.4, 0.5};
  out.iterations = 9;
  return out;
}

// Half of 1 to 16 in the logarithm is 4; the offset is on its upper edge.
TEST(CalibrationTables, ValuesAreTheFittedOnesWithTheirEdges) {
  write_calibration_values(two_variants(), result_of_two_variants(), table_file());
  const CsvTable table =
      CsvTable::read(table_file(), {"value", "unit", "untuned", "lower", "upper", "fitted", "edge", "reason"});
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.text(0, "value"), "depth");
  EXPECT_DOUBLE_EQ(table.number(0, "untuned"), 2.0);
  EXPECT_NEAR(table.number(0, "fitted"), 4.0, 1e-11);
  EXPECT_EQ(table.text(0, "edge"), "");
  EXPECT_DOUBLE_EQ(table.number(1, "fitted"), 1.0);
  EXPECT_EQ(table.text(1, "edge"), "upper");
  EXPECT_EQ(table.text(1, "reason"), "seen");
}

TEST(CalibrationTables, EdgesReachAThousandthOfTheRange) {
  CalibrationResult result = result_of_two_variants();
  result.part = Eigen::Vector2d(0.0009, 0.9989);
  write_calibration_values(two_variants(), result, table_file());
  const CsvTable table = CsvTable::read(table_file(), {"edge"}, {}, true);
  EXPECT_EQ(table.text(0, "edge"), "lower");
  EXPECT_EQ(table.text(1, "edge"), "");
}

// 2.2 / 2 is 10 % high, 3.84 / 4 is 4 % low, 5.05 / 5 is 1 % high.
TEST(CalibrationTables, FrequenciesHaveTheirErrorsInPerCent) {
  write_calibration_frequencies(two_variants(), result_of_two_variants(), table_file());
  const CsvTable table =
      CsvTable::read(table_file(), {"variant", "mode", "printed_Hz", "untuned_error_pct", "fitted_error_pct"}, {}, true);
  ASSERT_EQ(table.rows(), 3U);
  EXPECT_NEAR(table.number(0, "untuned_error_pct"), 10.0, 1e-9);
  EXPECT_EQ(table.integer(1, "mode"), 3);
  EXPECT_NEAR(table.number(1, "fitted_error_pct"), -4.0, 1e-9);
  EXPECT_EQ(table.text(2, "variant"), "new");
  EXPECT_NEAR(table.number(2, "fitted_error_pct"), 1.0, 1e-9);
}

TEST(CalibrationTables, KnownQuantitiesStandBesideTheModels) {
  write_calibration_known(two_variants(), result_of_two_variants(), table_file());
  const CsvTable table = CsvTable::read(table_file(), {"variant", "kind", "known", "std", "untuned", "fitted"}, {}, true);
  ASSERT_EQ(table.rows(), 4U);
  EXPECT_EQ(table.text(0, "kind"), "cable_force");
  EXPECT_NEAR(table.number(0, "std"), 10e3, 1e-6);  // 5 % of 200 kN
  EXPECT_NEAR(table.number(1, "std"), 25e3, 1e-6);  // 10 % of 250 kN
  EXPECT_DOUBLE_EQ(table.number(0, "untuned"), 150e3);
  EXPECT_DOUBLE_EQ(table.number(2, "fitted"), 1100.0);
  EXPECT_DOUBLE_EQ(table.number(2, "upper"), 1200.0);
  EXPECT_DOUBLE_EQ(table.number(3, "untuned"), 0.024);  // the largest size of either sign
  EXPECT_DOUBLE_EQ(table.number(3, "fitted"), 0.012);
  EXPECT_DOUBLE_EQ(table.number(3, "upper"), 0.010);
  EXPECT_EQ(table.text(3, "known"), "");
}

TEST(CalibrationTables, StartsArePartsOfTheRanges) {
  const VectorXd part = starts(two_variants());
  EXPECT_NEAR(part(0), 0.25, 1e-14);  // 2 of 1 to 16 in the logarithm
  EXPECT_NEAR(part(1), 0.75, 1e-14);  // 0.5 of -1 to 1
}

// A table that was written gives the parts back; a value that it does not have begins at its start; one outside is put inside.
TEST(CalibrationTables, PartsOfAnEarlierFitComeBack) {
  Calibration calibration = two_variants();
  write_calibration_values(calibration, result_of_two_variants(), table_file());
  EXPECT_LT((parts_in(table_file(), calibration) - Eigen::Vector2d(0.5, 1.0)).norm(), 1e-11);
  calibration.values[0].name = "another";
  calibration.values[1].upper = 0.9;
  EXPECT_LT((parts_in(table_file(), calibration) - Eigen::Vector2d(0.25, 1.0)).norm(), 1e-11);
}

TEST(CalibrationTables, PartsOfAFileWithoutValuesAreRefused) {
  std::ofstream(table_file()) << "value,unit\ndepth,m\n";
  EXPECT_THROW((void)parts_in(table_file(), two_variants()), InputError);
  std::ofstream(table_file()) << "value,fitted\ndepth,deep\n";
  EXPECT_THROW((void)parts_in(table_file(), two_variants()), InputError);
}

// A logarithmic range has no part for a negative number.
TEST(CalibrationTables, PartsOfANegativeValueAreRefused) {
  std::ofstream(table_file()) << "value,fitted\ndepth,-2\n";
  EXPECT_THROW((void)parts_in(table_file(), two_variants()), InputError);
}

// rms of 3 % and -4 % is sqrt(12.5) %. The stay's one force of 190 kN is 5 % below its first source.
TEST(TradeTable, HasARowATrial) {
  TradeTable table(two_variants());
  const CalibrationTrial trial{"all", "box", {1.0, 1.0, 0.0, 1.0}, 0.02};
  table.add(trial, "fine", two_variants(), result_of_two_variants());
  CalibrationResult failed = result_of_two_variants();
  failed.status = {false, "does not settle"};
  table.add(trial, "fine", two_variants(), failed);
  table.save(table_file());
  const CsvTable read = CsvTable::read(table_file(), {"trial"}, {}, true);
  ASSERT_EQ(read.rows(), 2U);
  EXPECT_EQ(read.text(0, "fitted_to"), "frequencies forces displacements");
  EXPECT_EQ(read.integer(0, "values"), 2);
  EXPECT_EQ(read.integer(0, "values_on_edge"), 1);
  EXPECT_NEAR(read.number(0, "old_rms_pct"), std::sqrt(12.5), 1e-9);
  EXPECT_NEAR(read.number(0, "old_worst_pct"), 4.0, 1e-9);
  EXPECT_NEAR(read.number(0, "new_rms_pct"), 1.0, 1e-9);
  EXPECT_NEAR(read.number(0, "old_S1_kN"), 190.0, 1e-9);
  EXPECT_NEAR(read.number(0, "force_worst_pct"), -5.0, 1e-9);
  EXPECT_NEAR(read.number(0, "new_foot_deck_kg_m"), 1100.0, 1e-9);
  EXPECT_NEAR(read.number(0, "new_anchors_mm"), 12.0, 1e-9);
  EXPECT_NEAR(read.number(0, "cost_forces"), 0.2, 1e-12);
  EXPECT_NEAR(read.number(0, "cost_values"), 0.5, 1e-12);
  EXPECT_EQ(read.integer(0, "iterations"), 9);
  EXPECT_EQ(read.text(0, "settled"), "yes");
  EXPECT_EQ(read.text(1, "settled"), "no");
}

}  // namespace
}  // namespace twindeck::ponte
