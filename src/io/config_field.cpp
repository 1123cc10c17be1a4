#include "io/config_field.hpp"

#include <fmt/format.h>

#include <cmath>

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

double read_number(const TomlValue& node, const std::string& unit, const Range& range, const Place& place) {
  double value = 0.0;
  if (const auto* number = node.as<double>()) {
    value = *number;
  } else if (const auto* whole = node.as<long>()) {
    value = static_cast<double>(*whole);
  } else if (const auto* text = node.as<std::string>()) {
    value = parse_quantity(*text, unit, place);
  } else {
    throw InputError(place, "is " + shown(node) + ", expected a number",
                     "write it like 1.5" + (unit.empty() ? "" : " or \"1.5 " + unit + "\""));
  }
  if (!std::isfinite(value)) throw InputError(place, "is " + shown(node) + ", expected a finite number", "give a value");
  if (!inside(range, value)) {
    const std::string in_unit = unit.empty() ? "" : " " + unit;
    const std::string converted = node.as<std::string>() != nullptr ? " = " + toml_number(value) + in_unit : "";
    throw InputError(place, "is " + shown(node) + converted + ", expected a value " + range_text(range) + in_unit,
                     "choose a value in that range");
  }
  return value;
}

}  // namespace twindeck::io
