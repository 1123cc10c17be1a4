#include "model_io/ansys_commands.hpp"

#include <algorithm>
#include <cctype>

#include "core/error.hpp"
#include "io/text_lines.hpp"

namespace twindeck::model_io::ansys {
namespace {

constexpr DeckDialect ansys_fields = {1, 0, false,
                                      "write the number: of parameters only those set to plain arithmetic are known, no "
                                      "functions, arrays or *GET"},
                      cells_of_block = {1, 0, false, "compare the line with the format of its block"};

/// Position of the first `sign` outside of quotes (and brackets, if asked for); the end if there is none.
std::size_t find_outside(const std::string& text, char sign, bool brackets_hold, std::size_t from = 0) {
  bool quoted = false;
  int depth = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == '\'') quoted = !quoted;
    if (quoted) continue;
    if (text[i] == sign && (depth == 0 || !brackets_hold)) return i;
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && depth > 0) --depth;
  }
  return text.size();
}

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// `NAME = value`, `NAME(1,2) = value`.
bool to_assignment(const std::string& text, Command& command) {
  const std::size_t equals = find_outside(text, '=', true);
  if (equals == text.size() || equals == 0) return false;
  const std::string name = trimmed(text.substr(0, equals));
  const std::size_t plain = static_cast<std::size_t>(std::ranges::find_if_not(name, is_name) - name.begin());
  if (plain == 0 || (plain < name.size() && name[plain] != '(')) return false;
  command.key = "=";
  command.label = command.name = name;
  command.fields = {name, trimmed(text.substr(equals + 1))};
  return true;
}

Command to_command(const std::string& text, const std::filesystem::path* file, long line) {
  constexpr std::size_t letters = 4, longest_name = 12;  // that tell commands apart; of which messages say no more
  Command command;
  command.file = file;
  command.line = line;
  command.dialect = &ansys_fields;
  if (to_assignment(text, command)) return command;
  const std::size_t end = std::min(text.find_first_of(", \t"), text.size());
  command.name = text.substr(0, end);
  command.label = command.name.substr(0, longest_name);
  const bool marked = command.name.starts_with('/') || command.name.starts_with('*');
  command.key = upper_case(command.name).substr(0, letters + (marked ? 1 : 0));
  std::size_t start = std::min(text.find_first_not_of(" \t", end), text.size());
  if (start < text.size() && text[start] == ',') ++start;
  command.rest = trimmed(text.substr(start));
  command.fields = split_fields(command.rest, ',');
  return command;
}

/// A count in front of a letter, or a width behind it.
std::size_t leading_number(const std::string& text, std::size_t& at) {
  constexpr std::size_t largest = 1000;  // of counts and widths: a line has some 200 columns
  std::size_t value = 0;
  while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0)
    value = std::min(largest, 10 * value + static_cast<std::size_t>(text[at++] - '0'));
  return value;
}

}  // namespace

std::vector<std::string> split_fields(const std::string& text, char separator) {
  std::vector<std::string> fields;
  for (std::size_t start = 0, end = 0; start <= text.size(); start = end + 1) {
    end = find_outside(text, separator, true, start);
    fields.push_back(trimmed(text.substr(start, end - start)));
  }
  return fields;
}

std::vector<Command> split_commands(const std::string& text, const std::filesystem::path* file, long line) {
  const std::string whole = trimmed(text);
  const std::string head = upper_case(whole.substr(0, 4));
  if (whole.empty() || head == "C***" || head == "/COM" || whole.starts_with('!')) return {};
  if (head == "/TIT") return {to_command(trimmed(whole.substr(0, whole.find('!'))), file, line)};
  std::vector<Command> commands;
  const std::string spoken = whole.substr(0, find_outside(whole, '!', false));
  for (std::size_t start = 0; start <= spoken.size();) {
    const std::size_t end = find_outside(spoken, '$', false, start);
    if (const std::string part = trimmed(spoken.substr(start, end - start)); !part.empty())
      commands.push_back(to_command(part, file, line));
    start = end + 1;
  }
  return commands;
}

Deck::Deck(const std::filesystem::path& file, const std::map<std::string, double>& parameters)
    : file_(file), parameters_(parameters) {
  io::TextLines stream(file, io::longest_text);
  if (!stream.opened())
    throw InputError({file.string(), 0, ""}, "cannot be opened", "give the path of an archive or deck of ANSYS");
  for (std::string text; stream.next(text);) lines_.push_back(text);
}

bool Deck::next(Command& command) {
  while (pending_.empty()) {
    if (at_ >= lines_.size()) return false;
    ++at_;
    for (Command& one : split_commands(lines_[at_ - 1], &file_, line())) pending_.push_back(std::move(one));
  }
  command = std::move(pending_.front());
  command.parameters = &parameters_;
  pending_.pop_front();
  return true;
}

bool Deck::next_line(std::string& text) {
  if (at_ >= lines_.size()) return false;
  text = lines_[at_++];
  if (text.ends_with('\r')) text.pop_back();
  return true;
}

DeckFields Columns::cells(const DeckPlace& at, const std::string& text) const {
  DeckFields result{at, {}, &cells_of_block};
  std::size_t column = 0;
  for (std::size_t i = 0; i < integers + reals && column < text.size(); ++i) {
    const std::size_t width = i < integers ? integer_width : real_width;
    result.fields.push_back(trimmed(text.substr(column, width)));
    column += width;
  }
  return result;
}

bool parse_columns(const std::string& text, Columns& columns) {
  columns = {};
  const std::string format = trimmed(text);
  if (format.size() < 3 || format.front() != '(' || format.back() != ')') return false;
  for (const std::string& group : split_fields(format.substr(1, format.size() - 2), ',')) {
    std::size_t at = 0;
    const std::size_t count =
        group.empty() || std::isdigit(static_cast<unsigned char>(group[0])) == 0 ? 1 : leading_number(group, at);
    const char letter = at < group.size() ? static_cast<char>(std::tolower(static_cast<unsigned char>(group[at]))) : ' ';
    ++at;
    const std::size_t width = leading_number(group, at);
    if (width == 0 || count == 0) return false;
    if (letter == 'i' && columns.integers == 0 && columns.reals == 0) {
      columns.integers = count;
      columns.integer_width = width;
    } else if ((letter == 'e' || letter == 'g' || letter == 'f' || letter == 'a') && columns.reals == 0) {
      columns.reals = count;
      columns.real_width = width;
    } else {
      return false;
    }
  }
  return true;
}

}  // namespace twindeck::model_io::ansys
