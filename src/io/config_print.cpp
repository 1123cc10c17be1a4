#include <fmt/format.h>

#include "io/config.hpp"
#include "io/config_field.hpp"

namespace twindeck::io {

std::vector<std::string> FieldTable::lines(const std::string& above) const {
  std::vector<std::string> lines;
  for (const auto& field : fields_) {  // values first: after a [[header]] a key would belong to that element
    if (field->add) continue;
    const std::string value = field->write();
    const bool readable = value.find("inf") == std::string::npos && value.find("nan") == std::string::npos;
    const bool commented =
        (!readable && !field->takes_text && field->type != "array of texts") || (field->required && !field->given);
    lines.push_back((commented ? "# " : "") + field->key + " = " + value + (field->unit.empty() ? "" : "  # " + field->unit));
  }
  for (const auto& field : fields_) {
    if (!field->add) continue;
    for (const auto& element : field->elements) {
      lines.push_back("");
      lines.push_back("[[" + above + field->key + "]]");
      for (std::string line : element) {
        if (line.starts_with("[[")) line = "[[" + above + field->key + "." + line.substr(2);
        lines.push_back(line);
      }
    }
  }
  return lines;
}

std::string FieldTable::print() const {
  std::string text;
  for (const std::string& line : lines()) text += line + "\n";
  return text;
}

std::string FieldTable::describe(const std::string& key) const {
  std::string text;
  std::vector<std::string> known;
  for (const auto& field : fields_) {
    known.push_back(field->key);
    if (!key.empty() && field->key != key && !key.starts_with(field->key + ".")) continue;
    if (field->add && key.starts_with(field->key + ".")) return field->add().describe(key.substr(field->key.size() + 1));
    if (field->key != key && !key.empty()) continue;
    text += field->key + ": " + field->meaning + "\n    " + field->type;
    if (!field->unit.empty()) text += fmt::format(" [{}]", field->unit);
    if (!field->allowed.empty()) text += ", " + field->allowed;
    if (field->add) {
      text += "; each element has\n";
      const std::string inner = field->add().describe();
      for (std::size_t at = 0; at < inner.size();) {
        const std::size_t end = inner.find('\n', at);
        text += "    " + inner.substr(at, end - at) + "\n";
        at = end + 1;
      }
      continue;
    }
    text += field->required ? ", required\n" : ", default " + field->default_value + "\n";
  }
  if (text.empty() && !key.empty()) refuse_unknown_key("--describe", 0, "", key, known);
  return text;
}

}  // namespace twindeck::io
