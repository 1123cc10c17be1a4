#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

/// Text in upper or lower case, for comparing words of files. Only ASCII letters change.
namespace twindeck {

/// The text without blanks at its ends.
[[nodiscard]] inline std::string_view without_blanks(std::string_view text, std::string_view blanks = " \t\r\n") {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

[[nodiscard]] inline std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

[[nodiscard]] inline std::string lower_case(std::string_view from) {
  std::string text(from);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace twindeck
