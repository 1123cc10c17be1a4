#include "io/config.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/config_field.hpp"
#include "io/path_name.hpp"

namespace twindeck::io {
namespace {

using Fields = std::vector<std::shared_ptr<FieldTable::Field>>;

/// Binds a key: keeps its default, refuses a key bound twice (a mistake of ours).
FieldTable::Field& bind_key(Fields& fields, const std::string& key, const std::string& type, const std::string& meaning) {
  for (const auto& field : fields) {
    if (field->key == key) throw InternalError("configuration key '" + key + "' is bound twice");
  }
  auto field = std::make_shared<FieldTable::Field>();
  field->key = key;
  field->type = type;
  field->meaning = meaning;
  fields.push_back(field);
  return *field;
}

template <typename List, typename Print>
std::string toml_array(const List& list, Print&& print) {
  std::string text = "[";
  for (const auto& item : list) text += (text.size() > 1 ? ", " : "") + print(item);
  return text + "]";
}

const TomlValue::Array& as_array(const TomlValue& node, const Place& place, const std::string& of_what) {
  if (const auto* array = node.as<TomlValue::Array>()) return *array;
  throw InputError(place, "is " + shown(node) + ", expected an array of " + of_what, "write it in square brackets: [ … ]");
}

std::string read_text(const TomlValue& node, const Place& place) {
  if (const auto* text = node.as<std::string>()) return *text;
  throw InputError(place, "is " + shown(node) + ", expected text", "write it in quotes");
}

Place at_line(const TomlValue& node, Place place) {
  if (node.line > 0 && place.line > 0) place.line = node.line;  // --set has no lines
  return place;
}

std::string read_choice(const TomlValue& node, const std::vector<std::string>& allowed, const Place& place) {
  const std::string value = read_text(node, place);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    throw InputError(place, "is " + toml_text(value) + did_you_mean(value, allowed),
                     fmt::format("choose one of {}", fmt::join(allowed, ", ")));
  }
  return value;
}

/// The texts of an array. @param read  one of them, with its place
template <typename Read>
std::vector<std::string> read_texts(const TomlValue& node, const Place& place, Read&& read) {
  std::vector<std::string> values;
  for (const TomlValue& item : as_array(node, place, "texts")) {
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
  Field& field = bind_key(fields_, key, "number", meaning);
  field.unit = unit;
  field.allowed = range_text(range);
  field.required = required;
  field.read = [&target, unit, range](const TomlValue& node, const Place& place) {
    target = read_number(node, unit, range, place);
  };
  field.write = [&target] { return toml_number(target); };
  field.default_value = field.write();
  return *this;
}

FieldTable& FieldTable::integer(const std::string& key, long& target, Range range, const std::string& meaning, bool required) {
  Field& field = bind_key(fields_, key, "whole number", meaning);
  field.allowed = range_text(range);
  field.required = required;
  field.read = [&target, range](const TomlValue& node, const Place& place) {
    const auto* whole = node.as<long>();
    if (whole == nullptr) {
      throw InputError(place, "is " + shown(node) + ", expected a whole number", "write it without point, quotes or unit");
    }
    static_cast<void>(read_number(node, "", range, place));  // checks the range; a double does not hold every 64-bit number
    target = *whole;
  };
  field.write = [&target] { return std::to_string(target); };
  field.default_value = field.write();
  return *this;
}

FieldTable& FieldTable::boolean(const std::string& key, bool& target, const std::string& meaning) {
  Field& field = bind_key(fields_, key, "true or false", meaning);
  field.read = [&target](const TomlValue& node, const Place& place) {
    const auto* flag = node.as<bool>();
    if (flag == nullptr) throw InputError(place, "is " + shown(node) + ", expected true or false", "write it without quotes");
    target = *flag;
  };
  field.write = [&target] { return std::string(target ? "true" : "false"); };
  field.default_value = field.write();
  return *this;
}

FieldTable& FieldTable::text(const std::string& key, std::string& target, const std::string& meaning, bool required) {
  Field& field = bind_key(fields_, key, "text", meaning);
  field.required = required;
  field.takes_text = true;
  field.read = [&target](const TomlValue& node, const Place& place) { target = read_text(node, place); };
  field.write = [&target] { return toml_text(target); };
  field.default_value = field.write();
  return *this;
}

FieldTable& FieldTable::path_name(const std::string& key, std::string& target, const std::string& what,
                                  const std::string& meaning, bool required) {
  text(key, target, meaning, required);
  Field& field = *fields_.back();
  field.allowed = "no slash";
  field.read = [&target, what](const TomlValue& node, const Place& place) {
    const std::string name = read_text(node, place);
    check_path_name(name, what, place);
    target = name;
  };
  return *this;
}

FieldTable& FieldTable::choice(const std::string& key, std::string& target, const std::vector<std::string>& allowed,
                               const std::string& meaning) {
  Field& field = bind_key(fields_, key, "text", meaning);
  field.allowed = fmt::format("one of {}", fmt::join(allowed, ", "));
  field.takes_text = true;
  field.read = [&target, allowed](const TomlValue& node, const Place& place) { target = read_choice(node, allowed, place); };
  field.write = [&target] { return toml_text(target); };
  field.default_value = field.write();
  return *this;
}

FieldTable& FieldTable::retired(const std::string& key, const std::string& problem, const std::string& mend) {
  retired_.push_back({key, problem, mend});
  return *this;
}

FieldTable& FieldTable::numbers(const std::string& key, std::vector<double>& target, const std::string& unit, Range range,
                                const std::string& meaning) {
  Field& field = bind_key(fields_, key, "array of numbers", meaning);
  field.unit = unit;
  field.allowed = range_text(range).empty() ? "" : "each " + range_text(range);
  field.read = [&target, unit, range](const TomlValue& node, const Place& place) {
    std::vector<double> values;
    for (const TomlValue& item : as_array(node, place, "numbers")) {
      Place element = at_line(item, place);
      element.key += "[" + std::to_string(values.size()) + "]";
      values.push_back(read_number(item, unit, range, element));
    }
    target = std::move(values);
  };
  field.write = [&target] { return toml_array(target, toml_number); };
  field.default_value = field.write();
  return *this;
}

FieldTable& FieldTable::texts(const std::string& key, std::vector<std::string>& target, const std::string& meaning) {
  Field& field = bind_key(fields_, key, "array of texts", meaning);
  field.read = [&target](const TomlValue& node, const Place& place) { target = read_texts(node, place, read_text); };
  field.write = [&target] { return toml_array(target, toml_text); };
  field.default_value = field.write();
  return *this;
}

FieldTable& FieldTable::choices(const std::string& key, std::vector<std::string>& target,
                                const std::vector<std::string>& allowed, const std::string& meaning) {
  texts(key, target, meaning);
  Field& field = *fields_.back();
  field.allowed = fmt::format("each one of {}", fmt::join(allowed, ", "));
  field.read = [&target, allowed](const TomlValue& node, const Place& place) {
    target = read_texts(node, place, [&](const TomlValue& item, const Place& at) { return read_choice(item, allowed, at); });
  };
  return *this;
}

FieldTable& FieldTable::tables(const std::string& key, std::function<FieldTable()> add, const std::string& meaning,
                               const std::string& named_by) {
  Field& field = bind_key(fields_, key, "array of tables", meaning);
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
