/// Oracle: the format as docs/my_records.md states it; every refusal names the line.
#include "records/feature_rows.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "npy_double.hpp"

namespace twindeck::records {
namespace {

const std::string kHead = "type,mode,channel,condition,value,std,held_out\n";
const std::string kGood = "frequency_Hz,1,,calm,2.5,0.01,\nshape,1,a,calm,1.0,0.02,0\nshape,1,b,calm,-0.5,0.02,1\n";

class FeatureRowsOf : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("twindeck_rows_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  FeatureRows read(const std::string& rows) const {
    std::ofstream(folder_ / "rows.csv") << kHead << rows;
    MeasuredCondition calm, windy, loaded;
    calm.name = "calm";
    windy.name = "windy";
    loaded.name = "loaded";
    loaded.load = "lorry_at_midspan";
    matching::Channel a, b;
    a.name = "a";
    b.name = "b";
    matching::Channel gauge, cell;
    gauge.name = "gauge";
    gauge.element = "17";
    cell.name = "cell";
    cell.support = "pier";
    return read_feature_rows(folder_, {calm, windy, loaded}, {a, b, gauge, cell});
  }
  std::string refusal(const std::string& rows) const {
    try {
      (void)read(rows);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(FeatureRowsOf, AreReadInOrder) {
  const FeatureRows read = this->read(kGood);
  ASSERT_EQ(read.rows.size(), 3U);
  EXPECT_EQ(read.rows[0].value, 2.5);
  EXPECT_EQ(read.rows[0].std, 0.01);
  EXPECT_EQ(read.rows[1].channel, "a");
  EXPECT_FALSE(read.rows[1].held_out);
  EXPECT_TRUE(read.rows[2].held_out);
  EXPECT_EQ(read.covariance.size(), 0);
}

TEST_F(FeatureRowsOf, TakeDeviationsFromTheDiagonalOfTheCovariance) {
  io::write_npy(Eigen::Vector3d(4e-4, 9e-4, 16e-4).asDiagonal().toDenseMatrix(), folder_ / "covariance.npy");
  std::string rows = kGood;
  rows.replace(rows.find("2.5,0.01"), 8, "2.5,");  // the column may then be empty
  const FeatureRows read = this->read(rows);
  EXPECT_DOUBLE_EQ(read.rows[0].std, 0.02);
  EXPECT_DOUBLE_EQ(read.rows[1].std, 0.03);  // and does not count where it is filled
  EXPECT_EQ(read.covariance.rows(), 3);
  EXPECT_NE(refusal(rows + "shape,2,b,calm,1,,\n").find("covariance.npy: is 3 x 3, but rows.csv has 4 rows"),
            std::string::npos);
}

TEST_F(FeatureRowsOf, RefuseWhatTheFormatDoesNotHave) {
  const auto expect = [&](const std::string& rows, const std::string& said) {
    EXPECT_NE(refusal(rows).find(said), std::string::npos) << rows << refusal(rows);
  };
  expect("frequencyHz,1,,calm,2.5,0.01,\n",
         "rows.csv:2: type: 'frequencyHz' is not a known type of row (did you mean 'frequency_Hz'?)");
  expect("frequency_Hz,1,,clam,2.5,0.01,\n",
         "rows.csv:2: condition: condition 'clam' is not in conditions.toml (did you mean 'calm'?)");
  expect(kGood + "shape,1,c,calm,1,0.1,\n", "rows.csv:5: channel: channel 'c' is not in channels.csv");
  expect("frequency_Hz,1,,calm,2.5,,\n", "rows.csv:2: std: is empty");
  expect("frequency_Hz,1,,calm,2.5,-1,\n", "rows.csv:2: std: is -1, expected a value above 0");
  expect("frequency_Hz,1,,calm,2.5,1e-300,\n", "rows.csv:2: std: is 1e-300");
  expect("frequency_Hz,1,,calm,0,0.1,\n", "rows.csv:2: value: is 0, expected a frequency above 0");
  expect("frequency_Hz,1,,calm,1e300,0.1,\n", "rows.csv:2: value: is \"1e300\", larger than any quantity of a structure");
  expect("shape,1,a,calm,1e300,0.1,\n", "rows.csv:2: value: is \"1e300\", larger than any quantity of a structure");
  expect("frequency_Hz,,,calm,2.5,0.1,\n", "rows.csv:2: mode: is empty");
  expect("damping_ratio_pct,1,,calm,100,0.1,\n", "rows.csv:2: value: is 100, expected a damping ratio below 100 %");
  expect("stay_frequency_Hz,first,S1,calm,2,0.1,\n", "rows.csv:2: mode: is 'first', expected the harmonic of the stay");
  expect("static_m,,a,calm,-0.01,0.001,\n",
         "rows.csv:2: type: a row of type static_m needs a load, but condition 'calm' names none");
  EXPECT_EQ(
      refusal(
          "static_m,,a,loaded,-0.01,0.001,\nstatic_rotation_rad,,a,loaded,0,1e-5,\nstatic_strain,,gauge,loaded,-2e-5,1e-6,\n"
          "static_force_N,,cell,loaded,-3e4,1e3,\n"),
      "");
  expect("static_strain,,a,loaded,1e-5,1e-6,\n",
         "rows.csv:2: channel: a row of type static_strain needs a channel at an element, which 'a' is not");
  expect("static_force_N,,gauge,loaded,1e5,1e3,\n",
         "rows.csv:2: channel: a row of type static_force_N needs a channel at a support");
  expect("static_m,,cell,loaded,1e-3,1e-4,\n", "rows.csv:2: channel: a row of type static_m needs a channel at a point");
}

TEST_F(FeatureRowsOf, RefuseAHeldOutThatIsNeitherYesNorNo) {
  for (const char* mark : {"2", "0.5", "-1", "1e300"})
    EXPECT_NE(refusal(std::string("frequency_Hz,1,,calm,2.5,0.01,") + mark + "\n").find("rows.csv:2: held_out: is "),
              std::string::npos)
        << mark;
}

TEST_F(FeatureRowsOf, RefuseAModeThatIsASlipInANumber) {
  for (const char* mode : {"1.5", "-1", "0", "1e3"})
    EXPECT_NE(refusal(kGood + "frequency_Hz," + mode + ",,calm,2.5,0.01,\n").find("rows.csv:5: mode: is '"), std::string::npos)
        << mode;
  EXPECT_EQ(refusal(kGood + "frequency_Hz,first torsion,,calm,2.5,0.01,\n"), "");
}

TEST_F(FeatureRowsOf, RefuseAQuantityThatStandsTwice) {
  const auto twice = [&](const std::string& row) {
    return refusal(kGood + row).find("rows.csv:5: type: this row stands twice");
  };
  EXPECT_NE(twice("shape,1,b,calm,0.7,0.02,\n"), std::string::npos);
  EXPECT_NE(twice("frequency_Hz,1,a,calm,2.6,0.01,\n"), std::string::npos);  // whatever stands in a column that does not count
  EXPECT_EQ(twice("shape_imag,1,b,calm,0.7,0.02,\n"), std::string::npos);
  EXPECT_EQ(twice("shape,1,b,windy,0.7,0.02,\n"), std::string::npos);
}

TEST_F(FeatureRowsOf, RefuseAShapeOfZeros) {
  const std::string zeros = "frequency_Hz,2,,calm,2.6,0.01,\nshape,2,a,calm,0,0.02,\nshape,2,b,calm,0,0.02,\n";
  EXPECT_NE(refusal(kGood + zeros).find("rows.csv:6: value: the shape of mode 2 in condition 'calm' is zero at every channel"),
            std::string::npos)
      << refusal(kGood + zeros);
  EXPECT_EQ(refusal(kGood + zeros + "shape_imag,2,b,calm,0.4,0.02,\n"), "");
}

}  // namespace
}  // namespace twindeck::records
