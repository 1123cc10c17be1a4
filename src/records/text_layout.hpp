#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace twindeck::records {

/// How a text file holds its numbers.
struct TextLayout {
  bool latin1 = false;                 ///< bytes that are no UTF-8: µ, °, ² of an old logger
  char separator = ',';                ///< ' ' for any run of blanks
  bool decimal_comma = false;
  long first_data_line = 1;            ///< from 1
  std::size_t columns = 0;
  std::vector<std::string> names;      ///< one a column, empty where the file has none
  std::vector<std::string> units;      ///< one a column, empty where it has none
  int time_column = -1;
  bool date_and_time = false;          ///< date in time_column, time of day in the next
  bool stamps = false;                 ///< time stamps, not seconds
  double time_unit_s = 1.0;            ///< 0.001 for milliseconds
  std::optional<double> header_rate_Hz;
  std::string header_rate_text;        ///< the line that says so
};

/// Reads the layout from the beginning of a file: header lines of any number and kind, a line `sep=;`, names and units.
/// @throws InputError  if no two lines of numbers follow one another
[[nodiscard]] TextLayout find_layout(const std::filesystem::path& file);

/// Cells of a line, blanks and quotes around them taken off; an empty cell after a last separator is no cell.
[[nodiscard]] std::vector<std::string_view> cells_of(std::string_view line, char separator);
/// A number ("1,5" with a decimal comma; Fortran's D exponent), NaN for a missing value (empty, NaN, ---, #N/A, OVER …), nothing for
/// other text.
[[nodiscard]] std::optional<double> number_in(std::string_view cell, bool decimal_comma);
/// Latin-1 as UTF-8.
[[nodiscard]] std::string from_latin1(std::string_view text);

}  // namespace twindeck::records
