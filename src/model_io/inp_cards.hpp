#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "model_io/deck_card.hpp"

namespace twindeck::model_io {

/// One data line of a card: its comma-separated fields, and where it stands.
using InpLine = DeckFields;

/// One card of an input file of CalculiX or Abaqus: `*KEYWORD, NAME=VALUE, FLAG` and the data lines below it.
///
/// The rules of the format that both programs share: case does not matter (keywords and names of parameters are kept in upper
/// case, values as written), `**` begins a comment, a card that ends with a comma goes on in the next line, fields are
/// separated by commas. The value of a parameter may stand in quotes. Data lines are kept apart: an element with many nodes may
/// take several.
struct InpCard : DeckPlace {
  std::string keyword;  ///< "BEAM SECTION", without the star
  std::map<std::string, std::string> parameters;
  std::vector<InpLine> data;

  [[nodiscard]] bool has(const std::string& name) const { return parameters.contains(name); }
  /// Value of a parameter, or `fallback`.
  [[nodiscard]] std::string get(const std::string& name, const std::string& fallback = "") const;
  /// Value of a parameter that must be there.
  [[nodiscard]] std::string required(const std::string& parameter) const;
  /// Value of a parameter as a line of one field.
  [[nodiscard]] InpLine value(const std::string& parameter) const { return {*this, {get(parameter)}}; }
  /// @throws InputError for a parameter that is none of `known`, since it would change what the card means
  void allow(const std::vector<std::string>& known) const;
  /// Data line `i`, which must be there and gives `what`.
  [[nodiscard]] const InpLine& line_of(std::size_t i, const char* what) const;
};

/// The cards of a file in their order.
class InpFile {
 public:
  /// The cards of a file, with those of the files that it includes in the place of *INCLUDE.
  /// @throws InputError  if it cannot be opened, or has data before the first card
  static InpFile read(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<InpCard>& cards() const { return cards_; }
  [[nodiscard]] const std::filesystem::path& path() const { return files_.front(); }
  [[nodiscard]] const std::deque<std::filesystem::path>& files() const { return files_; }
  /// What shows that Abaqus is meant and not CalculiX: a comment of Abaqus/CAE, or NAME on a *STEP, which CalculiX does not
  /// know. Empty where nothing does.
  [[nodiscard]] std::string sign_of_abaqus() const;

 private:
  /// @param open  files being read, the deck first
  void append(const std::filesystem::path& file, std::vector<std::filesystem::path>& open);

  std::deque<std::filesystem::path> files_;  ///< the deck first; cards point to them
  std::vector<InpCard> cards_;
  long generated_by_abaqus_ = 0;  ///< line of the comment that says so
};

}  // namespace twindeck::model_io
