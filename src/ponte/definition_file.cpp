#include "ponte/definition_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/lists.hpp"
#include "core/units.hpp"
#include "io/toml_value.hpp"

namespace twindeck::ponte {

namespace {

bool below(const std::string& path, const std::string& table) {
  return path.size() > table.size() && path.starts_with(table) && path[table.size()] == '.';
}

// "deck.cycle.slab.all.thickness" without its list positions, for comparing keys of different list entries.
std::string without_positions(const std::string& path) {
  std::string out;
  for (std::size_t begin = 0, end = 0; begin <= path.size(); begin = end + 1) {
    end = std::min(path.find('.', begin), path.size());
    const std::string part = path.substr(begin, end - begin);
    const bool position = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (!position) out += (out.empty() ? "" : ".") + part;
  }
  return out;
}

}  // namespace

/// Lays the tree of tables and lists out as paths.
struct Flattener {
  DefinitionFile& out;

  void table(const io::TomlValue::Table& entries, const std::string& path) {
    for (const io::TomlEntry& entry : entries) walk(entry.value, path.empty() ? entry.key : path + "." + entry.key);
  }

  void walk(const io::TomlValue& node, const std::string& path) {
    if (const auto* entries = node.as<io::TomlValue::Table>())
      table(*entries, path);
    else if (const auto* list = node.as<io::TomlValue::Array>())
      for (std::size_t i = 0; i < list->size(); ++i) walk((*list)[i], path + "." + std::to_string(i));
    else
      leaf(node, path);
  }

  void leaf(const io::TomlValue& node, const std::string& path) {
    DefinitionFile::Value value;
    value.line = node.line;
    if (const auto* text = node.as<std::string>()) {
      value.text = *text;
      value.is_text = true;
    } else if (const auto* whole = node.as<long>()) {
      value.text = std::to_string(*whole);
    } else if (const auto* real = node.as<double>()) {
      value.text = io::toml_number(*real);
    } else {
      throw InputError({out.file_, value.line, path}, "is " + io::shown(node) + ", neither a number nor a text",
                       "give a number, or a text such as \"35 GPa\"");
    }
    if (!out.values_.emplace(path, value).second)
      throw InputError({out.file_, value.line, path}, "is given twice", "keep one of the two");
  }
};

DefinitionFile DefinitionFile::load(const std::filesystem::path& file) {
  DefinitionFile out;
  out.file_ = file.string();
  Flattener{out}.table(io::read_toml(file), "");
  return out;
}

void DefinitionFile::fail(const std::string& path, const std::string& problem, const std::string& mend) const {
  throw InputError({file_, line_of(path), path}, problem, mend);
}

std::vector<std::string> DefinitionFile::paths_below(const std::string& table) const {
  std::vector<std::string> paths;
  for (const auto& [path, value] : values_)
    if (below(path, table)) paths.push_back(path);
  return paths;
}

DefinitionFile::Value& DefinitionFile::find(const std::string& path) {
  const auto found = values_.find(path);
  if (found == values_.end()) {
    // A misspelt key is the likeliest cause. It is among the keys that were not read yet.
    std::vector<std::string> open;
    for (const auto& [other, value] : values_)
      if (!value.known) open.push_back(other);
    const std::string near = nearest_name(path, open);
    if (!near.empty()) fail(near, fmt::format("is an unknown key, and '{}' is missing", path), "correct its name");
    fail(path, "is missing", "add this key");
  }
  found->second.known = true;
  return found->second;
}

double DefinitionFile::number(const std::string& path, const std::string& unit, Range range) {
  const Value& value = find(path);
  const double result = parse_quantity(value.text, unit, {file_, value.line, path});
  if (!(result >= range.lower && result <= range.upper))
    fail(path,
         fmt::format("is {}, expected a value from {:g} to {:g}{}", value.text, range.lower, range.upper,
                     unit.empty() ? "" : " " + unit),
         "correct the value or its unit");
  return result;
}

int DefinitionFile::integer(const std::string& path, int lower, int upper) {
  const double value = number(path, "", {static_cast<double>(lower), static_cast<double>(upper)});
  if (value != std::floor(value))
    fail(path, fmt::format("is {:g}, expected a whole number", value), "give a number without a fraction");
  return static_cast<int>(value);
}

std::string DefinitionFile::text(const std::string& path) {
  const Value& value = find(path);
  if (!value.is_text) fail(path, "is the number " + value.text + ", expected a text", "put it between quotes");
  return value.text;
}

std::string DefinitionFile::choice(const std::string& path, const std::vector<std::string>& allowed) {
  const std::string value = text(path);
  if (!contains(allowed, value))
    fail(path,
         "is '" + value + "', expected one of " + fmt::format("{}", fmt::join(allowed, ", ")) + did_you_mean(value, allowed),
         "choose one of these");
  return value;
}

std::vector<std::string> DefinitionFile::texts(const std::string& path) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < size(path); ++i) out.push_back(text(path + "." + std::to_string(i)));
  return out;
}

std::vector<double> DefinitionFile::numbers(const std::string& path, const std::string& unit, Range range) {
  std::vector<double> out;
  for (std::size_t i = 0; i < size(path); ++i) out.push_back(number(path + "." + std::to_string(i), unit, range));
  return out;
}

std::map<std::string, double> DefinitionFile::numbers_below(const std::string& table) {
  constexpr double any = std::numeric_limits<double>::infinity();
  std::map<std::string, double> out;
  for (const std::string& path : paths_below(table)) out[path.substr(table.size() + 1)] = number(path, "", {-any, any});
  return out;
}

bool DefinitionFile::has(const std::string& path) const {
  return values_.contains(path) || std::ranges::any_of(values_, [&](const auto& entry) { return below(entry.first, path); });
}

std::vector<std::string> DefinitionFile::names_below(const std::string& path) const {
  std::set<std::string> names;
  const std::size_t begin = path.size() + 1;
  for (const auto& [other, value] : values_)
    if (below(other, path)) names.insert(other.substr(begin, other.find('.', begin) - begin));
  return {names.begin(), names.end()};
}

std::size_t DefinitionFile::size(const std::string& path) const {
  std::size_t count = 0;
  while (has(path + "." + std::to_string(count))) ++count;
  return count;
}

void DefinitionFile::check_overrides(const std::string& table) {
  std::vector<std::string> bridge;
  for (const auto& [path, value] : values_)
    if (!path.starts_with("change.") && !path.starts_with("variant")) bridge.push_back(path);
  for (const std::string& key : paths_below(table)) {
    if (const std::string target = key.substr(table.size() + 1); !contains(bridge, target))
      fail(key, "overrides '" + target + "', which this file does not have" + did_you_mean(target, bridge),
           "name a key by its dotted path, for example \"mast.infill_z\"");
    values_.at(key).known = true;
  }
}

void DefinitionFile::apply(const std::string& table) {
  check_overrides(table);
  for (const std::string& key : paths_below(table)) {
    Value& target = values_.at(key.substr(table.size() + 1));
    const bool known = target.known;
    target = values_.at(key);
    target.known = known;
  }
}

void DefinitionFile::set_number(const std::string& path, double value) {
  const auto found = values_.find(path);
  if (found == values_.end()) {
    const auto known = each_of(values_, [](const auto& entry) { return entry.first; });
    fail(path, "is not in this file" + did_you_mean(path, known), "name a key by its dotted path");
  }
  found->second.text = io::toml_number(value);
  found->second.is_text = false;
}

void DefinitionFile::offer_number(const std::string& path, double value) {
  if (!has(path)) values_[path].text = io::toml_number(value);
}

long DefinitionFile::line_of(const std::string& path) const {
  const auto found =
      std::ranges::find_if(values_, [&](const auto& entry) { return entry.first == path || below(entry.first, path); });
  return found == values_.end() ? 0 : found->second.line;
}

void DefinitionFile::refuse_unknown() const {
  std::set<std::string> known;
  for (const auto& [path, value] : values_)
    if (value.known) known.insert(without_positions(path));
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [path, value] : values_)
    if (!value.known)
      fail(path, "is an unknown key" + did_you_mean(without_positions(path), names), "remove it or correct its name");
}

}  // namespace twindeck::ponte
