#include "records/text_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "core/lists.hpp"
#include "io/text_lines.hpp"
#include "records/header_rate.hpp"
#include "records/record_clock.hpp"
#include "records/take_clock.hpp"
#include "records/text_cells.hpp"
#include "records/thousands.hpp"
#include "records/time_stamp.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;

namespace {

// Part of a file that is examined for its layout: lines, bytes.
constexpr std::size_t kLines = 2000;
constexpr std::size_t kBytes = 4000000;

bool is_value(std::string_view cell, bool decimal_comma) {
  return number_in(cell, decimal_comma).has_value() || is_date(cell) || !time_stamp_meanings(cell).empty();
}

/// Whether all cells are values and at least one is a number.
bool is_data(std::string_view line, char separator, bool decimal_comma, std::size_t& count) {
  const auto cells = cells_of(line, separator);
  count = cells.size();
  bool any = false;
  for (const std::string_view cell : cells) {
    if (!is_value(cell, decimal_comma)) return false;
    const auto number = number_in(cell, decimal_comma);
    any = any || (number && std::isfinite(*number));
  }
  return any;
}

struct Run {
  std::size_t first = 0, length = 0, columns = 0;
};

/// Whether all cells are empty or words for a missing value. Such a line neither ends nor begins a run.
bool holds_no_value(std::string_view line, char separator, bool decimal_comma) {
  const auto cells = cells_of(line, separator);
  return std::ranges::all_of(cells, [&](std::string_view cell) {
    const auto number = number_in(cell, decimal_comma);
    return number && !std::isfinite(*number);
  });
}

/// The runs of rows with one number of cells, in the order of the file.
std::vector<Run> runs_of(const std::vector<std::string>& lines, char separator, bool decimal_comma) {
  std::vector<Run> runs;
  bool going_on = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::size_t columns = 0;
    if (holds_no_value(lines[i], separator, decimal_comma)) continue;
    if (!is_data(lines[i], separator, decimal_comma, columns)) {
      going_on = false;
      continue;
    }
    if (!going_on || columns != runs.back().columns) runs.push_back({i, 0, columns});
    going_on = true;
    ++runs.back().length;
  }
  return runs;
}

Run longest_of(const std::vector<Run>& runs) {
  Run best;
  for (const Run& run : runs)
    if (run.length > best.length) best = run;
  return best;
}

/// A line of a header as cells, the sign of a comment at its beginning taken off. None for a line of separators or a ruler
/// ("----").
std::vector<std::string_view> header_cells(std::string_view text, char separator) {
  std::string_view line = trimmed(text);
  while (!line.empty() && (line.front() == '#' || line.front() == '%' || line.front() == '/')) line = trimmed(line.substr(1));
  if (line.find_first_not_of("-=_+*:;,| \t\"") == std::string_view::npos) return {};
  auto cells = cells_of(line, separator);
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

/// LabVIEW's last column name is "Comment"; rows have such a cell only if there is a comment.
bool is_comment(std::string_view name) { return lower_case(trimmed(name)) == "comment"; }

/// Number of columns that the line above a run names, without comments. 0 unless no cell is a value and one holds letters.
std::size_t names_above(const std::vector<std::string>& lines, const Run& run, const TextLayout& layout) {
  for (std::size_t i = run.first; i-- > 0;) {
    const auto cells = header_cells(lines[i], layout.separator);
    if (cells.empty()) continue;
    const auto is_text = [&](std::string_view cell) { return cell.empty() || !is_value(cell, layout.decimal_comma); };
    const bool any = std::ranges::any_of(cells, [](std::string_view cell) { return !cell.empty(); });
    return any && std::ranges::all_of(cells, is_text) ? cells.size() - (is_comment(cells.back()) ? 1 : 0) : 0;
  }
  return 0;
}

/// Rows of numbers within a header (serial numbers, calibration factors) are fewer than this.
constexpr std::size_t kLeastRun = 3;

bool fits(const Run& run, const TextLayout& layout) { return run.columns >= layout.fewest && run.columns <= layout.columns; }

/// Whether a line of the file has so many cells, all of them values.
bool has_row_of(const fs::path& file, std::size_t columns, const TextLayout& layout) {
  io::TextLines in(file);
  std::size_t found = 0;
  for (std::string line; in.next(line);)
    if (is_data(line, layout.separator, layout.decimal_comma, found) && found == columns) return true;
  return false;
}

/// Least number of cells in a row of a table whose columns have names: cells at its end may be missing where others are empty,
/// or where several rows lack them.
std::size_t fewest_cells(const std::vector<std::string>& lines, const std::vector<Run>& runs, const TextLayout& layout) {
  std::vector<std::size_t> rows(layout.columns + 1, 0);
  std::size_t fewest = layout.fewest;
  for (const Run& run : runs) {
    if (run.columns < layout.columns && run.columns > 0) rows[run.columns] += run.length;
    for (std::size_t i = run.first; i < run.first + run.length && run.columns == layout.columns && i < lines.size(); ++i) {
      auto cells = cells_of(lines[i], layout.separator);
      if (holds_no_value(lines[i], layout.separator, layout.decimal_comma)) continue;
      while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
      fewest = std::min(fewest, cells.size());
    }
  }
  const auto several = std::ranges::find_if(rows, [](std::size_t count) { return count >= kLeastRun; });
  return std::min(fewest, static_cast<std::size_t>(several - rows.begin()));
}

/// Finds the columns of the table. Cells that a separator at the end opens in all rows, without a name, do not count. If there
/// are more names than cells in most rows, and some row has as many cells, the missing cells at the end are empty.
void find_width(const std::vector<std::string>& lines, const std::vector<Run>& runs, const fs::path& file, TextLayout& layout) {
  const Run longest = longest_of(runs);
  const std::size_t named = names_above(lines, runs.front(), layout);
  layout.fewest = layout.columns = longest.columns;
  const auto is_empty = [&](const Run& run) {
    for (std::size_t i = run.first, found = 0; found < run.length; ++i) {
      const auto cells = cells_of(lines[i], layout.separator);
      if (holds_no_value(lines[i], layout.separator, layout.decimal_comma)) continue;
      ++found;
      if (cells.size() >= layout.columns && !cells[layout.columns - 1].empty()) return false;
    }
    return true;
  };
  while (layout.columns > 1 && named != layout.columns && layout.separator != ' ' &&
         std::ranges::all_of(runs, [&](const Run& r) { return r.columns != longest.columns || is_empty(r); }))
    layout.fewest = --layout.columns;
  const auto full = [&](const Run& run) { return run.columns == named; };
  if (named > longest.columns && (std::ranges::any_of(runs, full) || has_row_of(file, named, layout))) layout.columns = named;
  if (named == layout.columns) layout.fewest = fewest_cells(lines, runs, layout);
}

/// The run at which the data begin: the first one as wide as the table that does not belong to the header.
Run first_of_data(const std::vector<std::string>& lines, const std::vector<Run>& runs, const TextLayout& layout) {
  const Run longest = longest_of(runs);
  for (const Run& run : runs) {
    if (run.columns != longest.columns && !fits(run, layout)) continue;
    if (run.first == longest.first || run.length >= kLeastRun || names_above(lines, run, layout) == layout.columns) return run;
  }
  return longest;
}

/// Whether the first column counts the rows, as those that R and pandas write without a name.
bool counts_rows(const std::vector<std::string>& lines, std::size_t first, const TextLayout& layout) {
  constexpr std::size_t looked_at = 3;
  std::vector<double> count;
  for (std::size_t i = first; i < std::min(lines.size(), first + looked_at); ++i)
    count.push_back(number_in(cells_of(lines[i], layout.separator).front(), false).value_or(-1.0));
  return count.size() == looked_at && (count[0] == 0.0 || count[0] == 1.0) && count[1] == count[0] + 1.0 &&
         count[2] == count[1] + 1.0;
}

/// Reads the names from the nearest line above the numbers, or from the next one if that holds units. Some loggers write a
/// further line between (a kind of sample, an amplifier). It repeats words, whereas names are different.
void read_names(const std::vector<std::string>& lines, std::size_t first, TextLayout& layout) {
  std::vector<std::vector<std::string>> above;  // the nearest first
  for (std::size_t i = first; i-- > 0 && above.size() < 3;) {
    auto cells = header_cells(lines[i], layout.separator);
    if (cells.empty()) continue;
    // A line of names or units may end in separators as the rows do.
    if (cells.size() < layout.columns && cells_of(lines[i], layout.separator).size() >= layout.columns)
      cells.resize(layout.columns);
    if (cells.size() == layout.columns + 1 && is_comment(cells.back())) cells.pop_back();
    if (above.empty() && cells.size() + 1 == layout.columns && counts_rows(lines, first, layout))
      cells.insert(cells.begin(), "");
    if (cells.size() != layout.columns) {
      if (above.empty() && cells.size() > 1) {
        layout.unaligned.assign(cells.begin(), cells.end());
        layout.unaligned_line = static_cast<long>(i) + 1;
        for (std::string& name : layout.unaligned) {
          std::string unit;
          split_unit(name, unit);
        }
      }
      break;
    }
    above.emplace_back(cells.begin(), cells.end());
  }
  if (above.empty()) return;
  const auto are_units = [&](std::size_t k) {
    return k + 1 < above.size() && std::ranges::all_of(above[k], looks_like_unit) &&
           std::ranges::any_of(above[k], is_known_unit);
  };
  const std::set<std::string> different(above.front().begin(), above.front().end());
  const bool repeats = different.size() < above.front().size();
  const std::size_t at = !are_units(0) && repeats && are_units(1) ? 1 : 0;
  const bool units = are_units(at);
  layout.names = units ? above[at + 1] : above.front();
  layout.units = units ? above[at] : std::vector<std::string>(layout.columns);
  for (std::size_t c = 0; c < layout.columns; ++c) split_unit(layout.names[c], layout.units[c]);
}

/// Units that LabVIEW writes above the names, a line "Y_Unit_Label" with a cell for each column behind the first.
void read_unit_labels(const std::vector<std::string>& lines, std::size_t first, TextLayout& layout) {
  for (std::size_t i = 0; i < first && !layout.units.empty(); ++i) {
    const auto cells = header_cells(lines[i], layout.separator);
    if (cells.empty() || cells.front() != "Y_Unit_Label") continue;
    for (std::size_t c = 1; c < std::min(cells.size(), layout.columns); ++c)
      if (layout.units[c].empty()) layout.units[c] = std::string(cells[c]);
  }
}

/// Rate and number of samples that a line of the header states.
void read_header_numbers(const std::vector<std::string>& lines, std::size_t first, TextLayout& layout) {
  for (std::size_t i = 0; i < first && !layout.header_rate_Hz; ++i) {
    layout.header_rate_Hz = rate_in_header_line(lines[i]);
    if (layout.header_rate_Hz) layout.header_rate_text = std::string(trimmed(lines[i]));
  }
  for (std::size_t i = 0; i < first && !layout.header_samples; ++i) {
    layout.header_samples = samples_in_header_line(lines[i]);
    layout.header_samples_line = static_cast<long>(i) + 1;
  }
}

/// [s] that the header gives a column of time, in its unit or at the end of its name ("time_ms"); 0 where it gives none.
double header_time_unit_s(const TextLayout& layout, std::size_t column) {
  if (layout.names.empty()) return 0.0;
  const double unit = time_unit_s(layout.units[column]);
  return unit > 0.0 ? unit : without_time_unit(layout.names[column]).second;
}

/// Rows of the table at the beginning of a file, as cells.
std::vector<std::vector<std::string_view>> first_rows(const std::vector<std::string>& lines, std::size_t first,
                                                      const TextLayout& layout) {
  std::vector<std::vector<std::string_view>> rows;
  for (std::size_t i = first; i < lines.size(); ++i) {
    std::size_t columns = 0;
    if (!is_data(lines[i], layout.separator, layout.decimal_comma, columns)) continue;
    auto cells = cells_of(lines[i], layout.separator);
    while (cells.size() > layout.columns && cells.back().empty()) cells.pop_back();
    if (cells.size() < layout.fewest || cells.size() > layout.columns) continue;
    cells.resize(layout.columns);
    rows.push_back(std::move(cells));
  }
  return rows;
}

/// Drops the time stamps found so far, because another column gives the clock of the record.
void leave_stamps(TextLayout& layout) {
  if (layout.time_column >= 0) layout.other_times.push_back(static_cast<std::size_t>(layout.time_column));
  layout.stamps = false;
  layout.time_parts.reset();
}

/// Finds columns of numbers that are time. A column named as time must rise, or lie along a line. In a file without names it
/// must run like time. If no name says time, it must be even to a sample (LabVIEW calls it X_Value), or to a packet in the
/// first column or with a unit of time. The finest column is the clock of the record.
/// @param finest  number of different stamps in the column found so far
void find_numbers_of_time(const std::vector<std::vector<std::string_view>>& rows, std::size_t finest, TextLayout& layout) {
  using Straight = StampedRows::Straight;
  constexpr double other = 0.01;  // [-] relative difference of rates above which two clocks differ
  const bool names = !layout.names.empty();
  double clock_Hz = 0.0;
  const auto examine = [&](std::size_t c, bool named) {
    const double unit = header_time_unit_s(layout, c);
    const bool other_unit = unit == 0.0 && names && (named ? !layout.units[c].empty() : is_known_unit(layout.units[c]));
    StampedRows stamps;
    for (const auto& row : rows)
      stamps.add(number_in(row[c], layout.decimal_comma).value_or(std::numeric_limits<double>::quiet_NaN()));
    const bool letter = named && unit == 0.0 && trimmed(layout.names[c]).size() == 1;  // T may be a temperature
    const bool degrees = letter && other_unit, rounded = stamps.distinct() < rows.size();
    const bool packets = unit > 0.0 || (c == 0 && names && layout.units[c].empty());
    const bool time =
        named && !letter && !other_unit
            ? stamps.mostly_rises() || stamps.clock(1.0).reversed || stamps.runs_like_time(Straight::named)
            : (degrees ? !rounded : named || !other_unit) && stamps.runs_like_time(degrees           ? Straight::to_a_sample
                                                                                   : !names || named ? Straight::roughly
                                                                                   : packets         ? Straight::to_a_stamp
                                                                                                     : Straight::to_a_sample);
    if (!time) {
      if (named && !degrees)
        layout.notes.push_back("column '" + layout.names[c] + "' does not run like time and is read as a channel");
      return;
    }
    const double rate_Hz = stamps.distinct() == rows.size() ? stamps.clock(unit).rate_Hz : 0.0;
    if (clock_Hz > 0.0 && rate_Hz > 0.0 && std::abs(rate_Hz / clock_Hz - 1.0) > other)
      layout.notes.push_back(
          fmt::format("column {} runs at {:.6g} Hz, another of time at {:.6g} Hz: write the channels of each "
                      "clock into a file of their own",
                      c + 1, rate_Hz, clock_Hz));
    if (layout.time_column >= 0 && stamps.distinct() <= finest) return layout.other_times.push_back(c);
    clock_Hz = rate_Hz;
    leave_stamps(layout);
    layout.time_column = static_cast<int>(c);
    layout.time_unit_s = unit;
    finest = stamps.distinct();
  };
  for (const bool named : {true, false}) {
    if (!named && names && layout.time_column >= 0) return;
    for (std::size_t c = 0; c < layout.columns; ++c) {
      const bool taken = contains(layout.other_times, c) || static_cast<int>(c) == layout.time_column;
      if (taken || (names && is_time_name(layout.names[c])) != named) continue;
      if (number_in(rows.front()[c], layout.decimal_comma)) examine(c, named);
    }
  }
}

/// Finds a column of dates with a column of times of day. Pairs such as "20240517" and "100000.25" look like numbers and must
/// be neighbours.
void find_date_and_time(const std::vector<std::vector<std::string_view>>& rows, TextLayout& layout) {
  const auto is_number = [&](std::size_t c) { return number_in(rows.front()[c], layout.decimal_comma).has_value(); };
  const auto belong = [&](std::size_t date, std::size_t time) {  // whether nine rows of ten give a time stamp
    return 10 * std::ranges::count_if(
                    rows,
                    [&](const std::vector<std::string_view>& row) {
                      return time_stamp_meanings(std::string(row[date]) + " " + std::string(row[time])).empty();
                    }) <=
           std::ssize(rows);
  };
  for (std::size_t date = 0; date < layout.columns; ++date) {
    if (!is_date(rows.front()[date])) continue;
    for (std::size_t k = 1; k < layout.columns && layout.time_column < 0; ++k) {
      const std::size_t time = (date + k) % layout.columns;  // the next column first
      if ((k > 1 && is_number(time)) || !belong(date, time)) continue;
      layout.time_column = static_cast<int>(time);
      layout.date_column = static_cast<int>(date);
    }
    if (layout.date_column >= 0 || !is_number(date)) layout.other_times.push_back(date);
    if (layout.date_column >= 0) return;
  }
}

void find_time(const std::vector<std::vector<std::string_view>>& rows, TextLayout& layout) {
  if (rows.empty()) return;
  find_date_and_time(rows, layout);
  for (std::size_t c = 0; c < layout.columns; ++c) {
    if (contains(layout.other_times, c) || number_in(rows.front()[c], layout.decimal_comma)) continue;
    if (layout.time_column < 0) layout.time_column = static_cast<int>(c);
    if (static_cast<int>(c) != layout.time_column) layout.other_times.push_back(c);
  }
  layout.stamps = layout.time_column >= 0;
  const auto last = static_cast<std::size_t>(std::max(layout.time_column, 0));
  const std::string_view stamp = rows.front()[last];
  if (!layout.stamps || stamp.find_first_of(".,", stamp.rfind(':')) == std::string_view::npos)  // no fraction
    layout.time_parts = find_time_parts(rows, layout.names, layout.decimal_comma, layout.stamps);
  if (layout.time_parts) {
    for (const int part : *layout.time_parts)
      if (part >= 0) layout.other_times.push_back(static_cast<std::size_t>(part));
    if (!layout.stamps) layout.time_column = (*layout.time_parts)[kSecond];
  }
  std::size_t distinct = 1;
  for (std::size_t r = 1; r < rows.size() && layout.time_column >= 0; ++r)
    distinct += layout.time_parts || rows[r][last] != rows[r - 1][last] ? 1 : 0;
  find_numbers_of_time(rows, distinct, layout);
}

/// Notes rows of several sensors in turn ("time, id, ax, ay" with id 1, 2, 3, 1, 2, 3 …): a column that is named after sensors
/// repeats a few different cells throughout, and as many rows share each stamp. Numbers of samples within a packet do so too.
void note_rows_in_turn(const std::vector<std::vector<std::string_view>>& rows, TextLayout& layout) {
  constexpr std::size_t turns = 8;  // least number of them
  for (std::size_t c = 0; c < layout.names.size(); ++c) {
    if (!is_one_of("|id|sensor|sensor_id|sensor id|sensorid|node|node_id|channel|channel_id|device|device_id|",
                   lower_case(layout.names[c])))
      continue;
    std::size_t each = 1;
    while (each * turns < rows.size() && rows[each][c] != rows[0][c]) ++each;
    bool in_turn = each > 1 && each * turns < rows.size();
    for (std::size_t r = 0; r < rows.size() && in_turn; ++r) {
      const std::size_t first = r - r % each;
      const auto time = static_cast<std::size_t>(std::max(layout.time_column, 0));
      in_turn = rows[r][c] == rows[r % each][c] && (layout.time_column < 0 || rows[r][time] == rows[first][time]);
    }
    if (in_turn)
      layout.notes.push_back(fmt::format("the rows are of {} sensors in turn, by column '{}': write their values side by side",
                                         each, layout.names[c]));
  }
}

/// Whether a line is a row of the table with its last cells missing, or with words for missing values only.
bool is_incomplete_row(const std::string& line, const TextLayout& layout) {
  std::size_t columns = 0;
  if (line.find_first_not_of(" \t\r;,|\"-=_+*:") == std::string::npos) return false;  // empty, or a ruler
  if (is_data(line, layout.separator, layout.decimal_comma, columns))
    return columns >= layout.fewest && columns <= layout.columns && layout.fewest < layout.columns;
  return cells_of(line, layout.separator).size() == layout.columns &&
         holds_no_value(line, layout.separator, layout.decimal_comma);
}

std::vector<std::string> first_lines(const fs::path& file, TextLayout& layout) {
  io::TextLines in(file);
  std::vector<std::string> lines;
  std::size_t bytes = 0;
  layout.utf16 = in.is_utf16();
  for (std::string line; lines.size() < kLines && bytes < kBytes && in.next(line);) {
    const long number = in.number();
    bytes += line.size();
    if (line.size() > 1000000)
      throw InputError({file.string(), number, ""}, "has a line of over a million characters",
                       "check the file: it may be binary");
    if (line.find('\0') != std::string::npos)
      throw InputError({file.string(), number, ""}, "is neither text nor a known binary format",
                       "known are CSV, NPY, MAT 4, 5 and 7.3, HDF5, universal files");
    if (!is_utf8(line)) {
      layout.latin1 = true;
      line = from_latin1(line);
    }
    lines.push_back(line);
  }
  return lines;
}

/// Refuses a file without a table and names the first text in its middle line.
[[noreturn]] void refuse_text(const std::vector<std::string>& lines, const fs::path& file) {
  std::string reason;
  std::size_t most = 0;
  for (const char separator : {';', '\t', ',', '|', ' '}) {
    const auto cells = lines.empty() ? std::vector<std::string_view>() : cells_of(lines[lines.size() / 2], separator);
    const auto at = std::ranges::find_if(cells, [](std::string_view cell) { return !is_value(cell, false); });
    if (cells.size() <= most || at == cells.end()) continue;
    most = cells.size();
    reason = fmt::format("; line {} has '{}' in column {}, which is no number and no known time stamp", lines.size() / 2 + 1,
                         at->substr(0, 40), at - cells.begin() + 1);
  }
  throw InputError({file.string(), 0, ""}, "has no two lines of numbers that follow one another" + reason,
                   "a record is a table of numbers, one line a sample, after any header: write other columns out of it; known "
                   "are also NPY, MAT, HDF5, universal files");
}

}  // namespace

TextLayout find_layout(const fs::path& file) {
  TextLayout layout;
  const std::vector<std::string> lines = first_lines(file, layout);
  char fixed = '\0';
  if (!lines.empty()) {
    const std::string first = lower_case(trimmed(lines.front()));
    if (first.starts_with("sep=") && first.size() >= 5) fixed = first[4];
    if (first == "sep=") fixed = '\t';
  }
  std::vector<Run> runs;
  Run longest;
  for (const char separator : {';', '\t', ',', '|', ' '}) {
    if (fixed != '\0' && separator != fixed) continue;
    for (const bool comma : {false, true}) {
      std::vector<Run> found = runs_of(lines, separator, comma);
      const Run run = longest_of(found);
      if (run.length > longest.length || (run.length == longest.length && run.columns > longest.columns)) {
        longest = run;
        runs = std::move(found);
        layout.separator = separator;
        layout.decimal_comma = comma;
      }
    }
  }
  if (longest.length < 2) refuse_text(lines, file);
  find_width(lines, runs, file, layout);
  std::size_t first = first_of_data(lines, runs, layout).first;
  while (first > 0 && is_incomplete_row(lines[first - 1], layout)) --first;
  layout.first_data_line = static_cast<long>(first) + 1;
  read_names(lines, first, layout);
  read_unit_labels(lines, first, layout);
  read_header_numbers(lines, first, layout);
  const auto rows = first_rows(lines, first, layout);
  refuse_thousands(rows, layout, file);
  find_time(rows, layout);
  note_rows_in_turn(rows, layout);
  return layout;
}

}  // namespace twindeck::records
