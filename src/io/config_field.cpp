#include "io/config_field.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"

namespace twindeck::io {
namespace {

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }  // npos + 1 is 0

/// The known key that was meant: its last part misspelt, else its table, else the right word in the wrong table; "" if none is
/// near.
std::string meant_by(const std::string& key, const std::vector<std::string>& known) {
  const std::string word = last_part(key);
  const std::string table = key.substr(0, key.size() - word.size());
  std::vector<std::string> siblings;
  for (const std::string& name : known) {
    if (name.starts_with(table) && name.find('.', table.size()) == std::string::npos)
      siblings.push_back(name.substr(table.size()));
  }
  if (const std::string nearest = nearest_name(word, siblings); !nearest.empty()) return table + nearest;
  if (std::string nearest = nearest_name(key, known); !nearest.empty()) return nearest;
  for (const std::string& name : known) {
    if (last_part(name) == word) return name;
  }
  return "";
}

}  // namespace

void refuse_unknown_key(const std::string& file, long line, const std::string& above, const std::string& key,
                        const std::vector<std::string>& known) {
  const std::string meant = meant_by(key, known);
  std::string mend = "no key is known here";
  if (!meant.empty()) {
    mend = "did you mean '" + above + meant + "'?";
  } else if (!known.empty()) {
    mend = fmt::format("known keys are {}", fmt::join(known, ", "));
  }
  throw InputError({file, line, ""}, "unknown key '" + above + key + "'", mend);
}

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
  if (std::abs(value) > largest_number) {
    throw InputError(place, "is " + shown(node) + ", larger than any quantity of a structure", "correct the value or its unit");
  }
  return value;
}

}  // namespace twindeck::io
