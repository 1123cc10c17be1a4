#include "broken_inputs/change.hpp"

#include <sys/stat.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <stdexcept>
#include <vector>

#include "broken_inputs/case_table.hpp"
#include "broken_inputs/made_record.hpp"
#include "io/npy.hpp"
#include "npy_double.hpp"

namespace twindeck::broken {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void save(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  while (true) {
    const std::size_t end = text.find(separator, at);
    parts.push_back(text.substr(at, end - at));
    if (end == std::string::npos) return parts;
    at = end + 1;
  }
}

std::string joined(const std::vector<std::string>& parts, char separator) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : std::string(1, separator)) + parts[i];
  return text;
}

/// Lines of a file; a last line end gives no further line.
struct Lines {
  explicit Lines(const std::string& text) : list(parts_of(text, '\n')) {
    if (list.size() > 1 && list.back().empty()) list.pop_back();
  }
  [[nodiscard]] std::string text() const { return joined(list, '\n') + "\n"; }
  [[nodiscard]] std::string& at(const std::string& number) { return list.at(static_cast<std::size_t>(std::stol(number)) - 1); }
  std::vector<std::string> list;
};

std::size_t column_of(const Lines& lines, const std::string& name) {
  const auto columns = parts_of(lines.list.at(0), ',');
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == name) return i;
  }
  throw std::runtime_error("there is no column " + name);
}

std::string with_cell(const std::string& text, const std::string& row, const std::string& column, const std::string& value) {
  Lines lines(text);
  const std::size_t at = column_of(lines, column);
  const bool all = row == "*";
  const std::size_t first = all ? 1 : static_cast<std::size_t>(std::stol(row)), last = all ? lines.list.size() - 1 : first;
  for (std::size_t i = first; i <= last; ++i) {
    auto cells = parts_of(lines.list.at(i), ',');
    cells.at(at) = value;
    lines.list[i] = joined(cells, ',');
  }
  return lines.text();
}

std::string without_column(const std::string& text, const std::string& column) {
  Lines lines(text);
  const std::size_t at = column_of(lines, column);
  for (std::string& line : lines.list) {
    auto cells = parts_of(line, ',');
    cells.erase(cells.begin() + static_cast<long>(at));
    line = joined(cells, ',');
  }
  return lines.text();
}

std::string with_column(const std::string& text, const std::string& column, const std::string& value) {
  Lines lines(text);
  for (std::size_t i = 0; i < lines.list.size(); ++i) lines.list[i] += "," + (i == 0 ? column : value);
  return lines.text();
}

std::string with_header(const std::string& text, const std::string& column, const std::string& name) {
  Lines lines(text);
  auto columns = parts_of(lines.list.at(0), ',');
  columns.at(column_of(lines, column)) = name;
  lines.list[0] = joined(columns, ',');
  return lines.text();
}

std::string replaced(std::string text, const std::string& before, const std::string& after, bool all) {
  std::size_t at = text.find(before);
  if (at == std::string::npos) throw std::runtime_error("'" + before + "' does not stand there");
  do {
    text.replace(at, before.size(), after);
    at = text.find(before, at + after.size());
  } while (all && at != std::string::npos);
  return text;
}

std::size_t offset(const std::string& text, const std::string& number) {
  const long value = std::stol(number);
  return value < 0 ? text.size() - static_cast<std::size_t>(-value) : static_cast<std::size_t>(value);
}

std::string inserted(const std::string& text, const std::string& number, const std::string& line) {
  Lines lines(text);
  lines.list.insert(lines.list.begin() + (std::stol(number) - 1), line);
  return lines.text();
}

std::string without_line(const std::string& text, const std::string& number) {
  Lines lines(text);
  lines.list.erase(lines.list.begin() + (std::stol(number) - 1));
  return lines.text();
}

std::string with_line(const std::string& text, const std::string& number, const std::string& line) {
  Lines lines(text);
  lines.at(number) = line;
  return lines.text();
}

std::string overwritten(std::string text, const std::string& at, const std::string& bytes) {
  return text.replace(offset(text, at), bytes.size(), bytes);
}

std::string repeated(std::string text, const std::string& count, const std::string& bytes) {
  for (long i = std::stol(count); i > 0; --i) text += bytes;
  return text;
}

void make_covariance(const fs::path& file, const Words& w) {
  const auto n = static_cast<Eigen::Index>(std::stol(w[2]));
  const double deviation = std::stod(w[3]);
  io::write_npy(Eigen::MatrixXd::Identity(n, n) * (deviation * deviation), file);
}

void set_element(const fs::path& file, const Words& w) {
  Eigen::MatrixXd matrix = io::read_npy(file);
  matrix(std::stol(w[2]) - 1, std::stol(w[3]) - 1) = std::stod(w[4]);
  io::write_npy(matrix, file);
}

std::string in_utf16(const std::string& text) {
  std::string result = "\xFF\xFE";
  for (const char letter : text) (result += letter) += '\0';
  return result;
}

/// What changes a file's bytes; the words are the command's.
using Edit = std::function<std::string(const std::string& text, const Words& w)>;

const std::map<std::string, std::pair<std::size_t, Edit>>& edits() {
  static const std::map<std::string, std::pair<std::size_t, Edit>> known = {
      {"set", {5, [](const auto& t, const auto& w) { return with_cell(t, w[2], w[3], w[4]); }}},
      {"rename", {4, [](const auto& t, const auto& w) { return with_header(t, w[2], w[3]); }}},
      {"drop", {3, [](const auto& t, const auto& w) { return without_column(t, w[2]); }}},
      {"add", {4, [](const auto& t, const auto& w) { return with_column(t, w[2], w[3]); }}},
      {"line", {4, [](const auto& t, const auto& w) { return with_line(t, w[2], w[3]); }}},
      {"insert", {4, [](const auto& t, const auto& w) { return inserted(t, w[2], w[3]); }}},
      {"remove", {3, [](const auto& t, const auto& w) { return without_line(t, w[2]); }}},
      {"append", {3, [](const auto& t, const auto& w) { return t + w[2]; }}},
      {"repeat", {4, [](const auto& t, const auto& w) { return repeated(t, w[2], w[3]); }}},
      {"replace", {4, [](const auto& t, const auto& w) { return replaced(t, w[2], w[3], false); }}},
      {"replace_all", {4, [](const auto& t, const auto& w) { return replaced(t, w[2], w[3], true); }}},
      {"cut", {3, [](const auto& t, const auto& w) { return t.substr(0, offset(t, w[2])); }}},
      {"utf16", {2, [](const auto& t, const auto&) { return in_utf16(t); }}},
      {"bytes", {4, [](const auto& t, const auto& w) { return overwritten(t, w[2], w[3]); }}}};
  return known;
}

/// What makes, moves or removes a file.
using Make = std::function<void(const fs::path& folder, const fs::path& file, const Words& w)>;

const std::map<std::string, std::pair<std::size_t, Make>>& makers() {
  static const std::map<std::string, std::pair<std::size_t, Make>> known = {
      {"write", {3, [](const auto&, const auto& file, const auto& w) { save(file, w[2]); }}},
      {"delete",
       {2,
        [](const auto&, const auto& file, const auto&) {
          if (fs::remove_all(file) == 0) throw std::runtime_error(file.string() + " is not there");
        }}},
      {"folder",
       {2,
        [](const auto&, const auto& file, const auto&) {
          fs::remove_all(file);
          fs::create_directories(file);
        }}},
      {"link",
       {3,
        [](const auto&, const auto& file, const auto& w) {
          fs::remove_all(file);
          fs::create_symlink(w[2], file);
        }}},
      {"pipe",
       {2,
        [](const auto&, const auto& file, const auto&) {
          fs::remove_all(file);
          if (::mkfifo(file.c_str(), 0600) != 0) throw std::runtime_error("no pipe can be made");
        }}},
      {"copy",
       {3,
        [](const auto& folder, const auto& file, const auto& w) {
          fs::create_directories((folder / w[2]).parent_path());
          fs::copy(file, folder / w[2], fs::copy_options::recursive);
        }}},
      {"record", {3, [](const auto&, const auto& file, const auto& w) { write_sound_record(file, w[2]); }}},
      {"covariance", {4, [](const auto&, const auto& file, const auto& w) { make_covariance(file, w); }}},
      {"element", {5, [](const auto&, const auto& file, const auto& w) { set_element(file, w); }}}};
  return known;
}

}  // namespace

void apply_change(const fs::path& folder, const std::string& change) try {
  const Words words = split_words(change);
  const std::string command = words.empty() ? "" : words[0];
  const fs::path file = words.size() > 1 ? folder / words[1] : folder;
  const auto needs = [&](std::size_t count) {
    if (words.size() != count) throw std::runtime_error(command + " takes " + std::to_string(count - 1) + " words");
  };
  if (const auto edit = edits().find(command); edit != edits().end()) {
    needs(edit->second.first);
    const std::string before = content(file), after = edit->second.second(before, words);
    if (after == before) throw std::runtime_error("changes nothing");
    save(file, after);
    return;
  }
  const auto make = makers().find(command);
  if (make == makers().end()) throw std::runtime_error("unknown command '" + command + "'");
  needs(make->second.first);
  make->second.second(folder, file, words);
} catch (const std::exception& error) {
  throw std::runtime_error("'" + change + "': " + error.what());
}

}  // namespace twindeck::broken
