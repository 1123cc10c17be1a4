#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/letters.hpp"

/// Inside of the library: what the cards of every dialect are, fields of text that stand at a place of a file.
namespace twindeck::model_io {

/// Without the blanks at both ends, and without the carriage return of another system's line.
[[nodiscard]] std::string trimmed(const std::string& text);
/// True for a whole number of at most 17 digits, with or without a sign, without a point.
[[nodiscard]] bool is_whole_number(const std::string& field);
/// `text` cut at each `separator`, the parts trimmed.
[[nodiscard]] std::vector<std::string> split_at(const std::string& text, char separator);

/// A table of words that stand for the same, a row each, as a map by word.
template <class What>
[[nodiscard]] std::map<std::string, What> by_word(std::initializer_list<std::pair<What, std::vector<const char*>>> rows) {
  std::map<std::string, What> by;
  for (const auto& [what, words] : rows)
    for (const char* word : words) by.emplace(word, what);
  return by;
}

/// Where something of a deck stands.
struct DeckPlace {
  const std::filesystem::path* file = nullptr;
  long line = 0;      ///< 1-based; 0: the file as a whole
  std::string label;  ///< what messages call it: "*NODE", "GRID 7", "NBLOCK"

  /// @throws InputError that names file, line and label
  [[noreturn]] void fail(const std::string& problem, const std::string& mend = "") const;
};

/// The file that a line of a deck includes: beside the file of that line, or beside the deck.
/// @param open  files being read, the deck first, by their canonical paths
/// @throws InputError  if it is not there, not below the folder of the deck, or being read already
[[nodiscard]] std::filesystem::path included_file(const DeckPlace& at, const std::filesystem::path& from,
                                                  const std::string& name, const std::vector<std::filesystem::path>& open);

/// How a dialect writes and counts fields.
struct DeckDialect {
  std::size_t first_field = 1;               ///< number of the first field in the dialect's manual
  std::size_t fields_a_line = 0;             ///< 0: fields are counted through the whole card
  bool reals_have_points = false;            ///< a whole number is digits alone
  const char* mend = "check the data line";  ///< of a field that is no number
};

/// Fields of a card or of one line of it. Blank and missing fields are alike. A number is read as Fortran reads it: 1.5D3 and
/// 1.5+3 are 1.5e3; where there are parameters, as an expression of them.
struct DeckFields : DeckPlace {
  std::vector<std::string> fields;
  const DeckDialect* dialect = nullptr;                       ///< null: counted from 1
  const std::map<std::string, double>* parameters = nullptr;  ///< values of names, in upper case; null: fields hold no names
  std::ptrdiff_t taken = 0;                                   ///< fields that were before these: messages count them

  /// Field `i` (from 0), "" where it is missing.
  [[nodiscard]] std::string text(std::size_t i) const { return i < fields.size() ? fields[i] : ""; }
  /// The same in upper case.
  [[nodiscard]] std::string word(std::size_t i) const { return upper_case(text(i)); }
  [[nodiscard]] bool blank(std::size_t i) const { return i >= fields.size() || fields[i].empty(); }
  /// Takes the first fields away.
  void drop(std::size_t count) {
    fields.erase(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(std::min(count, fields.size())));
    taken += static_cast<std::ptrdiff_t>(count);
  }
  /// Number of fields up to the last one that is not blank.
  [[nodiscard]] std::size_t size() const;

  /// @throws InputError for a field that is no finite number, or beyond core's largest_number
  [[nodiscard]] double number_or(std::size_t i, double fallback) const;
  [[nodiscard]] double number(std::size_t i) const;
  [[nodiscard]] long integer_or(std::size_t i, long fallback) const;
  [[nodiscard]] long integer(std::size_t i) const;
  /// Three numbers from field `i` on; a blank one is 0.
  [[nodiscard]] Eigen::Vector3d vector(std::size_t i) const;
  /// Degree of freedom 1-6 as 0-5.
  [[nodiscard]] int component(std::size_t i) const;

 private:
  [[nodiscard]] std::string place_of_field(std::size_t i) const;
};

/// Scalar parameters of a deck, by name in upper case.
using Parameters = std::map<std::string, double>;

/// Value of a field: a number (1.5, 4E9, 1.E-002, 2D3), a parameter, or arithmetic of both with + - * / ** and brackets, in the
/// usual precedence. None for everything else: text, functions, arrays, unknown parameters, values that are not finite.
[[nodiscard]] std::optional<double> evaluate(const std::string& text, const Parameters& parameters);

}  // namespace twindeck::model_io
