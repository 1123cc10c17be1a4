#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace twindeck::model_io {

/// Names are compared in upper case.
[[nodiscard]] std::string upper_case(std::string text);
[[nodiscard]] std::string lower_case(std::string text);
/// Without the blanks at both ends, and without the carriage return of another system's line.
[[nodiscard]] std::string trimmed(const std::string& text);

/// One data line of a card: its comma-separated fields, and where it stands.
struct InpLine {
  long line = 0;  ///< 1-based
  std::vector<std::string> fields;
};

/// One card of an input file of CalculiX or Abaqus: `*KEYWORD, NAME=VALUE, FLAG` and the data lines below it.
///
/// The rules of the format that both programs share: case does not matter (keywords and names of parameters are kept in upper
/// case, values as written), `**` begins a comment, a card that ends with a comma goes on in the next line, fields are
/// separated by commas. The value of a parameter may stand in quotes. Data lines are kept apart: an element with many nodes may
/// take several.
struct InpCard {
  std::string keyword;  ///< "BEAM SECTION", without the star
  std::map<std::string, std::string> parameters;
  long line = 0;
  std::vector<InpLine> data;

  [[nodiscard]] bool has(const std::string& name) const { return parameters.contains(name); }
  /// Value of a parameter, or `fallback`.
  [[nodiscard]] std::string get(const std::string& name, const std::string& fallback = "") const;
};

/// The cards of a file in their order, with helpers that name the line of whatever is wrong.
class InpFile {
 public:
  /// @throws InputError  if it cannot be opened, or has data before the first card
  static InpFile read(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<InpCard>& cards() const { return cards_; }
  [[nodiscard]] const std::filesystem::path& path() const { return file_; }

  /// @throws InputError that names file, line and card
  [[noreturn]] void fail(const InpCard& card, long line, const std::string& problem, const std::string& mend = "") const;
  /// Value of a parameter that must be there.
  [[nodiscard]] std::string required(const InpCard& card, const std::string& parameter) const;
  /// @throws InputError for a parameter that is none of `known`, since it would change what the card means
  void allow(const InpCard& card, const std::vector<std::string>& known) const;
  /// Field `i` (from 0) as a number; `fallback` where it is empty or missing. Fortran's 1.5D3 is read as 1.5e3.
  [[nodiscard]] double number_or(const InpCard& card, const InpLine& line, std::size_t i, double fallback) const;
  [[nodiscard]] double number(const InpCard& card, const InpLine& line, std::size_t i) const;
  [[nodiscard]] long integer(const InpCard& card, const InpLine& line, std::size_t i) const;
  /// Degree of freedom 1-6 as 0-5.
  [[nodiscard]] int dof(const InpCard& card, const InpLine& line, std::size_t i) const;
  /// True if the field is a whole number: node or element rather than the name of a set.
  [[nodiscard]] static bool is_integer(const std::string& field);

 private:
  std::filesystem::path file_;
  std::vector<InpCard> cards_;
};

}  // namespace twindeck::model_io
