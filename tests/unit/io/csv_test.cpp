#include "io/csv.hpp"

#include <limits>

#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

using CsvTest = test::TemporaryFolder;

// Oracle: RFC 4180: cells with commas, quotes and line ends come back as they were given.
TEST_F(CsvTest, RoundTripsEveryKindOfText) {
  const std::vector<std::string> texts{"plain", "with, comma", "with \"quote\"", "two\nlines", "crlf\r\ninside", " blanks ",
                                       ""};
  CsvWriter writer({"text", "number"});
  for (const std::string& text : texts) writer.row({text, 0.1});
  writer.save(folder_ / "sub" / "a.csv");
  const CsvTable table = CsvTable::read(folder_ / "sub" / "a.csv", {"text", "number"});
  ASSERT_EQ(table.rows(), texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(table.text(i, "text"), texts[i]);
  EXPECT_EQ(table.number(0, "number"), 0.1);
}

// Oracle: the bytes of the file contract (12 significant digits, empty cell for no value, LF).
TEST_F(CsvTest, WritesTheContractsBytes) {
  CsvWriter writer({"a_m", "b", "c"});
  writer.row({1.0 / 3.0, 7, std::optional<double>()});
  writer.row({-0.0, std::size_t{3}, 1e-7});
  writer.save(folder_ / "a.csv");
  EXPECT_EQ(content(folder_ / "a.csv"), "a_m,b,c\n0.333333333333,7,\n0,3,1e-07\n");
}

// Oracle: an only cell that is empty would be a blank line; it must stay a row.
TEST_F(CsvTest, KeepsEmptyCellsOfOneColumn) {
  CsvWriter writer({"a"});
  writer.row({""});
  writer.save(folder_ / "a.csv");
  EXPECT_EQ(CsvTable::read(folder_ / "a.csv", {"a"}).rows(), 1u);
}

// Oracle: files of spreadsheets: byte order mark, CRLF, blanks after commas, blank lines, no line end at the end.
TEST_F(CsvTest, ToleratesWhatSpreadsheetsWrite) {
  const auto file = write("a.csv", "\xEF\xBB\xBFmode, frequency_Hz\r\n1, 0.5\r\n\r\n2,+1.25e0");
  const CsvTable table = CsvTable::read(file, {"mode", "frequency_Hz"});
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.integer(1, "mode"), 2);
  EXPECT_EQ(table.number(0, "frequency_Hz"), 0.5);
  EXPECT_EQ(table.number(1, "frequency_Hz"), 1.25);
}

// Oracle: the messages as a user reads them: file, line, column, what is wrong, how to mend it.
TEST_F(CsvTest, RefusesWrongHeaders) {
  const auto read = [&](const char* text) {
    return refusal([&] { static_cast<void>(CsvTable::read(write("a.csv", text), {"mode", "frequency_Hz"}, {"note"})); });
  };
  EXPECT_EQ(read("mode\n"), "a.csv:1: frequency_Hz: column is missing; expected columns: mode,frequency_Hz");
  EXPECT_EQ(read("mode,frequencyHz\n"), "a.csv:1: unknown column 'frequencyHz'; did you mean 'frequency_Hz'?");
  EXPECT_EQ(read("mode,frequency_Hz,zeta\n"), "a.csv:1: unknown column 'zeta'; known columns are mode, frequency_Hz, note");
  EXPECT_EQ(read("mode,frequency_Hz,mode\n"), "a.csv:1: mode: column stands twice; remove or rename one of them");
  EXPECT_EQ(read(""), "a.csv:1: is empty, expected a header row; start the file with: mode,frequency_Hz");
  EXPECT_NE(read("mode;frequency_Hz\n").find("separated by semicolons"), std::string::npos);
  EXPECT_EQ(read("mode,frequency_Hz,note\n"), "");
  EXPECT_NE(refusal([&] { static_cast<void>(CsvTable::read(folder_ / "none.csv", {"a"})); }).find("none.csv: cannot be opened"),
            std::string::npos);
}

// Oracle: line numbers counted by hand, a quoted line end included.
TEST_F(CsvTest, NamesTheLineOfABadRow) {
  const auto read = [&](const char* text) {
    return refusal([&] { static_cast<void>(CsvTable::read(write("a.csv", text), {"a", "b"})); });
  };
  EXPECT_EQ(read("a,b\n\"x\ny\",1\n3\n"),
            "a.csv:4: has 1 cells, expected 2 as in the header; give every column a cell, empty where there is no value");
  EXPECT_NE(read("a,b\n1,\"open\n").find("a.csv:2: opens a quoted cell"), std::string::npos);
  EXPECT_NE(read("a,b\n1,\"x\"y\n").find("a.csv:2: has text after a closing quote"), std::string::npos);
}

// Oracle: none of these cells is a finite number; the message names file:line: column.
TEST_F(CsvTest, RefusesWhatIsNoFiniteNumber) {
  const CsvTable table = CsvTable::read(write("a.csv", "x\nnan\ninf\n-Infinity\nabc\n1.5 m\n1e999\n2.5\n\"\"\n0x10\n"), {"x"});
  for (const std::size_t row : {0, 1, 2, 3, 4, 5, 7, 8})
    EXPECT_THROW(static_cast<void>(table.number(row, "x")), InputError) << row;
  EXPECT_EQ(table.number(6, "x"), 2.5);
  const CsvTable large = CsvTable::read(write("b.csv", "x\n1e300\n-1e61\n1e60\n"), {"x"});
  EXPECT_EQ(refusal([&] { static_cast<void>(large.number(0, "x")); }),
            "b.csv:2: x: is \"1e300\", larger than any quantity of a structure; correct the value or its unit");
  EXPECT_THROW(static_cast<void>(large.number(1, "x")), InputError);
  EXPECT_EQ(large.number(2, "x"), 1e60);
  EXPECT_EQ(refusal([&] { static_cast<void>(table.number(0, "x")); }),
            "a.csv:2: x: is \"nan\", expected a finite number; leave the row out or mend the value");
  EXPECT_EQ(refusal([&] { static_cast<void>(table.number(7, "x")); }),
            "a.csv:9: x: is empty, expected a number; fill the cell");
  EXPECT_EQ(refusal([&] { static_cast<void>(table.integer(6, "x")); }),
            "a.csv:8: x: is \"2.5\", expected a whole number; write it without a fraction");
}

// Oracle: the meaning of an empty cell and of a column that is not there, as csv.hpp says.
TEST_F(CsvTest, EmptyAndAbsentFallBack) {
  const CsvTable table = CsvTable::read(write("a.csv", "x,y\n1,\n"), {"x"}, {"y", "z"});
  EXPECT_FALSE(table.has("z"));
  EXPECT_EQ(table.number_or(0, "y", 4.0), 4.0);
  EXPECT_EQ(table.number_or(0, "z", 5.0), 5.0);
  EXPECT_FALSE(table.number_if(0, "z").has_value());
  EXPECT_FALSE(table.integer_if(0, "y").has_value());
  EXPECT_EQ(table.text(0, "z"), "");
}

// Oracle: a number that is not finite in our own output is our own mistake.
TEST_F(CsvTest, WriterRefusesOurMistakes) {
  EXPECT_THROW(Cell{std::numeric_limits<double>::quiet_NaN()}, InternalError);
  CsvWriter writer({"a", "b"});
  EXPECT_THROW(writer.row({1}), InternalError);
}

}  // namespace
}  // namespace twindeck::io
