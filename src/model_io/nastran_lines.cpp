#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/error.hpp"
#include "io/text_lines.hpp"
#include "model_io/nastran_cards.hpp"

/// From the text of a deck and its INCLUDE files to cards: the part of Deck that knows columns.
namespace twindeck::model_io::nastran {

struct RawLine : DeckPlace {
  std::string text;
};

struct SplitLine {
  std::string first;              ///< name, or what marks a continuation
  std::vector<std::string> data;  ///< 8 fields, or 4 of the large form
  std::string last;               ///< name of the continuation that follows
};

namespace {

constexpr std::size_t most_lines = 20'000'000;  ///< of a deck with all its files, two gigabytes: more is a mistake

constexpr DeckDialect bulk_data = {2, 8, true, "check the columns of the card"};

/// The name of a card, of which messages say no more: what is read need not be a deck.
std::string short_name(const std::string& name) { return name.substr(0, 8); }

std::string without_comment(const std::string& text) { return text.substr(0, text.find('$')); }

std::string with_tabs_expanded(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\t')
      result.append(8 - result.size() % 8, ' ');
    else if (c != '\r')
      result += c;
  }
  return result;
}

/// Free field: commas part the fields. @return  false for more of them than a line holds
bool split_free(const std::string& text, SplitLine& line) {
  std::vector<std::string> parts = split_at(text, ',');
  line.first = parts[0];
  const std::size_t fields = line.first.ends_with('*') || line.first.starts_with('*') ? 4 : 8;
  while (parts.size() > fields + 2 && parts.back().empty()) parts.pop_back();
  if (parts.size() > fields + 2) return false;
  parts.resize(fields + 2);
  line.data.assign(parts.begin() + 1, parts.end() - 1);
  line.last = parts.back();
  return true;
}

void split_fixed(const std::string& text, SplitLine& line) {
  std::string columns = with_tabs_expanded(text);
  columns.resize(80, ' ');  // what stands beyond column 80 is no part of the card
  line.first = trimmed(columns.substr(0, 8));
  const bool large = line.first.ends_with('*') || line.first.starts_with('*');
  const std::size_t width = large ? 16 : 8;
  for (std::size_t at = 8; at < 72; at += width) line.data.push_back(trimmed(columns.substr(at, width)));
  line.last = trimmed(columns.substr(72, 8));
}

std::string continuation_name(const std::string& field) {
  return upper_case(trimmed(field.substr(std::min(field.find_first_not_of("+*"), field.size()))));
}

/// Case control commands of more than four letters that are looked at. Four letters of one are enough, as of every command.
constexpr std::array<const char*, 6> case_commands = {"TITLE", "ANALYSIS", "SUBCASE", "STATSUB", "DEFORM", "TEMPERATURE"};

/// "SPC = 3" as "SPC" and "3", "STAT(PRELOAD) = 1" as "STATSUB(PRELOAD)" and "1"; "SUBC 1" as "SUBCASE 1", with an empty value.
std::pair<std::string, std::string> key_and_value(const std::string& text) {
  const auto equals = text.find('=');
  std::string key = upper_case(trimmed(text.substr(0, equals)));
  const std::size_t letters = std::min(key.find_first_of(" (0123456789", 1), key.size());
  for (const std::string_view command : case_commands)
    if (letters >= 4 && command.starts_with(key.substr(0, letters))) {
      key = std::string(command) + key.substr(letters);
      break;
    }
  return {key, equals == std::string::npos ? "" : trimmed(text.substr(equals + 1))};
}

}  // namespace

struct DeckReader {
  Deck deck;
  std::vector<RawLine> lines;
  std::vector<std::filesystem::path> open;  ///< files being read, the deck first

  [[noreturn]] static void fail(const RawLine& at, const std::string& key, const std::string& problem,
                                const std::string& mend) {
    DeckPlace{at.file, at.line, short_name(key)}.fail(problem, mend);
  }

  /// The text of a file into `lines`, INCLUDE lines replaced by the lines of their files.
  void expand(const std::filesystem::path& path) {
    io::TextLines stream(path, io::longest_text);
    if (!std::filesystem::is_regular_file(path) || !stream.opened())
      throw InputError({path.string(), 0, ""}, "cannot be opened", "give the path of a Nastran deck");
    const std::filesystem::path* file = &deck.files_.emplace_back(path);
    open.push_back(std::filesystem::weakly_canonical(path));
    RawLine line{{file, 0, ""}, ""};
    while (stream.next(line.text)) {
      ++line.line;
      const std::string bare = trimmed(without_comment(line.text));
      if (bare.empty()) continue;
      if (lines.size() >= most_lines) fail(line, "", "the deck has more than 20 million lines", "check its INCLUDE lines");
      if (!upper_case(bare.substr(0, 8)).starts_with("INCLUDE") || bare.find('=') != std::string::npos) {
        lines.push_back({{file, line.line, ""}, without_comment(line.text)});
        continue;
      }
      const RawLine at = line;
      std::string name = trimmed(bare.substr(7));
      const char quote = name.empty() ? ' ' : name.front();
      if (quote == '\'' || quote == '"') {
        // A long path may go on over several lines, up to the closing quote.
        while (name.find(quote, 1) == std::string::npos && stream.next(line.text)) {
          ++line.line;
          name += trimmed(line.text);
        }
        const auto close = name.find(quote, 1);
        if (close == std::string::npos) fail(at, "INCLUDE", "the quote of the file's name is not closed", "close it");
        name = name.substr(1, close - 1);
      }
      expand(included_file({at.file, at.line, "INCLUDE"}, path, trimmed(name), open));
    }
    open.pop_back();
  }

  /// Executive and case control: only what changes the structure is looked at. @return  the first line of the bulk data
  std::size_t read_control() {
    const auto begins = [](const RawLine& line) { return upper_case(trimmed(line.text).substr(0, 5)) == "BEGIN"; };
    const auto named = [](const RawLine& line, const char* word) { return upper_case(trimmed(line.text)) == word; };
    const auto bulk = std::ranges::find_if(lines, begins);
    const auto cend = std::ranges::find_if(lines, [&](const RawLine& line) { return named(line, "CEND"); });
    if (bulk == lines.end()) {
      if (cend != lines.end()) fail(*cend, "CEND", "no BEGIN BULK follows", "the bulk data stand below a line BEGIN BULK");
      return 0;
    }
    deck.case_.present = true;
    for (auto line = cend < bulk ? cend + 1 : lines.begin(); line != bulk; ++line) read_case_line(*line);
    std::string rest = upper_case(trimmed(bulk->text).substr(5));
    std::erase(rest, ' ');
    if (rest != "BULK")
      fail(*bulk, "BEGIN", "starts a section of its own (a superelement), which is not read", "write one model");
    const auto second = std::find_if(bulk + 1, lines.end(), begins);
    if (second != lines.end()) fail(*second, "BEGIN", "starts a second section, which is not read", "write one model");
    return static_cast<std::size_t>(bulk - lines.begin()) + 1;
  }

  void read_case_line(const RawLine& line) {
    const auto [key, value] = key_and_value(line.text);
    if (key == "TITLE" && deck.case_.title.empty()) deck.case_.title = value;
    if (key == "K2GG" || key == "M2GG") return choose_matrices(line, key, value);
    if (key == "K2PP" || key == "M2PP")
      fail(line, key, "adds matrices to responses and complex modes alone, which is not read",
           "add them to the structure by K2GG or M2GG, or leave the line out");
    if (key == "NLIC" || (key == "ANALYSIS" && upper_case(value).starts_with("NLST")))
      fail(line, key, "starts the modes from a step of nonlinear statics, which is not read",
           "write a linear static subcase and STATSUB");
    if (key.starts_with("SUBCASE")) return open_subcase(line, trimmed(key.substr(7) + value));
    choose_loads(line, key, value);
    if (key != "SPC" && key != "MPC" && key != "NSM") return;
    if (!is_whole_number(value)) fail(line, key, fmt::format("chooses '{}', expected a number", value), "write SPC = 1");
    std::optional<long>& chosen = key == "SPC" ? deck.case_.spc : key == "MPC" ? deck.case_.mpc : deck.case_.nsm;
    const long id = std::stol(value);
    if (chosen && *chosen != id)
      fail(line, key, fmt::format("chooses set {}, another subcase chooses {}", id, *chosen), "leave one subcase in the deck");
    chosen = id;
  }

  void open_subcase(const RawLine& line, const std::string& number) {
    if (!is_whole_number(number)) fail(line, "SUBCASE", fmt::format("'{}' is no number", number), "write SUBCASE 1");
    Subcase subcase;
    if (!deck.case_.subcases.empty() && deck.case_.subcases.front().id == 0) subcase = deck.case_.subcases.front();
    subcase.id = std::stol(number);
    deck.case_.subcases.push_back(std::move(subcase));
  }

  /// LOAD, TEMPERATURE, STATSUB, DEFORM with their numbers, in the words of Subcase.
  void choose_loads(const RawLine& line, std::string key, const std::string& value) {
    std::erase(key, ' ');
    if (key.starts_with("TEMP") && key.find('(') != std::string::npos)
      key = key.find("(INIT") != std::string::npos ? "TEMPERATURE(INITIAL)" : "TEMPERATURE(LOAD)";
    std::vector<std::string> keys = {key};
    if (key.starts_with("TEMP") && key.find('(') == std::string::npos) keys = {"TEMPERATURE(LOAD)", "TEMPERATURE(INITIAL)"};
    if (key.starts_with("STATSUB")) keys = {"STATSUB"};
    const bool known = keys.front() == "LOAD" || keys.front() == "DEFORM" || keys.front() == "STATSUB" ||
                       keys.front().starts_with("TEMPERATURE(");
    if (!known || upper_case(value) == "NONE") return;
    if (!is_whole_number(value)) fail(line, key, fmt::format("chooses '{}', expected a number", value), "write LOAD = 1");
    if (deck.case_.subcases.empty()) deck.case_.subcases.emplace_back();
    for (const std::string& name : keys) deck.case_.subcases.back().chosen[name] = std::stol(value);
  }

  void choose_matrices(const RawLine& line, const std::string& key, const std::string& value) {
    CaseControl::Matrices& chosen = key == "K2GG" ? deck.case_.k2gg : deck.case_.m2gg;
    if (value.empty()) fail(line, key, "names no matrix", fmt::format("write {} = NAME", key));
    if (!chosen.text.empty() && chosen.text != upper_case(value))
      fail(line, key, fmt::format("chooses '{}', another subcase chooses '{}'", value, chosen.text),
           "leave one subcase in the deck");
    chosen = {{line.file, line.line, key}, upper_case(value)};
  }

  void read_bulk(std::size_t start) {
    std::string announced;
    for (std::size_t i = start; i < lines.size(); ++i) {
      const RawLine& raw = lines[i];
      if (upper_case(trimmed(raw.text).substr(0, 7)) == "ENDDATA") return;
      SplitLine line;
      if (raw.text.find(',') == std::string::npos)
        split_fixed(raw.text, line);
      else if (!split_free(trimmed(raw.text), line))
        fail(raw, line.first, "has more than ten fields on one line", "let the card go on in a line that begins with a comma");
      if (line.first.starts_with('='))
        fail(raw, line.first, "repeats the card above, which is not read", "write every card out");
      const bool continues = line.first.empty() || line.first.starts_with('+') || line.first.starts_with('*');
      if (continues)
        continue_card(raw, line, announced);
      else
        start_card(raw, line);
      announced = continuation_name(line.last);
    }
  }

  void start_card(const RawLine& raw, SplitLine& line) {
    Card card;
    card.name = upper_case(trimmed(line.first.substr(0, line.first.find('*'))));
    card.fields = std::move(line.data);
    static_cast<DeckPlace&>(card) = {raw.file, raw.line, short_name(card.name) + (card.blank(0) ? "" : " " + card.fields[0])};
    card.dialect = &bulk_data;
    deck.cards_.push_back(std::move(card));
  }

  void continue_card(const RawLine& raw, const SplitLine& line, const std::string& announced) {
    if (deck.cards_.empty())
      fail(raw, line.first, "continues a card, but none stands above it", "begin with the name of a card");
    Card& card = deck.cards_.back();
    const std::string name = continuation_name(line.first);
    if (!name.empty() && !announced.empty() && name != announced) card.stray = short_name(line.first);
    const std::size_t whole = line.data.size();  // a large line may begin in the middle of eight fields, a small one may not
    while (card.fields.size() % whole != 0) card.fields.emplace_back();
    card.fields.insert(card.fields.end(), line.data.begin(), line.data.end());
  }
};

Deck Deck::read(const std::filesystem::path& file) {
  DeckReader reader;
  reader.expand(file);
  reader.read_bulk(reader.read_control());
  return std::move(reader.deck);
}

}  // namespace twindeck::model_io::nastran
