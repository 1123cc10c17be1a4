#include "records/text_cells.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/printable.hpp"

namespace twindeck::records {

std::string_view trimmed(std::string_view text) {
  const char* blanks = " \t\r\n\"'";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = utf8_letter(text, at);
    if (bytes == 0) return false;
    at += bytes;
  }
  return true;
}

std::string from_latin1(std::string_view text) {
  std::string result;
  for (const char c : text) append_utf8(static_cast<unsigned char>(c), result);
  return result;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n')) line.remove_suffix(1);
  if (separator == ' ') {
    for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos;) {
      const std::size_t close = line[at] == '"' ? line.find('"', at + 1) : std::string_view::npos;
      const std::size_t end = std::min(line.find_first_of(" \t", close == std::string_view::npos ? at : close), line.size());
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
  return cells;
}

std::optional<double> number_in(std::string_view cell, bool decimal_comma) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return nan;
  std::array<char, 64> buffer{};
  if (cell.size() >= buffer.size()) return {};
  std::size_t n = 0;
  for (const char c : cell) buffer[n++] = decimal_comma && c == ',' ? '.' : c == 'D' || c == 'd' ? 'e' : c;
  const char *begin = buffer.data() + (buffer[0] == '+' ? 1 : 0), *stop = buffer.data() + n;
  double value = 0.0;
  const auto [end, error] = std::from_chars(begin, stop, value);
  if (error == std::errc() && end == stop) return std::isfinite(value) ? value : nan;
  static const std::array<std::string_view, 29> missing = {
      "null", "na",      "n/a",   "n.a.",       "#n/a",      "none",     "missing",    "no data", "nodata",  "over",
      "ovld", "ovl",     "ol",    "over range", "overrange", "overload", "underrange", "under",   "invalid", "bad",
      "open", "#value!", "#num!", "#div/0!",    "#ref!",     "1.#inf",   "1.#qnan",    "1.#ind",  "1.#snan"};
  std::string text = lower(cell);
  if (text.find_first_not_of("-*?.") == std::string::npos) return nan;  // "---", "****"
  text.erase(0, text.front() == '-' || text.front() == '+' ? 1 : 0);
  if (text.starts_with("nan") || std::find(missing.begin(), missing.end(), text) != missing.end()) return nan;
  return {};
}

bool is_date(std::string_view cell) {
  constexpr std::array<std::size_t, 3> most_digits = {4, 2, 4};
  std::size_t at = 0;
  for (std::size_t part = 0; part < most_digits.size(); ++part) {
    if (part > 0) {
      if (at >= cell.size() || (cell[at] != '-' && cell[at] != '.' && cell[at] != '/')) return false;
      ++at;
    }
    std::size_t digits = 0;
    while (at < cell.size() && cell[at] >= '0' && cell[at] <= '9') {
      ++at;
      ++digits;
    }
    if (digits == 0 || digits > most_digits[part]) return false;
  }
  return at == cell.size();
}

}  // namespace twindeck::records
