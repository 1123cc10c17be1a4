#include "broken_inputs/case_table.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <stdexcept>

namespace twindeck::broken {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& where, const std::string& problem) {
  throw std::runtime_error(where + ": " + problem);
}

/// A text, or an array of texts.
std::vector<std::string> texts(const toml::node& node, const std::string& where) {
  if (const auto* one = node.as_string()) return {one->get()};
  std::vector<std::string> list;
  if (!node.is_array()) refuse(where, "expected a text or an array of texts");
  for (const toml::node& item : *node.as_array()) {
    if (!item.is_string()) refuse(where, "expected texts");
    list.push_back(item.as_string()->get());
  }
  return list;
}

bool flag(const toml::node& node, const std::string& where) {
  if (!node.is_boolean()) refuse(where, "expected true or false");
  return node.as_boolean()->get();
}

/// Enters one key of the file or of a case.
void enter(Case& c, const std::string& key, const toml::node& node, const std::string& where) {
  if (key == "step" || key == "base") {
    if (!node.is_string()) refuse(where, key + " must be a text");
    (key == "step" ? c.step : c.base) = node.as_string()->get();
  } else if (key == "change") {
    for (const std::string& change : texts(node, where)) c.changes.push_back(change);
  } else if (key == "arguments") {
    c.arguments = split_words(texts(node, where).at(0));
  } else if (key == "options") {  // beside the file's arguments
    for (const std::string& word : split_words(texts(node, where).at(0))) c.arguments.push_back(word);
  } else if (key == "exit") {
    if (!node.is_integer()) refuse(where, "exit must be a whole number");
    c.exit = static_cast<int>(node.as_integer()->get());
  } else if (key == "words") {
    c.words = texts(node, where);
  } else if (key == "quiet") {
    c.quiet = flag(node, where);
  } else if (key == "program") {
    c.program = flag(node, where);
  } else if (key == "own_out") {
    c.own_out = flag(node, where);
  } else {
    refuse(where, "unknown key '" + key + "'");
  }
}

}  // namespace

std::vector<std::string> split_words(const std::string& text) {
  std::vector<std::string> words;
  bool open = false, quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      if (!open) words.emplace_back();
      open = true;
      quoted = !quoted;
    } else if (!quoted && c == ' ') {
      open = false;
    } else {
      if (!open) words.emplace_back();
      open = true;
      if (!quoted || c != '\\') {
        words.back() += c;
        continue;
      }
      const char escape = ++i < text.size() ? text[i] : '\0';
      static const std::string from = "ntr\\\"", to = "\n\t\r\\\"";
      if (const auto at = from.find(escape); escape != '\0' && at != std::string::npos) {
        words.back() += to[at];
      } else if (escape == 'x' && i + 2 < text.size()) {
        words.back() += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
        i += 2;
      } else {
        refuse(text, "unknown escape in a quoted word");
      }
    }
  }
  if (quoted) refuse(text, "a quote is not closed");
  return words;
}

std::vector<Case> read_cases(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Case> cases;
  for (const fs::path& file : files) {
    const toml::table root = toml::parse_file(file.string());
    Case shared;
    for (const auto& [key, node] : root) {
      if (key.str() != "cases") enter(shared, std::string(key.str()), node, file.string());
    }
    const toml::table* table = root["cases"].as_table();
    if (table == nullptr) refuse(file.string(), "has no table [cases]");
    for (const auto& [key, node] : *table) {
      Case c = shared;
      c.name = file.stem().string() + "." + std::string(key.str());
      const toml::table* entries = node.as_table();
      if (entries == nullptr) refuse(c.name, "is no table");
      for (const auto& [name, value] : *entries) enter(c, std::string(name.str()), value, c.name);
      if (c.step.empty() || c.base.empty()) refuse(c.name, "lacks step or base");
      if (c.exit != 0 && c.words.empty()) refuse(c.name, "lacks the words that its message must hold");
      cases.push_back(std::move(c));
    }
  }
  return cases;
}

}  // namespace twindeck::broken
