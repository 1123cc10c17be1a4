#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "model_io/deck_card.hpp"

namespace twindeck::model_io::ansys {

/// One command of a deck, `NAME,field,field`.
struct Command : DeckFields {
  std::string key;   ///< what decides which it is, in upper case: four letters, five with / or *; "=" assigns a parameter
  std::string name;  ///< as written; of "=" the fields are the parameter and its value
  std::string rest;  ///< all after the name, as it stands: of a title
};

/// A deck, command by command. The rules that it knows: case does not matter, `!` begins a comment, `$` separates commands on
/// one line, `C***` and /COM lines are comments, quotes and brackets keep commas and `$` together.
class Deck {
 public:
  /// @param parameters  that fields of commands may hold
  /// @throws InputError  if it cannot be opened
  Deck(const std::filesystem::path& file, const std::map<std::string, double>& parameters);
  Deck(const Deck&) = delete;  // commands point to its path
  Deck& operator=(const Deck&) = delete;

  /// The next command; false at the end of the file.
  bool next(Command& command);
  /// The next line as it stands, for the data of a block; false at the end of the file. `line()` is its number.
  bool next_line(std::string& text);
  [[nodiscard]] long line() const { return static_cast<long>(at_); }
  [[nodiscard]] const std::filesystem::path& path() const { return file_; }

 private:
  std::filesystem::path file_;
  const std::map<std::string, double>& parameters_;
  std::vector<std::string> lines_;
  std::size_t at_ = 0;
  std::deque<Command> pending_;
};

/// The commands of one line of a file.
[[nodiscard]] std::vector<Command> split_commands(const std::string& text, const std::filesystem::path* file, long line);
/// `text` cut at each `separator` outside of quotes and brackets, the parts trimmed.
[[nodiscard]] std::vector<std::string> split_fields(const std::string& text, char separator);

/// Fortran format of a block, "(3i9,6e21.13e3)": so many whole numbers, then so many reals (or texts, "19a9"), in columns.
struct Columns {
  std::size_t integers = 0, integer_width = 0, reals = 0, real_width = 0;
  /// Cells of a line, trimmed; those behind its end are left out.
  [[nodiscard]] DeckFields cells(const DeckPlace& at, const std::string& text) const;
};
/// @return false for what is no such format
[[nodiscard]] bool parse_columns(const std::string& text, Columns& columns);

}  // namespace twindeck::model_io::ansys
