#pragma once

#include <filesystem>

/// Workbooks of Excel (.xlsx) as tables: what a table's reader gets in place of a CSV file.
namespace twindeck::io {

[[nodiscard]] bool is_spreadsheet(const std::filesystem::path& file);

/// The table that a folder holds under the name of a CSV file: that file, or else a workbook of the same name beside it.
[[nodiscard]] std::filesystem::path table_file(const std::filesystem::path& csv);

/// Whether either of the two is there.
[[nodiscard]] bool has_table(const std::filesystem::path& csv);

/// The first sheet of a workbook as a CSV file in the folder of temporary files, which the caller removes. A Python program of
/// the product (workflows/common/spreadsheet.py, by openpyxl) reads the workbook; it runs as a process of its own.
/// @throws InputError  if it is no workbook, holds more than is read of a table, or openpyxl is not installed
[[nodiscard]] std::filesystem::path csv_of_spreadsheet(const std::filesystem::path& file);

}  // namespace twindeck::io
