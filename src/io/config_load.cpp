#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/lists.hpp"
#include "io/config.hpp"
#include "io/config_field.hpp"

namespace twindeck::io {

/// Lets the reader below reach the inside of the table that a caller's `add` returned.
struct FieldAccess {
  static const std::vector<std::shared_ptr<FieldTable::Field>>& fields(const FieldTable& table) { return table.fields_; }
  static std::vector<std::string> lines(const FieldTable& table) { return table.lines(); }
};

namespace {

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }  // npos + 1 is 0

/// The known key that was meant: its last part misspelt, else its table, else the right word in the wrong table; "" if none is
/// near.
std::string meant_by(const std::string& key, const std::vector<std::string>& known) {
  const std::string word = last_part(key);
  const std::string table = key.substr(0, key.size() - word.size());
  std::vector<std::string> siblings;
  for (const std::string& name : known)
    if (name.starts_with(table) && name.find('.', table.size()) == std::string::npos)
      siblings.push_back(name.substr(table.size()));
  if (const std::string nearest = nearest_name(word, siblings); !nearest.empty()) return table + nearest;
  if (std::string nearest = nearest_name(key, known); !nearest.empty()) return nearest;
  for (const std::string& name : known)
    if (last_part(name) == word) return name;
  return "";
}

/// The fields of one table of TOML (the file's, or one element's of an array of tables), with what messages need.
struct Reader {
  const std::vector<std::shared_ptr<FieldTable::Field>>& fields;
  std::string file;
  std::string above;  ///< "damper[2]." inside an array of tables
  std::vector<FieldTable::Broken> retired = {};

  [[nodiscard]] FieldTable::Field* find(const std::string& key) const {
    for (const auto& field : fields)
      if (field->key == key) return field.get();
    return nullptr;
  }

  [[nodiscard]] bool is_group(const std::string& key) const {
    return std::ranges::any_of(fields, [&](const auto& field) { return field->key.starts_with(key + "."); });
  }

  [[noreturn]] void unknown(const std::string& key, long line) const {
    for (const FieldTable::Broken& old : retired)
      if (old.key == key) throw InputError({file, line, key}, old.problem, old.mend);
    refuse_unknown_key(file, line, above, key, each_of(fields, [](const auto& field) { return field->key; }));
  }

  void table(const TomlValue::Table& values, const std::string& prefix) const {
    for (const auto& [name, line, node] : values) {
      const std::string key = prefix + name;
      if (FieldTable::Field* field = find(key); field != nullptr) {
        read(*field, node, {file, line, above + key});
      } else if (const auto* group = node.as<TomlValue::Table>(); group != nullptr && is_group(key)) {
        table(*group, key + ".");
      } else if (is_group(key)) {
        throw InputError({file, line, above + key}, "is " + shown(node) + ", expected a table",
                         "write [" + key + "] and its keys below it");
      } else {
        unknown(first_key_below(key, node), line);
      }
    }
  }

  /// "doglegg.radius" of an unknown table [doglegg]: a key in it tells better than the table which one was meant.
  [[nodiscard]] static std::string first_key_below(std::string key, const TomlValue& value) {
    const TomlValue* node = &value;
    for (const auto* inner = node->as<TomlValue::Table>(); inner != nullptr && !inner->empty();
         inner = node->as<TomlValue::Table>()) {
      key += "." + inner->front().key;
      node = &inner->front().value;
    }
    return key;
  }

  void read(FieldTable::Field& field, const TomlValue& node, const Place& place) const {
    if (field.add)
      elements(field, node, place);
    else
      field.read(node, place);
    field.given = true;
    field.place = place;
  }

  void elements(FieldTable::Field& field, const TomlValue& node, const Place& place) const;

  /// Refuses an element of the same name as an earlier one. @param lines  of the names so far
  void refuse_second(const FieldTable::Field& field, const TomlValue::Table& element,
                     std::map<std::string, long>& lines) const {
    const auto name = std::ranges::find_if(element, [&](const TomlEntry& entry) { return entry.key == field.named_by; });
    if (field.named_by.empty() || name == element.end()) return;
    const auto [first, is_new] = lines.emplace(shown(name->value), name->line);
    if (!is_new)
      throw InputError({file, name->line, above + name->key}, fmt::format("is {}, as on line {}", first->first, first->second),
                       "give each [[" + field.key + "]] a " + field.named_by + " of its own, or remove one of the two");
  }

  void require(long line) const {
    for (const auto& field : fields)
      if (field->required && !field->given)
        throw InputError({file, line, above + field->key}, "is missing, a " + field->type + " is required",
                         "add it: " + field->meaning + (field->unit.empty() ? "" : " [" + field->unit + "]"));
  }
};

void Reader::elements(FieldTable::Field& field, const TomlValue& node, const Place& place) const {
  const auto* array = node.as<TomlValue::Array>();
  if (array == nullptr)
    throw InputError(place, "is " + shown(node) + ", expected an array of tables", "begin each with [[" + field.key + "]]");
  std::map<std::string, long> lines;
  for (const TomlValue& item : *array) {
    const auto* values = item.as<TomlValue::Table>();
    if (values == nullptr)
      throw InputError(place, "holds " + shown(item) + ", expected tables only", "begin each with [[" + field.key + "]]");
    const FieldTable element = field.add();
    const Reader reader{FieldAccess::fields(element), file,
                        above + field.key + "[" + std::to_string(field.elements.size()) + "]."};
    reader.table(*values, "");
    reader.require(item.line);
    reader.refuse_second(field, *values, lines);
    // Printed now: the next `add` may move the caller's list, and with it the members that `element` is bound to.
    field.elements.push_back(FieldAccess::lines(element));
  }
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

void FieldTable::load(const std::filesystem::path& file) {
  const Reader reader{fields_, file.string(), "", retired_};
  reader.table(read_toml(file), "");
  reader.require(0);
}

void FieldTable::set(const std::string& key_equals_value) {
  const std::size_t equals = key_equals_value.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError({"--set", 0, ""}, "got '" + key_equals_value + "', expected key=value", "write for example --set key=1.5");
  const std::string key = key_equals_value.substr(0, equals);
  const std::string value = key_equals_value.substr(equals + 1);
  const Reader reader{fields_, "--set", "", retired_};
  Field* field = reader.find(key);
  if (field == nullptr) reader.unknown(key, 0);
  if (field->add)
    throw InputError({"--set", 0, key}, "is an array of tables and cannot be set on the command line",
                     "write it into the configuration file");
  TomlValue parsed = toml_of_command_line(value, key);
  if (field->takes_text && parsed.as<std::string>() == nullptr) parsed = {value, 0};  // --set version=5: the text "5"
  reader.read(*field, parsed, {"--set", 0, key});
}

std::optional<Place> FieldTable::place_of(const std::string& key) const {
  const std::string asked = key.substr(0, key.find('['));
  const Field* found = nullptr;
  for (const auto& field : fields_) {
    if (field->key == asked || (field->add && asked.starts_with(field->key + "."))) return field->place;
    const bool ends_so = field->key.ends_with("." + asked);
    if (ends_so && (found == nullptr || (!found->given && field->given))) found = field.get();
  }
  if (found == nullptr) return std::nullopt;
  return found->place;
}

void FieldTable::require() const {
  Reader{fields_, "", ""}.require(0);
  for (const auto& check : rules_) {
    const std::optional<Broken> broken = check();
    if (!broken) continue;
    Place place = place_of(broken->key).value_or(Place{});
    place.key = broken->key;
    throw InputError(place, broken->problem, broken->mend);
  }
}

}  // namespace twindeck::io
