#include "io/config.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "core/lists.hpp"
#include "core/units.hpp"
#include "io/config_field.hpp"
#include "io/path_name.hpp"

namespace twindeck::io {
namespace {

/// Binds a key: keeps its default, refuses a key bound twice (a mistake of ours). @param read, write  none for an array of
/// tables
FieldTable::Field& bind_key(std::vector<std::shared_ptr<FieldTable::Field>>& fields, const std::string& key,
                            const std::string& type, const std::string& meaning,
                            std::function<void(const TomlValue&, const Place&)> read, std::function<std::string()> write) {
  for (const auto& field : fields)
    if (field->key == key) throw InternalError("configuration key '" + key + "' is bound twice");
  auto field = std::make_shared<FieldTable::Field>();
  field->key = key;
  field->type = type;
  field->meaning = meaning;
  field->read = std::move(read);
  field->write = std::move(write);
  if (field->write) field->default_value = field->write();
  fields.push_back(field);
  return *field;
}

/// "> 0", "in [0, 1]", "in ]0, 1]" or "".
std::string range_text(const Range& range) {
  const bool low = std::isfinite(range.lower), high = std::isfinite(range.upper);
  if (low && high)
    return fmt::format("in {}{}, {}]", range.open_lower ? "]" : "[", toml_number(range.lower), toml_number(range.upper));
  if (low) return (range.open_lower ? "> " : ">= ") + toml_number(range.lower);
  if (high) return "<= " + toml_number(range.upper);
  return "";
}

bool inside(const Range& range, double value) {
  return (range.open_lower ? value > range.lower : value >= range.lower) && value <= range.upper;
}

/// A finite number in `unit` from a number or a string with unit. @throws InputError
double read_number(const TomlValue& node, const std::string& unit, const Range& range, const Place& place) {
  double value = 0.0;
  if (const auto number = number_of(node)) {
    value = *number;
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
  if (std::abs(value) > largest_number)
    throw InputError(place, "is " + shown(node) + ", larger than any quantity of a structure", "correct the value or its unit");
  return value;
}

template <typename List, typename Print>
std::string toml_array(const List& list, const Print& print) {
  return fmt::format("[{}]", fmt::join(each_of(list, print), ", "));
}

const TomlValue::Array& as_array(const TomlValue& node, const Place& place, const std::string& of_what) {
  if (const auto* array = node.as<TomlValue::Array>()) return *array;
  throw InputError(place, "is " + shown(node) + ", expected an array of " + of_what, "write it in square brackets: [ … ]");
}

Place at_line(const TomlValue& node, Place place) {
  if (node.line > 0 && place.line > 0) place.line = node.line;  // --set has no lines
  return place;
}

std::string read_choice(const TomlValue& node, const std::vector<std::string>& allowed, const Place& place) {
  const std::string value = text_of(node, place);
  if (!contains(allowed, value))
    throw InputError(place, "is " + toml_text(value) + did_you_mean(value, allowed),
                     fmt::format("choose one of {}", fmt::join(allowed, ", ")));
  return value;
}

/// The values of an array. @param what  "texts" @param read  one of them, with its place
template <typename Value, typename Read>
std::vector<Value> read_array(const TomlValue& node, const Place& place, const std::string& what, Read&& read) {
  std::vector<Value> values;
  for (const TomlValue& item : as_array(node, place, what)) {
    Place element = at_line(item, place);
    element.key += "[" + std::to_string(values.size()) + "]";
    values.push_back(read(item, element));
  }
  return values;
}

}  // namespace

FieldTable::FieldTable() = default;

FieldTable& FieldTable::number(const std::string& key, double& target, const std::string& unit, Range range,
                               const std::string& meaning, bool required) {
  Field& field = bind_key(
      fields_, key, "number", meaning,
      [&target, unit, range](const TomlValue& node, const Place& place) { target = read_number(node, unit, range, place); },
      [&target] { return toml_number(target); });
  field.unit = unit;
  field.allowed = range_text(range);
  field.required = required;
  return *this;
}

template <typename Whole>
FieldTable& FieldTable::integer(const std::string& key, Whole& target, Range range, const std::string& meaning, bool required) {
  Field& field = bind_key(
      fields_, key, "whole number", meaning,
      [&target, range](const TomlValue& node, const Place& place) {
        const auto* whole = node.as<long>();
        if (whole == nullptr)
          throw InputError(place, "is " + shown(node) + ", expected a whole number", "write it without point, quotes or unit");
        static_cast<void>(read_number(node, "", range, place));  // checks the range; a double does not hold every 64-bit number
        target = static_cast<Whole>(*whole);
      },
      [&target] { return std::to_string(target); });
  field.allowed = range_text(range);
  field.required = required;
  return *this;
}
template FieldTable& FieldTable::integer(const std::string&, int&, Range, const std::string&, bool);
template FieldTable& FieldTable::integer(const std::string&, long&, Range, const std::string&, bool);
template FieldTable& FieldTable::integer(const std::string&, std::uint64_t&, Range, const std::string&, bool);

FieldTable& FieldTable::boolean(const std::string& key, bool& target, const std::string& meaning) {
  bind_key(
      fields_, key, "true or false", meaning,
      [&target](const TomlValue& node, const Place& place) {
        const auto* flag = node.as<bool>();
        if (flag == nullptr)
          throw InputError(place, "is " + shown(node) + ", expected true or false", "write it without quotes");
        target = *flag;
      },
      [&target] { return std::string(target ? "true" : "false"); });
  return *this;
}

FieldTable& FieldTable::text(const std::string& key, std::string& target, const std::string& meaning, bool required) {
  Field& field = bind_key(
      fields_, key, "text", meaning, [&target](const TomlValue& node, const Place& place) { target = text_of(node, place); },
      [&target] { return toml_text(target); });
  field.required = required;
  field.takes_text = true;
  return *this;
}

FieldTable& FieldTable::path_name(const std::string& key, std::string& target, const std::string& what,
                                  const std::string& meaning, bool required) {
  text(key, target, meaning, required);
  Field& field = *fields_.back();
  field.allowed = "no slash";
  field.read = [&target, what](const TomlValue& node, const Place& place) {
    const std::string name = text_of(node, place);
    check_path_name(name, what, place);
    target = name;
  };
  return *this;
}

FieldTable& FieldTable::choice(const std::string& key, std::string& target, const std::vector<std::string>& allowed,
                               const std::string& meaning) {
  return choice(
      key, [&target](const std::string& word) { target = word; }, [&target] { return target; }, allowed, meaning);
}

FieldTable& FieldTable::choice(const std::string& key, std::function<void(const std::string&)> read,
                               std::function<std::string()> write, const std::vector<std::string>& allowed,
                               const std::string& meaning) {
  Field& field = bind_key(
      fields_, key, "text", meaning,
      [read, allowed](const TomlValue& node, const Place& place) { read(read_choice(node, allowed, place)); },
      [write] { return toml_text(write()); });
  field.allowed = fmt::format("one of {}", fmt::join(allowed, ", "));
  field.takes_text = true;
  return *this;
}

FieldTable& FieldTable::retired(const std::string& key, const std::string& problem, const std::string& mend) {
  retired_.push_back({key, problem, mend});
  return *this;
}

FieldTable& FieldTable::numbers(const std::string& key, std::vector<double>& target, const std::string& unit, Range range,
                                const std::string& meaning) {
  Field& field = bind_key(
      fields_, key, "array of numbers", meaning,
      [&target, unit, range](const TomlValue& node, const Place& place) {
        target = read_array<double>(node, place, "numbers",
                                    [&](const TomlValue& item, const Place& at) { return read_number(item, unit, range, at); });
      },
      [&target] { return toml_array(target, toml_number); });
  field.unit = unit;
  field.allowed = range_text(range).empty() ? "" : "each " + range_text(range);
  return *this;
}

FieldTable& FieldTable::texts(const std::string& key, std::vector<std::string>& target, const std::string& meaning) {
  bind_key(
      fields_, key, "array of texts", meaning,
      [&target](const TomlValue& node, const Place& place) { target = read_array<std::string>(node, place, "texts", text_of); },
      [&target] { return toml_array(target, toml_text); });
  return *this;
}

FieldTable& FieldTable::choices(const std::string& key, std::vector<std::string>& target,
                                const std::vector<std::string>& allowed, const std::string& meaning) {
  texts(key, target, meaning);
  Field& field = *fields_.back();
  field.allowed = fmt::format("each one of {}", fmt::join(allowed, ", "));
  field.read = [&target, allowed](const TomlValue& node, const Place& place) {
    target = read_array<std::string>(node, place, "texts",
                                     [&](const TomlValue& item, const Place& at) { return read_choice(item, allowed, at); });
  };
  return *this;
}

FieldTable& FieldTable::tables(const std::string& key, std::function<FieldTable()> add, const std::string& meaning,
                               const std::string& named_by) {
  Field& field = bind_key(fields_, key, "array of tables", meaning, {}, {});
  field.add = std::move(add);
  field.named_by = named_by;
  if (!named_by.empty()) field.allowed = "no two with the same " + named_by;
  return *this;
}

FieldTable& FieldTable::rule(std::function<std::optional<Broken>()> broken) {
  rules_.push_back(std::move(broken));
  return *this;
}

}  // namespace twindeck::io
