#include "diagnosis/reduction/composite_groups.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace twindeck::diagnosis {

namespace {

constexpr std::size_t kMostParts = 6;  ///< most parts that may differ between names; with more, the names follow no scheme

/// A name, with a mark in place of each part, and its parts.
struct NameInParts {
  std::string form;
  std::vector<std::string> parts;
};

NameInParts in_parts(const std::string& name) {
  NameInParts out;
  char last = '\0';
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    const char kind = std::isdigit(u) != 0 ? '0' : std::isalpha(u) != 0 || u >= 0x80 ? 'a' : '\0';
    if (kind == '\0' || kind != last) out.form += kind == '\0' ? c : kind;
    if (kind != '\0' && kind != last) out.parts.emplace_back();
    if (kind != '\0') out.parts.back() += c;
    last = kind;
  }
  return out;
}

}  // namespace

std::vector<std::vector<std::string>> composite_groups(const std::vector<std::string>& names) {
  std::map<std::string, std::vector<std::pair<std::string, std::vector<std::string>>>> forms;
  for (const std::string& name : names) {
    NameInParts read = in_parts(name);
    forms[read.form].emplace_back(name, std::move(read.parts));
  }
  std::set<std::vector<std::string>> found;
  for (const auto& [form, members] : forms) {
    std::vector<std::size_t> vary;
    for (std::size_t k = 0; k < members.front().second.size(); ++k)
      for (const auto& [name, parts] : members)
        if (parts[k] != members.front().second[k]) {
          vary.push_back(k);
          break;
        }
    if (vary.size() > kMostParts) continue;
    for (std::size_t any = 1; any < (std::size_t{1} << vary.size()); ++any) {  // bits: parts that may differ
      std::map<std::vector<std::string>, std::vector<std::string>> alike;
      for (const auto& [name, parts] : members) {
        std::vector<std::string> kept = parts;
        for (std::size_t k = 0; k < vary.size(); ++k)
          if ((any >> k & 1U) != 0) kept[vary[k]].clear();
        const bool shares = std::ranges::any_of(kept, [](const std::string& part) { return !part.empty(); });
        if (shares) alike[kept].push_back(name);
      }
      for (auto& [kept, together] : alike)
        if (together.size() > 1) found.insert(std::move(together));
    }
  }
  return {found.begin(), found.end()};
}

}  // namespace twindeck::diagnosis
