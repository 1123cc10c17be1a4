#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model_io/deck_card.hpp"

namespace twindeck::model_io::nastran {

/// One bulk data card: its name and the fields behind it, eight a line, continuations appended. Field 2 of the manual is
/// fields[0].
struct Card : DeckFields {
  std::string name;   ///< "CBAR", in upper case, without the star of the large field
  std::string stray;  ///< name of a continuation that is not the one its line above announces; "" = none
};

/// What a subcase chooses: LOAD, TEMPERATURE(LOAD), TEMPERATURE(INITIAL), STATSUB, DEFORM; with what stands above the subcases.
struct Subcase {
  long id = 0;  ///< 0: above the subcases
  std::map<std::string, long> chosen;
};

/// What the case control section chooses, as far as it changes the structure.
struct CaseControl {
  /// "K2GG = 0.5*KBUSH, KTIE" as its text, with its place.
  struct Matrices : DeckPlace {
    std::string text;
  };
  bool present = false;  ///< the file has a case control section
  std::string title;
  std::optional<long> spc, mpc, nsm;
  std::vector<Subcase> subcases;
  Matrices k2gg, m2gg;  ///< DMIG matrices that are added to stiffness and mass; an empty text: none
};

/// A deck as cards in their order.
///
/// Rules of the format: `$` begins a comment; a line with a comma is free field; otherwise fields are eight columns wide, or
/// sixteen where the first one ends with a star; tabs stand for the next multiple of eight columns; a line whose first field is
/// blank or begins with + or * continues the card above it. A number may leave out the E of its exponent ("3.0+7").
class Deck {
 public:
  /// @throws InputError  for a file that cannot be opened, an INCLUDE that leads in a circle, a deck without BEGIN BULK, a line
  ///         that the format does not know
  static Deck read(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<Card>& cards() const { return cards_; }
  [[nodiscard]] const CaseControl& case_control() const { return case_; }
  [[nodiscard]] const std::deque<std::filesystem::path>& files() const { return files_; }
  /// A part of the deck that no single line says.
  [[nodiscard]] DeckPlace whole(const std::string& label) const { return {&files_.front(), 0, label}; }

 private:
  std::deque<std::filesystem::path> files_;  ///< the deck first; cards point to them
  std::vector<Card> cards_;
  CaseControl case_;

  friend struct DeckReader;
};

}  // namespace twindeck::model_io::nastran
