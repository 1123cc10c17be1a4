#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace twindeck::model_io::nastran {

/// One bulk data card: its name and the fields behind it, eight a line, continuations appended. Blank fields are empty.
struct Card {
  std::string name;                 ///< "CBAR", in upper case, without the star of the large field
  std::vector<std::string> fields;  ///< field 2 of the manual is fields[0]
  int file = 0;                     ///< position in Deck::files
  long line = 0;                    ///< 1-based, of its first line
  std::string stray;                ///< name of a continuation that is not the one its line above announces; "" = none
};

/// What a subcase chooses: LOAD, TEMPERATURE(LOAD), TEMPERATURE(INITIAL), STATSUB, DEFORM; with what stands above the subcases.
struct Subcase {
  long id = 0;  ///< 0: above the subcases
  std::map<std::string, long> chosen;
};

/// What the case control section chooses, as far as it changes the structure.
struct CaseControl {
  /// "K2GG = 0.5*KBUSH, KTIE" as its text, with its place.
  struct Matrices {
    std::string text;
    int file = 0;
    long line = 0;
  };
  bool present = false;  ///< the file has a case control section
  std::string title;
  std::optional<long> spc, mpc;
  std::vector<Subcase> subcases;
  Matrices k2gg, m2gg;  ///< DMIG matrices that are added to stiffness and mass; an empty text: none
};

/// A deck as cards in their order, with helpers that name the place of whatever is wrong.
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
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

  /// @throws InputError that names file, line and card
  [[noreturn]] void fail(const Card& card, const std::string& problem, const std::string& mend = "") const;
  /// Field `i` (from 0) as text; empty where it is blank or missing.
  [[nodiscard]] static std::string text(const Card& card, std::size_t i);
  [[nodiscard]] static bool blank(const Card& card, std::size_t i) { return text(card, i).empty(); }
  [[nodiscard]] double number(const Card& card, std::size_t i) const;
  [[nodiscard]] double number_or(const Card& card, std::size_t i, double fallback) const;
  /// Three numbers from field `i` on; a blank one is 0.
  [[nodiscard]] Eigen::Vector3d vector(const Card& card, std::size_t i) const {
    return {number_or(card, i, 0.0), number_or(card, i + 1, 0.0), number_or(card, i + 2, 0.0)};
  }
  [[nodiscard]] long integer(const Card& card, std::size_t i) const;
  [[nodiscard]] long integer_or(const Card& card, std::size_t i, long fallback) const;
  /// Number of fields up to the last one that is not blank.
  [[nodiscard]] static std::size_t size(const Card& card);
  /// True for a whole number without a point.
  [[nodiscard]] static bool is_integer(const std::string& field);

 private:
  std::vector<std::filesystem::path> files_;
  std::vector<Card> cards_;
  CaseControl case_;

  friend struct DeckReader;
};

}  // namespace twindeck::model_io::nastran
