// Oracles: which of two files is there, by construction. The cells of a workbook are held by tests/paper/test_export.py.
#include "io/spreadsheet.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

class SpreadsheetTest : public test::TemporaryFolder {};

TEST_F(SpreadsheetTest, StandsForATableThatIsNotThere) {
  const std::filesystem::path book = write("nodes.xlsx", "x"), csv = std::filesystem::path(book).replace_extension(".csv");
  EXPECT_EQ(table_file(csv), book);
  EXPECT_TRUE(has_table(csv));
  write("nodes.csv", "node\n");
  EXPECT_EQ(table_file(csv), csv);
  EXPECT_FALSE(has_table(csv.parent_path() / "links.csv"));
}

TEST_F(SpreadsheetTest, WhatIsNoWorkbookIsRefusedAndLeavesNoFile) {
  const std::filesystem::path book = write("nodes.xlsx", "no workbook");
  try {
    static_cast<void>(csv_of_spreadsheet(book));
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("workbook"), std::string::npos) << error.what();  // or: openpyxl is not here
  }
  EXPECT_FALSE(is_spreadsheet("nodes.csv"));
}

}  // namespace
}  // namespace twindeck::io
