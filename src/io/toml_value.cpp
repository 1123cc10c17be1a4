#include "io/toml_value.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "io/text_lines.hpp"

namespace twindeck::io {
namespace {

TomlValue converted(const toml::node& node);

TomlValue::Table converted_table(const toml::table& table) {
  TomlValue::Table entries;
  for (const auto& [key, node] : table)
    entries.push_back({std::string(key.str()), static_cast<long>(key.source().begin.line), converted(node)});
  return entries;
}

TomlValue converted(const toml::node& node) {
  TomlValue result;
  result.line = static_cast<long>(node.source().begin.line);
  if (const auto* text = node.as_string()) {
    result.value = text->get();
  } else if (const auto* number = node.as_floating_point()) {
    result.value = number->get();
  } else if (const auto* whole = node.as_integer()) {
    result.value = static_cast<long>(whole->get());
  } else if (const auto* flag = node.as_boolean()) {
    result.value = flag->get();
  } else if (const auto* table = node.as_table()) {
    result.value = converted_table(*table);
  } else if (const auto* array = node.as_array()) {
    TomlValue::Array items;
    for (const toml::node& item : *array) items.push_back(converted(item));
    result.value = std::move(items);
  }
  return result;
}

/// @param place  the file, whose line is told, or an option of the command line with its key
void refuse_deep_nesting(const std::string& text, Place place) {
  const std::optional<long> line = line_nested_too_deep(text);
  if (!line) return;
  if (place.key.empty()) place.line = *line;
  throw InputError(place, fmt::format("nests more than {} levels of tables or arrays", most_toml_levels),
                   "no file of this program needs more than four; mend the brackets or the dots of the key");
}

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

TomlValue::Table read_toml(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError({file.string(), 0, ""}, "cannot be opened", "check the path of the configuration");
  const std::string text = text_of_file(file);
  refuse_deep_nesting(text, {file.string(), 0, ""});
  try {
    return converted_table(toml::parse(text, file.string()));
  } catch (const toml::parse_error& error) {
    throw InputError({file.string(), static_cast<long>(error.source().begin.line), ""},
                     "is no valid TOML: " + std::string(error.description()), "mend the line");
  }
}

TomlValue toml_of_command_line(const std::string& text, const std::string& key) {
  refuse_deep_nesting(text, {"--set", 0, key});
  try {
    const toml::table parsed = toml::parse("value = " + text);
    if (parsed.size() == 1) return converted(*parsed.get("value"));
  } catch (const toml::parse_error&) {
    // no TOML, so it is a bare word
  }
  return {text, 0};
}

std::string shown(const TomlValue& value) {
  if (const auto* text = value.as<std::string>()) return toml_text(*text);
  if (const auto* number = value.as<double>()) return toml_number(*number);
  if (const auto* whole = value.as<long>()) return std::to_string(*whole);
  if (const auto* flag = value.as<bool>()) return *flag ? "true" : "false";
  if (value.as<TomlValue::Table>() != nullptr) return "a table";
  if (value.as<TomlValue::Array>() != nullptr) return "an array";
  return "a date or time";
}

std::string text_of(const TomlValue& value, const Place& place) {
  if (const auto* text = value.as<std::string>()) return *text;
  throw InputError(place, "is " + shown(value) + ", expected text", "write it in quotes");
}

std::optional<double> number_of(const TomlValue& value) {
  if (const auto* number = value.as<double>()) return *number;
  if (const auto* whole = value.as<long>()) return static_cast<double>(*whole);
  return {};
}

std::string toml_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value == 0.0 ? "0" : fmt::format("{}", value);
}

std::string toml_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    switch (letter) {
      case '"':
        quoted += "\\\"";
        break;
      case '\\':
        quoted += "\\\\";
        break;
      case '\n':
        quoted += "\\n";
        break;
      case '\t':
        quoted += "\\t";
        break;
      default:
        if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f)
          quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(letter));
        else
          quoted += letter;
    }
  }
  return quoted + "\"";
}

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
