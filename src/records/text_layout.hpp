#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "records/split_time.hpp"

namespace twindeck::records {

/// How a text file holds its numbers.
struct TextLayout {
  bool utf16 = false;
  bool latin1 = false;   ///< bytes that are no UTF-8: µ, °, ² of an old logger
  char separator = ',';  ///< ' ' for any run of blanks
  bool decimal_comma = false;
  long first_data_line = 1;  ///< from 1
  std::size_t columns = 0;
  std::size_t fewest = 0;              ///< least number of cells in a row; missing cells at the end are empty
  std::vector<std::string> names;      ///< one a column, empty where the file has none
  std::vector<std::string> units;      ///< one a column, empty where it has none
  std::vector<std::string> unaligned;  ///< cells of the line above the numbers, if not one a column
  long unaligned_line = 0;
  int time_column = -1;
  int date_column = -1;                  ///< of the dates, where the stamps of time_column are times of day
  bool stamps = false;                   ///< time stamps, not numbers
  std::optional<TimeParts> time_parts;   ///< columns of the time's parts, beside stamps of its milliseconds
  double time_unit_s = 0.0;              ///< [s] of numbers: 0.001 for milliseconds; 0 where the file does not say
  std::vector<std::size_t> other_times;  ///< further columns of time: no channels
  std::vector<std::string> notes;        ///< on columns whose names say time
  std::optional<double> header_rate_Hz;
  std::string header_rate_text;  ///< the line that says so
  std::optional<long> header_samples;
  long header_samples_line = 0;
};

/// Reads the layout from the beginning of a file: header lines of any number and kind, a line `sep=;`, names and units.
/// Separator and decimal sign are those of the longest run of rows. The data begin at the first run of rows of that width, so
/// that a stray line further down hides neither the header nor the rows above it.
/// @throws InputError  if no two lines of numbers follow one another
[[nodiscard]] TextLayout find_layout(const std::filesystem::path& file);

}  // namespace twindeck::records
