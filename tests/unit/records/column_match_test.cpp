// Oracle: the rules of records/column_match.hpp and records/recorded_unit.hpp, each with a file's names made up here.
#include "records/column_match.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "records/recorded_unit.hpp"

namespace twindeck::records {
namespace {

using Columns = std::vector<Eigen::Index>;

/// A text file's channels behind a column of time, "" for a column without a name.
RecordInfo with_names(const std::vector<std::string>& names) {
  RecordInfo info;
  for (std::size_t c = 0; c < names.size(); ++c) {
    ChannelInfo channel;
    channel.position = static_cast<Eigen::Index>(c) + 2;
    channel.name = names[c].empty() ? "column " + std::to_string(c + 2) : names[c];
    info.names_channels = info.names_channels || !names[c].empty();
    info.channels.push_back(channel);
  }
  return info;
}

std::string match_refusal(const RecordInfo& info, const std::vector<std::string>& channels,
                          const std::vector<std::string>& columns = {}) {
  try {
    static_cast<void>(match_columns(info, channels, columns, "a.csv"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ColumnMatch, NamesBindAndWhatWasNotAskedForIsIgnored) {
  const ColumnMatch match = match_columns(with_names({"T", "D_z", "A_x", "B_x"}), {"A_x", "D_z"}, {}, "a.csv");
  EXPECT_EQ(match.columns, (Columns{2, 1}));
  EXPECT_EQ(match.warning, "");
}

TEST(ColumnMatch, SomeNamesButNotAllAreRefused) {
  const std::string said = match_refusal(with_names({"A_x", "B_y", "C_z"}), {"A_x", "B_x", "C_z"});
  EXPECT_TRUE(said.starts_with("a.csv: B_x: is no channel of the file")) << said;
  EXPECT_NE(said.find("did you mean 'B_y'"), std::string::npos);
  EXPECT_NE(said.find("the file has A_x, B_y, C_z"), std::string::npos);
}

TEST(ColumnMatch, NoNameOfTheFileIsTakenByPositionOnlyIfTheNumberIsEqual) {
  const ColumnMatch match = match_columns(with_names({"Ch 1", "Ch 2"}), {"A_x", "B_x"}, {}, "a.csv");
  EXPECT_EQ(match.columns, (Columns{0, 1}));
  EXPECT_NE(match.warning.find("a.csv: names none of its channels (it has Ch 1, Ch 2), which are taken by position"),
            std::string::npos);
  EXPECT_NE(match_columns(with_names({"", ""}), {"A_x", "B_x"}, {}, "a.csv").warning.find("it has no line of names"),
            std::string::npos);
  RecordInfo array = with_names({"", ""});
  array.has_header = false;  // samples x channels of an NPY file, where there is no place for names
  EXPECT_EQ(match_columns(array, {"A_x", "B_x"}, {}, "a.npy").warning, "");
  const std::string said = match_refusal(with_names({"Ch 1", "Ch 2", "Ch 3"}), {"A_x", "B_x"});
  EXPECT_NE(
      said.find("has 3 columns, but campaign.toml names 2 channels, none of which the file names: it has Ch 1, Ch 2, Ch 3"),
      std::string::npos)
      << said;
  EXPECT_NE(said.find("`columns`"), std::string::npos);
}

TEST(ColumnMatch, TheKeySaysWhichColumnIsWhich) {
  const RecordInfo info = with_names({"Ch 1", "Ch 2", "", "A_x"});
  EXPECT_EQ(match_columns(info, {"A_x", "B_x", "C_z"}, {"Ch 2", "column 4", "column 5"}, "a.csv").columns, (Columns{1, 2, 3}));
  EXPECT_EQ(match_columns(info, {"A_x"}, {"Ch 1"}, "a.csv").columns, (Columns{0}));  // although a column is called A_x
  EXPECT_NE(match_refusal(info, {"A_x"}, {"Ch 9"}).find("a.csv: Ch 9: is no column of the file (did you mean 'Ch 1'?)"),
            std::string::npos);
  EXPECT_NE(match_refusal(info, {"A_x"}, {"column 1"}).find("which has columns 2 to 5"), std::string::npos);
  EXPECT_NE(match_refusal(info, {"A_x"}, {"column 99999999999999999999"}).find("is no column"), std::string::npos);
}

TEST(ColumnMatch, ANameTwiceOrInALineOfAnotherWidthIsRefused) {
  EXPECT_NE(match_refusal(with_names({"A_x", "B_x", "A_x"}), {"A_x", "B_x"}).find("a.csv: A_x: names two columns of the file"),
            std::string::npos);
  RecordInfo info = with_names({"", "", ""});
  info.unaligned_header = {"A_x", "B_x"};
  info.unaligned_line = 3;
  const std::string said = match_refusal(info, {"D_z", "B_x", "A_x"});
  EXPECT_TRUE(said.starts_with("a.csv:3: B_x: is one of 2 names over rows of another width")) << said;
}

TEST(RecordedUnit, KnowsTheSpellingsOfLoggers) {
  for (const char* unit : {"m/s^2", "m/s2", "m/s\xC2\xB2", "[m/s**2]", "M/S/S", "m s-2"}) {
    EXPECT_EQ(recorded_unit(unit).value().quantity, "acceleration") << unit;
    EXPECT_EQ(si_factor(unit), 1.0) << unit;
  }
  EXPECT_NEAR(si_factor("g"), 9.80665, 0.0);
  EXPECT_NEAR(si_factor("mg"), 9.80665e-3, 1e-15);
  EXPECT_NEAR(si_factor("Gal"), 0.01, 0.0);
  EXPECT_NEAR(si_factor("\xC2\xB5m"), 1e-6, 1e-20);
  EXPECT_EQ(recorded_unit("mm/s").value().quantity, "velocity");
  EXPECT_EQ(recorded_unit("kN").value().quantity, "force");
  for (const char* unit : {"V", "mV", "counts", "digits"}) {
    ASSERT_TRUE(recorded_unit(unit).has_value()) << unit;
    EXPECT_EQ(si_factor(unit), 0.0);
  }
  for (const std::string& unit :
       {std::string("furlong"), std::string(""), std::string("degC"), std::string("mN"), std::string(1000000, ' ')}) {
    EXPECT_FALSE(recorded_unit(unit).has_value()) << unit.substr(0, 20);
  }
  for (const char* quantity : {"acceleration", "velocity", "displacement", "force"}) {
    for (const std::string& unit : units_of(quantity)) EXPECT_EQ(recorded_unit(unit).value().quantity, quantity) << unit;
  }
}

}  // namespace
}  // namespace twindeck::records
