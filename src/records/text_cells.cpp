#include "records/text_cells.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/letters.hpp"
#include "core/printable.hpp"

namespace twindeck::records {

std::string_view trimmed(std::string_view text) { return without_blanks(text, " \t\r\n\"'"); }

bool is_one_of(std::string_view words, const std::string& word) {
  return !word.empty() && word.find('|') == std::string::npos && words.find('|' + word + '|') != std::string_view::npos;
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

namespace {

/// "1,234.5" -> "1234.5": removes the separators between groups of three digits, if a decimal sign follows or if there are two
/// separators. A single one ("1,234") may be a decimal sign and stays.
std::optional<std::string> without_groups(std::string_view cell, char decimal) {
  const std::size_t end = std::min(cell.find(decimal), cell.size()), first = cell.find_first_of("0123456789");
  if (first > 1 || first >= end) return {};
  std::string joined(cell.substr(0, first));
  std::string_view sign;
  int groups = 0;
  for (std::size_t at = first; at < end; ++groups) {
    const std::size_t stop = std::min(cell.find_first_not_of("0123456789", at), end);
    if (groups == 0 ? stop - at > 3 : stop - at != 3) return {};
    joined += cell.substr(at, stop - at);
    at = std::min(cell.find_first_of("0123456789", stop), end);
    if (at < end && sign.empty()) sign = cell.substr(stop, at - stop);
    if (at < end ? cell.substr(stop, at - stop) != sign : stop < end) return {};
  }
  const bool ambiguous = (sign == "," || sign == ".") && end == cell.size() && groups == 2;
  if (ambiguous || !is_one_of("|,|.|'| |\xC2\xA0|\xE2\x80\xAF|\xE2\x80\x99|", std::string(sign))) return {};
  return joined += cell.substr(end);
}

}  // namespace

std::optional<double> number_in(std::string_view cell, bool decimal_comma) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr std::string_view typeset = "\xE2\x88\x92";  // the minus of a text processor
  if (const std::size_t minus = cell.find(typeset); minus != std::string_view::npos)
    return number_in(std::string(cell).replace(minus, typeset.size(), "-"), decimal_comma);
  if (cell.empty()) return nan;
  std::array<char, 64> buffer{};
  if (cell.size() >= buffer.size()) return {};
  std::size_t n = 0;
  for (const char c : cell) buffer[n++] = decimal_comma && c == ',' ? '.' : c == 'D' || c == 'd' ? 'e' : c;
  const char *begin = buffer.data() + (buffer[0] == '+' ? 1 : 0), *stop = buffer.data() + n;
  double value = 0.0;
  const auto [end, error] = std::from_chars(begin, stop, value);
  constexpr double least = 9e36, most = 3.5e38;  // missing values: 9.9E37, 9.91E37 (SCPI), 1e38
  const bool none = std::abs(value) > least && std::abs(value) < most;
  if (error == std::errc() && end == stop) return std::isfinite(value) && !none ? value : nan;
  if (const auto joined = without_groups(cell, decimal_comma ? ',' : '.')) return number_in(*joined, decimal_comma);
  constexpr std::string_view missing =
      "|null|na|nd|nb|nv|ka|none|missing|lost|void|empty|undefined|ndef|nodata|novalue|nosignal|noinput|notavailable|"
      "keinedaten|keinwert|over|ovld|ovl|ol|overflow|overload|overrange|outofrange|offscale|sat|saturated|clip|clipped|under|"
      "underflow|underrange|invalid|bad|badvalue|open|opencircuit|burnout|fault|sensorfault|fail|failed|timeout|";
  std::string text = lower_case(cell);
  if (text.find_first_not_of("-+*?.") == std::string::npos) return nan;  // "---", "****"
  text.erase(0, text.front() == '-' || text.front() == '+' ? 1 : 0);
  const bool of_sheet = text.starts_with('#') || text.starts_with("1.#");  // "#N/A", "#WERT!", "1.#QNAN"
  if ((of_sheet && text.find_first_of("23456789") == std::string::npos) || text.starts_with("nan")) return nan;
  std::erase_if(text, [](char c) { return std::string_view(" ./_-<>").find(c) != std::string_view::npos; });
  if (is_one_of(missing, text)) return nan;
  return {};
}

bool looks_like_unit(std::string_view cell) {
  if (cell.find('_') != std::string_view::npos) return false;
  if (cell.size() > 1 && ((cell.front() == '[' && cell.back() == ']') || (cell.front() == '(' && cell.back() == ')')))
    return true;
  constexpr std::size_t longest = 12;  // bytes of a unit without brackets
  const auto of_unit = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("-%/*^.\xC2\xB0\xB2\xB5\xBC\xCE").find(c) != std::string_view::npos;
  };
  return cell.size() <= longest && std::ranges::all_of(cell, of_unit);
}

bool is_known_unit(std::string_view cell) {
  std::string text = lower_case(trimmed(cell));
  if (text.size() > 2 && (text.front() == '[' || text.front() == '(')) text = text.substr(1, text.size() - 2);
  return is_one_of("|s|sec|ms|g|mg|m/s2|m/s^2|m/s\xC2\xB2|m/s/s|v|mv|m/s|mm/s|mm|m|um|\xC2\xB5m|hz|kn|n|gal|cm/s2|", text);
}

void split_unit(std::string& name, std::string& unit) {
  const std::string_view text = trimmed(name);
  if (unit.empty() && !text.empty() && (text.back() == ']' || text.back() == ')')) {
    const std::size_t open = text.find_last_of("[(");
    const std::string_view before = trimmed(text.substr(0, std::min(open, text.size())));
    const std::string_view within = open == std::string_view::npos ? "" : text.substr(open + 1, text.size() - open - 2);
    if (open != std::string_view::npos && !before.empty() && within.find_first_of("])") == std::string_view::npos) {
      unit = std::string(within);
      name = std::string(before);
    }
  }
  if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '(')) unit = unit.substr(1, unit.size() - 2);
}

}  // namespace twindeck::records
