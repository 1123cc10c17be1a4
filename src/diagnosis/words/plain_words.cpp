#include "diagnosis/words/plain_words.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <set>
#include <utility>

namespace twindeck::diagnosis {

namespace {

constexpr double kPlainBelow = 1e6;   ///< numbers from here on are given in millions
constexpr double kPlainAbove = 1e-4;  ///< smaller numbers are given with powers of ten

/// The digits of a number of at least one thousand, in groups of three.
std::string in_threes(long number) {
  std::string digits = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

/// A number with some significant digits, without exponent and without zeros at the end.
std::string plain(double size, int digits) {
  const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
  const double step = std::pow(10.0, before - digits), rounded = std::round(size / step) * step;
  if (rounded >= 1000.0) return in_threes(std::lround(rounded));
  return with_decimals(rounded, std::max(0, digits - before));
}

bool part_of_a_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '+' || c == '-'; }

}  // namespace

std::string with_decimals(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string number_in_words(double value, int digits) {
  if (!std::isfinite(value)) return "unknown";
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  const std::string sign = value < 0.0 ? "-" : "";
  if (size < kPlainAbove) return fmt::format("{}{:.{}g}", sign, size, digits);
  if (size < kPlainBelow) return sign + plain(size, digits);
  return size < 1000.0 * kPlainBelow ? sign + plain(size / 1e6, digits) + " million"
                                     : fmt::format("{}{:.{}g}", sign, size, digits);
}

std::string quantity_in_words(double value, const std::string& unit) {
  static const std::set<std::string> takes_prefix = {"Pa", "N", "N/m", "N m/rad", "N s/m"};
  if (unit.empty() || unit == "-") return number_in_words(value);
  if (takes_prefix.contains(unit))
    for (const auto& [size, prefix] : {std::pair{1e9, "G"}, std::pair{1e6, "M"}, std::pair{1e3, "k"}})
      if (std::abs(value) >= size) return fmt::format("{} {}{}", number_in_words(value / size), prefix, unit);
  return number_in_words(value) + " " + unit;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) out += i + 1 == names.size() ? " and " : ", ";
    out += names[i];
  }
  return out;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string ended(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

void IdsInWords::add_location(const std::string& location, const std::string& words) {
  if (location.find(':') != std::string::npos) words_[location] = words;
}

void IdsInWords::add_cause(const std::string& id, const std::string& title, const std::string& place_words) {
  std::string small = title;
  if (small.size() > 1 && std::islower(static_cast<unsigned char>(small[1])) != 0)
    small[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(small[0])));
  words_[id] = place_words.empty() ? small : fmt::format("{} at {}", small, place_words);
}

std::string IdsInWords::in_text(const std::string& text) const {
  std::string out;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::string* id = nullptr;
    const std::string* words = nullptr;
    if (at == 0 || !part_of_a_name(text[at - 1])) {
      for (const auto& [key, value] : words_) {
        const bool whole = text.compare(at, key.size(), key) == 0 &&
                           (at + key.size() == text.size() || !part_of_a_name(text[at + key.size()]));
        if (whole && (id == nullptr || key.size() > id->size())) {
          id = &key;
          words = &value;
        }
      }
    }
    if (id == nullptr) {
      out += text[at++];
      continue;
    }
    out += *words;
    at += id->size();
  }
  return out;
}

}  // namespace twindeck::diagnosis
