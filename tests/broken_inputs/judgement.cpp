#include "broken_inputs/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "core/printable.hpp"

namespace twindeck::broken {
namespace {

namespace fs = std::filesystem;

/// Text of a foreign program for the test's own output: control bytes as \xHH, at most a thousand letters.
std::string shown(const std::string& text) {
  std::string safe;
  for (const char c : text.substr(0, 1000)) {
    const auto byte = static_cast<unsigned char>(c);
    safe += byte < 0x20 && c != '\n' ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return safe;
}

bool is_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t more = byte < 0x80                   ? 0
                             : byte >= 0xC2 && byte < 0xE0 ? 1
                             : byte >= 0xE0 && byte < 0xF0 ? 2
                             : byte >= 0xF0 && byte < 0xF5 ? 3
                                                           : 9;
    if (more == 9 || i + more >= text.size()) return false;
    for (std::size_t k = 1; k <= more; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
    }
    i += more + 1;
  }
  return true;
}

void judge_message(const Case& c, const Outcome& outcome, std::vector<std::string>& found) {
  const std::string& text = outcome.stderr_text;
  const auto lines = std::count(text.begin(), text.end(), '\n');
  if (lines != 1 || text.back() != '\n') found.push_back(fmt::format("stderr has {} lines, expected one", lines));
  if (!text.starts_with(c.step + ": ")) found.push_back("the message does not begin with the step's token");
  if (std::any_of(text.begin(), text.end(),
                  [](char b) { return (static_cast<unsigned char>(b) < 0x20 && b != '\n' && b != '\t') || b == 0x7f; }))
    found.push_back("the message holds control bytes");
  constexpr std::size_t longest =
      4000;  // [bytes] the longest list of known keys has about 2,000; a file's content has no place here
  if (text.size() > longest)
    found.push_back(fmt::format("the message has {} bytes, expected at most {}", text.size(), longest));
  if (!is_utf8(text)) found.push_back("the message holds bytes that are no UTF-8");
  if (!outcome.stdout_text.empty()) found.push_back("stdout holds text");
  for (const std::string& word : c.words) {
    if (text.find(word) == std::string::npos) found.push_back("the message lacks '" + shown(word) + "'");
  }
}

void judge_words_of_success(const Case& c, const Evidence& evidence, std::vector<std::string>& found) {
  for (const std::string& word : c.words) {
    bool there = evidence.outcome.stderr_text.find(word) != std::string::npos;
    if (c.quiet) {
      there = there || evidence.outcome.stdout_text.find(word) != std::string::npos;
      for (const auto& [path, text] : evidence.after)
        there = there || (path.starts_with(evidence.out + "/") && text.find(word) != std::string::npos);
    }
    if (!there)
      found.push_back((c.quiet ? "neither stdout nor a file of --out holds '" : "stderr lacks '") + shown(word) + "'");
  }
}

void judge_files(const Case& c, const Evidence& evidence, std::vector<std::string>& found) {
  const auto may_differ = [&](const std::string& path) {
    const bool results = path == evidence.out || path.starts_with(evidence.out + "/");
    if (c.exit == 0 || evidence.outcome.exit == 0)
      return results;  // a run that ended well where it should not is one fault, not ten
    return path.starts_with(evidence.out + ".unconverged") && (c.exit == 1 || evidence.outcome.exit == 1);
  };
  for (const auto& [path, text] : evidence.before) {
    if (may_differ(path)) continue;
    const auto now = evidence.after.find(path);
    if (now == evidence.after.end()) {
      found.push_back("is gone: " + path);
    } else if (now->second != text) {
      found.push_back("was changed: " + path);
    }
  }
  for (const auto& [path, text] : evidence.after) {
    if (!may_differ(path) && !evidence.before.contains(path)) found.push_back("was left behind: " + path);
  }
}

}  // namespace

Snapshot snapshot(const fs::path& folder) {
  Snapshot found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::string& text = found[fs::relative(entry.path().parent_path(), folder).lexically_normal().generic_string() + "/" +
                              entry.path().filename().string()];
    if (entry.is_symlink()) {
      text = "link to " + fs::read_symlink(entry.path()).string();
    } else if (entry.is_directory()) {
      text = "folder";
    } else if (!entry.is_regular_file()) {
      text = "no file";
    } else {
      std::ifstream in(entry.path(), std::ios::binary);
      text.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
  }
  return found;
}

std::vector<std::string> faults(const Case& c, const Evidence& evidence) {
  std::vector<std::string> found;
  const Outcome& outcome = evidence.outcome;
  if (!outcome.crash.empty()) {
    found.push_back(outcome.crash);
  } else if (outcome.exit != c.exit) {
    found.push_back(fmt::format("exit code {}, expected {}", outcome.exit, c.exit));
  } else if (c.exit == 0) {
    judge_words_of_success(c, evidence, found);
  } else {
    judge_message(c, outcome, found);
  }
  judge_files(c, evidence, found);
  constexpr std::size_t most = 4;  // faults that are told of one case
  if (found.size() > most) found.resize(most);
  if (!found.empty()) found.push_back("stderr: " + shown(outcome.stderr_text));
  return found;
}

std::string fault_of_check(const Outcome& checked, const Outcome& ran, bool only_computing_shows_it) {
  if (!checked.crash.empty()) return "--check: " + checked.crash;
  const bool refused = ran.exit == 2 && !only_computing_shows_it;
  if (checked.exit != (refused ? 2 : 0))
    return fmt::format("--check: exit code {}, the run has {}; --check says: {}", checked.exit, ran.exit,
                       shown(checked.stderr_text));
  if (refused && checked.stderr_text != ran.stderr_text)
    return fmt::format("--check says: {}, the run says: {}", shown(checked.stderr_text), shown(ran.stderr_text));
  return "";
}

std::vector<std::string> unrecorded(const std::string& step, const std::string& said, const std::string& manifest) {
  const auto json = nlohmann::json::parse(manifest);
  std::set<std::string> kept;
  for (const char* list : {"warnings", "notes"}) {
    for (const auto& line : json.at(list)) kept.insert(printable(line.get<std::string>()));
  }
  std::vector<std::string> missing;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    for (const std::string& before : {step + ": ", std::string("warning: ")}) {
      if (line.starts_with(before)) line.erase(0, before.size());
    }
    // Progress tells of the run: "reading records, 1 of 3", "working, 12 s so far".
    static const std::regex progress(", \\d+ of \\d+(, about \\d+ s left)?$|^working, \\d+ s so far$");
    if (std::regex_search(line, progress)) continue;
    const bool of_check = line.starts_with("  ") || line.starts_with("inputs are valid");
    if (!of_check && !kept.contains(line)) missing.push_back(line);
  }
  return missing;
}

}  // namespace twindeck::broken
