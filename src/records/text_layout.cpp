#include "records/text_layout.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <regex>

#include "core/error.hpp"
#include "records/time_stamp.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLines = 2000;
constexpr std::size_t kBytes = 4000000;

std::string_view trimmed(std::string_view text) {
  const char* blanks = " \t\r\n\"'";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const std::size_t more = c < 0x80 ? 0 : c >> 5 == 6 ? 1 : c >> 4 == 14 ? 2 : c >> 3 == 30 ? 3 : 9;
    if (more == 9 || i + more >= text.size() + (more == 0 ? 1 : 0)) return false;
    for (std::size_t k = 1; k <= more; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
    }
    i += more + 1;
  }
  return true;
}

bool is_date(std::string_view cell) {
  static const std::regex pattern(R"(\d{1,4}[-./]\d{1,2}[-./]\d{1,4})");
  return std::regex_match(cell.begin(), cell.end(), pattern);
}

bool is_value(std::string_view cell, bool decimal_comma) {
  return number_in(cell, decimal_comma).has_value() || is_date(cell) || !time_stamp_meanings(cell).empty();
}

/// All cells are values and one at least is a number.
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

/// The longest run of lines of data with one number of cells.
Run longest_run(const std::vector<std::string>& lines, char separator, bool decimal_comma) {
  Run best, run;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::size_t columns = 0;
    if (trimmed(lines[i]).empty() || !is_data(lines[i], separator, decimal_comma, columns)) {
      run = {};
      continue;
    }
    if (run.length == 0 || columns != run.columns) run = {i, 0, columns};
    ++run.length;
    if (run.length > best.length) best = run;
  }
  return best;
}

bool looks_like_unit(std::string_view cell) {
  static const std::regex pattern(R"(\[.*\]|\(.*\)|[-A-Za-z%/*^.0-9\xC2\xB0\xB2\xB5\xBC\xCE]{0,8})");
  return std::regex_match(cell.begin(), cell.end(), pattern) && std::none_of(cell.begin(), cell.end(), [](char c) { return c == '_'; });
}

bool is_known_unit(std::string_view cell) {
  static const std::array<std::string_view, 22> known = {"s",  "sec", "ms",   "g",   "mg",  "m/s2", "m/s^2", "m/s\xC2\xB2", "m/s/s", "v",  "mv",
                                                         "m/s", "mm/s", "mm", "m", "um", "\xC2\xB5m", "hz", "kn", "n", "gal", "cm/s2"};
  std::string text = lower(trimmed(cell));
  if (text.size() > 2 && (text.front() == '[' || text.front() == '(')) text = text.substr(1, text.size() - 2);
  return std::find(known.begin(), known.end(), text) != known.end();
}

/// "Acc 1 [m/s2]" -> name and unit.
void split_unit(std::string& name, std::string& unit) {
  static const std::regex pattern(R"(^(.*\S)\s*[\[(]([^\])]*)[\])]\s*$)");
  std::smatch match;
  if (unit.empty() && std::regex_match(name, match, pattern)) {
    unit = match[2];
    name = std::string(match[1]);
  }
  if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '(')) unit = unit.substr(1, unit.size() - 2);
}

void read_names(const std::vector<std::string>& lines, std::size_t first, TextLayout& layout) {
  std::vector<std::vector<std::string>> above;  // the nearest first
  for (std::size_t i = first; i-- > 0 && above.size() < 2;) {
    std::string_view line = trimmed(lines[i]);
    while (!line.empty() && (line.front() == '#' || line.front() == '%' || line.front() == '/')) line = trimmed(line.substr(1));
    if (line.empty()) continue;
    const auto cells = cells_of(line, layout.separator);
    if (cells.size() != layout.columns) break;
    above.emplace_back(cells.begin(), cells.end());
  }
  if (above.empty()) return;
  const auto& nearest = above.front();
  const bool units = above.size() > 1 && std::all_of(nearest.begin(), nearest.end(), looks_like_unit) &&
                     std::any_of(nearest.begin(), nearest.end(), is_known_unit);
  layout.names = units ? above[1] : nearest;
  layout.units = units ? nearest : std::vector<std::string>(layout.columns);
  for (std::size_t c = 0; c < layout.columns; ++c) split_unit(layout.names[c], layout.units[c]);
}

void read_header_rate(const std::vector<std::string>& lines, std::size_t first, TextLayout& layout) {
  static const std::regex rate(
      R"((?:sampl\w*[ _-]*(?:rate|freq\w*)?|scan[ _-]*rate|\bfs\b|\bsps\b|abtastrate|frequenza[ _]di[ _]campionamento)\s*[\[(]?(?:hz|khz)?[\])]?\s*[:=;,\t ]\s*"?([0-9]+(?:[.,][0-9]+)?)\s*"?\s*(khz|hz|s/s|sps)?)");
  static const std::regex interval(
      R"((?:sampl\w*[ _-]*(?:interval|period|time)|\bdt\b|delta[ _]?t|time[ _]?step|interval)\s*[\[(]?(?:ms|s|sec)?[\])]?\s*[:=;,\t ]\s*"?([0-9]+(?:[.,][0-9]+)?(?:e-?[0-9]+)?)\s*"?\s*(ms|us|s)?)");
  for (std::size_t i = 0; i < first; ++i) {
    const std::string line = lower(lines[i]);
    std::smatch match;
    const bool is_interval = std::regex_search(line, match, interval);
    if (!is_interval && !std::regex_search(line, match, rate)) continue;
    std::string number = match[1];
    std::replace(number.begin(), number.end(), ',', '.');
    double value = std::strtod(number.c_str(), nullptr);
    if (!(value > 0.0)) continue;
    const std::string unit = match[2];
    if (is_interval) {
      value = 1.0 / (value * (unit == "ms" || line.find("ms)") != std::string::npos || line.find("[ms]") != std::string::npos ? 1e-3 : unit == "us" ? 1e-6 : 1.0));
    } else if (unit == "khz") {
      value *= 1000.0;
    }
    layout.header_rate_Hz = value;
    layout.header_rate_text = std::string(trimmed(lines[i]));
    return;
  }
}

bool is_time_name(const std::string& name) {
  static const std::regex pattern(
      "(.*[^a-z])?(time|timestamp|time[ _]?stamp|zeit|tempo|datum|date|data/ora|t|elapsed|seconds|sec)([ _]?(s|ms))?([^a-z].*)?");
  return std::regex_match(lower(name), pattern);
}

/// Steps of a column of numbers over the run's lines: all positive and alike.
bool runs_evenly(const std::vector<double>& values) {
  if (values.size() < 3) return false;
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
  std::vector<double> sorted = steps;
  std::sort(sorted.begin(), sorted.end());
  const double middle = sorted[sorted.size() / 2];
  if (!(middle > 0.0) || sorted.front() < 0.0) return false;
  const auto alike = std::count_if(steps.begin(), steps.end(), [&](double s) { return std::abs(s - middle) < 0.25 * middle; });
  return static_cast<double>(alike) > 0.9 * static_cast<double>(steps.size());
}

void find_time(const std::vector<std::string>& lines, const Run& run, TextLayout& layout) {
  std::vector<std::vector<std::string_view>> rows;
  for (std::size_t i = run.first; i < run.first + std::min<std::size_t>(run.length, 200); ++i) rows.push_back(cells_of(lines[i], layout.separator));
  for (std::size_t c = 0; c < layout.columns && layout.time_column < 0; ++c) {
    const std::string_view cell = rows.front()[c];
    if (is_date(cell) && !number_in(cell, layout.decimal_comma)) {
      layout.time_column = static_cast<int>(c);
      layout.date_and_time = c + 1 < layout.columns && !time_stamp_meanings(rows.front()[c + 1]).empty();
      layout.stamps = true;
    } else if (!number_in(cell, layout.decimal_comma)) {
      layout.time_column = static_cast<int>(c);
      layout.stamps = true;
    }
  }
  for (std::size_t c = 0; c < layout.columns && layout.time_column < 0; ++c) {
    const bool named = !layout.names.empty() && is_time_name(layout.names[c]);
    if (c > 0 && !named) continue;
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(number_in(row[c], layout.decimal_comma).value_or(std::numeric_limits<double>::quiet_NaN()));
    // A first column that runs evenly is time, unless it has a name that says otherwise or only counts the samples.
    const bool counts = values.size() > 2 && values[1] - values[0] == 1.0 && values[2] - values[1] == 1.0 && !named;
    if (!runs_evenly(values) || counts || (!named && !layout.names.empty())) continue;
    layout.time_column = static_cast<int>(c);
  }
  if (layout.time_column >= 0 && !layout.stamps && !layout.units.empty()) {
    const std::string unit = lower(layout.units[static_cast<std::size_t>(layout.time_column)]);
    layout.time_unit_s = unit == "ms" ? 1e-3 : unit == "us" || unit == "\xC2\xB5s" ? 1e-6 : unit == "min" ? 60.0 : 1.0;
  }
}

}  // namespace

std::string from_latin1(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      result += c;
    } else {
      result += static_cast<char>(0xC0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return result;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  if (separator == ' ') {
    for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
      cells.push_back(trimmed(line.substr(at, end - at)));
      at = line.find_first_not_of(" \t", end);
    }
    return cells;
  }
  for (std::size_t at = 0; at <= line.size();) {
    std::size_t end = line.find(separator, at);
    // A separator between quotes belongs to the cell.
    const std::size_t start = line.find_first_not_of(" \t", at);
    if (start != std::string_view::npos && line[start] == '"' && (end == std::string_view::npos || end > start)) {
      const std::size_t close = line.find('"', start + 1);
      if (close != std::string_view::npos) end = line.find(separator, close);
    }
    if (end == std::string_view::npos) end = line.size();
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

std::optional<double> number_in(std::string_view cell, bool decimal_comma) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return nan;
  char buffer[64];
  if (cell.size() >= sizeof buffer) return {};
  std::size_t n = 0;
  for (const char c : cell) buffer[n++] = decimal_comma && c == ',' ? '.' : c == 'D' || c == 'd' ? 'e' : c;
  const char* begin = buffer[0] == '+' ? buffer + 1 : buffer;
  double value = 0.0;
  const auto [end, error] = std::from_chars(begin, buffer + n, value);
  if (error == std::errc() && end == buffer + n) return std::isfinite(value) ? value : nan;
  static const std::array<std::string_view, 11> missing = {"nan", "null", "na", "n/a", "#n/a", "-", "--", "---", "over", "ovld", "invalid"};
  const std::string text = lower(cell);
  if (std::find(missing.begin(), missing.end(), text) != missing.end()) return nan;
  return {};
}

TextLayout find_layout(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::string> lines;
  std::size_t bytes = 0;
  TextLayout layout;
  for (std::string line; lines.size() < kLines && bytes < kBytes && std::getline(in, line);) {
    bytes += line.size();
    if (lines.empty()) {
      if (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF")) {
        throw InputError({file.string(), 1, ""}, "is UTF-16, expected UTF-8 or latin-1", "save it as UTF-8 (iconv -f UTF-16 -t UTF-8)");
      }
      if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    }
    if (line.size() > 1000000) throw InputError({file.string(), static_cast<long>(lines.size() + 1), ""}, "has a line of over a million characters", "check the file: it may be binary");
    if (line.find('\0') != std::string::npos) throw InputError({file.string(), static_cast<long>(lines.size() + 1), ""}, "is neither text nor a known binary format", "known are CSV, NPY, MAT 5 and 7.3, HDF5, universal files");
    if (!is_utf8(line)) {
      layout.latin1 = true;
      line = from_latin1(line);
    }
    lines.push_back(line);
  }
  char fixed = '\0';
  if (!lines.empty()) {
    const std::string first = lower(trimmed(lines.front()));
    if (first.starts_with("sep=") && first.size() >= 5) fixed = first[4];
    if (first == "sep=") fixed = '\t';
  }
  Run best;
  for (const char separator : {';', '\t', ',', '|', ' '}) {
    if (fixed != '\0' && separator != fixed) continue;
    for (const bool comma : {false, true}) {
      if (comma && separator == ',') continue;
      const Run run = longest_run(lines, separator, comma);
      if (run.length > best.length || (run.length == best.length && run.columns > best.columns)) {
        best = run;
        layout.separator = separator;
        layout.decimal_comma = comma;
      }
    }
  }
  if (best.length < 2) {
    throw InputError({file.string(), 0, ""}, "has no two lines of numbers that follow one another",
                     "a record is a table of numbers, one line a sample, after any header; known are also NPY, MAT, HDF5, universal files");
  }
  layout.first_data_line = static_cast<long>(best.first) + 1;
  layout.columns = best.columns;
  read_names(lines, best.first, layout);
  read_header_rate(lines, best.first, layout);
  find_time(lines, best, layout);
  return layout;
}

}  // namespace twindeck::records
