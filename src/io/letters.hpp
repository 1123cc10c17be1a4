#pragma once

#include <algorithm>
#include <cctype>
#include <string>

/// Text in one case, for words that files write in any: letters of ASCII alone change.
namespace twindeck::io {

[[nodiscard]] inline std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

[[nodiscard]] inline std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace twindeck::io
