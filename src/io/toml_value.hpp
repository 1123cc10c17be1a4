#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/error.hpp"

namespace twindeck::io {

struct TomlEntry;

/// A value of a TOML file with its line (0 = unknown). Only one source file includes toml++.
struct TomlValue {
  using Array = std::vector<TomlValue>;
  using Table = std::vector<TomlEntry>;  ///< in the order of their names
  struct Date {};                        ///< a date, which every reader refuses
  std::variant<Date, bool, long, double, std::string, Array, Table> value;
  long line = 0;

  template <typename Kind>
  [[nodiscard]] const Kind* as() const {
    return std::get_if<Kind>(&value);
  }
};

struct TomlEntry {
  std::string key;
  long line = 0;
  TomlValue value;
};

/// @throws InputError  with file and line, if the file cannot be opened or is not valid TOML
[[nodiscard]] TomlValue::Table read_toml(const std::filesystem::path& file);
/// The value of a `--set key=value`: TOML, or the text itself where it is a bare word ("refined", "210 GPa").
/// @param key  for the message
[[nodiscard]] TomlValue toml_of_command_line(const std::string& text, const std::string& key);
/// A value as the user wrote it, for messages: 3.5, "abc", true, a table.
[[nodiscard]] std::string shown(const TomlValue& value);
/// @throws InputError  at `place`, if the value is not a text
[[nodiscard]] std::string text_of(const TomlValue& value, const Place& place);
/// A number, whole or not; nothing for another value.
[[nodiscard]] std::optional<double> number_of(const TomlValue& value);
/// Shortest text that reads back to the same double. Whole numbers have no decimal point (readers accept integers).
[[nodiscard]] std::string toml_number(double value);
/// A basic TOML string with its escapes.
[[nodiscard]] std::string toml_text(const std::string& text);

/// Levels of tables and arrays, and names of one dotted key, that a TOML text may have. Our own files need four. The parser and
/// the destructors of what it builds call themselves once a level, so that a file of a million brackets or dots ends on the
/// stack.
inline constexpr int most_toml_levels = 32;

/// Line (from 1) at which a TOML text first goes deeper than `most_toml_levels`, in brackets or in the names of a dotted key;
/// nothing for a text that does not. Strings and comments are passed over; whether the text is TOML at all is not checked.
[[nodiscard]] std::optional<long> line_nested_too_deep(std::string_view toml);

}  // namespace twindeck::io
