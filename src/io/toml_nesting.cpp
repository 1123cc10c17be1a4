#include "io/toml_nesting.hpp"

#include <algorithm>

namespace twindeck::io {

namespace {

/// Where the string that begins at `at` (a quote) ends: behind its closing quotes, or the end of the text.
std::size_t end_of_string(std::string_view toml, std::size_t at) {
  const char quote = toml[at];
  const bool escapes = quote == '"';
  const bool many_lines = toml.substr(at, 3) == std::string_view(escapes ? "\"\"\"" : "'''");
  for (at += many_lines ? 3 : 1; at < toml.size(); ++at) {
    if (escapes && toml[at] == '\\') {
      ++at;
    } else if (!many_lines && (toml[at] == quote || toml[at] == '\n')) {
      return toml[at] == quote ? at + 1 : at;
    } else if (many_lines && toml.substr(at, 3) == std::string_view(escapes ? "\"\"\"" : "'''")) {
      return at + 3;
    }
  }
  return toml.size();
}

}  // namespace

std::optional<long> line_nested_too_deep(std::string_view toml) {
  long line = 1;
  int brackets = 0, dots = 0;
  for (std::size_t at = 0; at < toml.size();) {
    const char letter = toml[at];
    if (letter == '"' || letter == '\'') {
      const std::size_t end = std::min(end_of_string(toml, at), toml.size());
      line += std::count(toml.begin() + static_cast<std::ptrdiff_t>(at), toml.begin() + static_cast<std::ptrdiff_t>(end), '\n');
      at = end;
      continue;
    }
    if (letter == '#') {
      at = std::min(toml.find('\n', at), toml.size());
      continue;
    }
    if (letter == '[' || letter == '{') ++brackets;
    if (letter == ']' || letter == '}') brackets = std::max(0, brackets - 1);
    if (letter == '.') {
      ++dots;
    } else if (std::string_view("[]{},=\n").find(letter) != std::string_view::npos) {
      dots = 0;
    }
    if (brackets > most_toml_levels || dots >= most_toml_levels) return line;
    if (letter == '\n') ++line;
    ++at;
  }
  return std::nullopt;
}

}  // namespace twindeck::io
