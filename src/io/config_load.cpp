#include <fmt/format.h>

#include <algorithm>

#include "io/config.hpp"
#include "io/config_field.hpp"

namespace twindeck::io {
namespace fs = std::filesystem;

/// Lets the reader below reach the inside of the table that a caller's `add` returned.
struct FieldAccess {
  static const std::vector<std::shared_ptr<FieldTable::Field>>& fields(const FieldTable& table) { return table.fields_; }
  static std::vector<std::string> lines(const FieldTable& table) { return table.lines(); }
};

namespace {

using Fields = std::vector<std::shared_ptr<FieldTable::Field>>;

/// The fields of one table of TOML (the file's, or one element's of an array of tables), with what messages need.
struct Reader {
  const Fields& fields;
  std::string file;
  std::string above;  ///< "damper[2]." inside an array of tables

  [[nodiscard]] FieldTable::Field* find(const std::string& key) const {
    for (const auto& field : fields) {
      if (field->key == key) return field.get();
    }
    return nullptr;
  }

  [[nodiscard]] bool is_group(const std::string& key) const {
    return std::any_of(fields.begin(), fields.end(), [&](const auto& field) { return field->key.starts_with(key + "."); });
  }

  [[noreturn]] void unknown(const std::string& key, long line) const {
    std::vector<std::string> known;
    for (const auto& field : fields) known.push_back(field->key);
    const std::string listed = fmt::format("known keys: {}", fmt::join(known, ", "));
    std::string guess = did_you_mean(key, known);
    if (guess.empty()) {  // the right word in the wrong table: "max_iterations" for "solver.max_iterations"
      const std::string last = key.substr(key.rfind('.') == std::string::npos ? 0 : key.rfind('.') + 1);
      for (const std::string& name : known) {
        if (guess.empty() && (name == last || name.ends_with("." + last))) guess = " (did you mean '" + name + "'?)";
      }
    }
    throw InputError({file, line, above + key}, "is no known key" + guess, known.empty() ? "no key is known here" : listed);
  }

  void table(const TomlValue::Table& values, const std::string& prefix) const {
    for (const auto& [name, line, node] : values) {
      const std::string key = prefix + name;
      if (FieldTable::Field* field = find(key); field != nullptr) {
        read(*field, node, {file, line, above + key});
      } else if (const auto* group = node.as<TomlValue::Table>(); group != nullptr && is_group(key)) {
        table(*group, key + ".");
      } else {
        unknown(key, line);
      }
    }
  }

  void read(FieldTable::Field& field, const TomlValue& node, const Place& place) const {
    if (field.add) {
      elements(field, node, place);
    } else {
      field.read(node, place);
    }
    field.given = true;
  }

  void elements(FieldTable::Field& field, const TomlValue& node, const Place& place) const;

  void require(long line) const {
    for (const auto& field : fields) {
      if (field->required && !field->given) {
        throw InputError({file, line, above + field->key}, "is missing, a " + field->type + " is required",
                         "add it: " + field->meaning + (field->unit.empty() ? "" : " [" + field->unit + "]"));
      }
    }
  }
};

void Reader::elements(FieldTable::Field& field, const TomlValue& node, const Place& place) const {
  const auto* array = node.as<TomlValue::Array>();
  if (array == nullptr) {
    throw InputError(place, "is " + shown(node) + ", expected an array of tables", "begin each with [[" + field.key + "]]");
  }
  for (const TomlValue& item : *array) {
    const auto* values = item.as<TomlValue::Table>();
    if (values == nullptr) {
      throw InputError(place, "holds " + shown(item) + ", expected tables only", "begin each with [[" + field.key + "]]");
    }
    const FieldTable element = field.add();
    const Reader reader{FieldAccess::fields(element), file,
                        above + field.key + "[" + std::to_string(field.elements.size()) + "]."};
    reader.table(*values, "");
    reader.require(item.line);
    // Printed now: the next `add` may move the caller's list, and with it the members that `element` is bound to.
    field.elements.push_back(FieldAccess::lines(element));
  }
}

}  // namespace

void FieldTable::load(const fs::path& file) {
  const Reader reader{fields_, file.string(), ""};
  reader.table(read_toml(file), "");
  reader.require(0);
}

void FieldTable::set(const std::string& key_equals_value) {
  const std::size_t equals = key_equals_value.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError({"--set", 0, ""}, "got '" + key_equals_value + "', expected key=value", "write for example --set key=1.5");
  }
  const std::string key = key_equals_value.substr(0, equals);
  const std::string value = key_equals_value.substr(equals + 1);
  const Reader reader{fields_, "--set", ""};
  Field* field = reader.find(key);
  if (field == nullptr) reader.unknown(key, 0);
  if (field->add) {
    throw InputError({"--set", 0, key}, "is an array of tables and cannot be set on the command line",
                     "write it into the configuration file");
  }
  TomlValue parsed = toml_of_command_line(value);
  if (field->takes_text && parsed.as<std::string>() == nullptr) parsed = {value, 0};  // --set version=5: the text "5"
  reader.read(*field, parsed, {"--set", 0, key});
}

void FieldTable::require() const { Reader{fields_, "", ""}.require(0); }

}  // namespace twindeck::io
