#include "io/config_field.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "core/units.hpp"

namespace twindeck::io {

std::string range_text(const Range& range) {
  const bool low = std::isfinite(range.lower), high = std::isfinite(range.upper);
  if (low && high) {
    return fmt::format("in {}{}, {}]", range.open_lower ? "]" : "[", toml_number(range.lower), toml_number(range.upper));
  }
  if (low) return (range.open_lower ? "> " : ">= ") + toml_number(range.lower);
  if (high) return "<= " + toml_number(range.upper);
  return "";
}

bool inside(const Range& range, double value) {
  return (range.open_lower ? value > range.lower : value >= range.lower) && value <= range.upper;
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
      case '"': quoted += "\\\""; break;
      case '\\': quoted += "\\\\"; break;
      case '\n': quoted += "\\n"; break;
      case '\t': quoted += "\\t"; break;
      default:
        if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) {
          quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(letter));
        } else {
          quoted += letter;
        }
    }
  }
  return quoted + "\"";
}

std::string shown(const toml::node& node) {
  if (const auto* text = node.as_string()) return toml_text(text->get());
  if (const auto* number = node.as_floating_point()) return toml_number(number->get());
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (node.is_table()) return "a table";
  if (node.is_array()) return "an array";
  return "a date or time";
}

double read_number(const toml::node& node, const std::string& unit, const Range& range, const Place& place) {
  double value = 0.0;
  if (const auto* number = node.as_floating_point()) {
    value = number->get();
  } else if (const auto* whole = node.as_integer()) {
    value = static_cast<double>(whole->get());
  } else if (const auto* text = node.as_string()) {
    value = parse_quantity(text->get(), unit, place);
  } else {
    throw InputError(place, "is " + shown(node) + ", expected a number",
                     "write it like 1.5" + (unit.empty() ? "" : " or \"1.5 " + unit + "\""));
  }
  if (!std::isfinite(value)) throw InputError(place, "is " + shown(node) + ", expected a finite number", "give a value");
  if (!inside(range, value)) {
    const std::string in_unit = unit.empty() ? "" : " " + unit;
    const std::string converted = node.is_string() ? " = " + toml_number(value) + in_unit : "";
    throw InputError(place, "is " + shown(node) + converted + ", expected a value " + range_text(range) + in_unit,
                     "choose a value in that range");
  }
  return value;
}

}  // namespace twindeck::io
