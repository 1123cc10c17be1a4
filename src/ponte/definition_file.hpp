#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace twindeck::ponte {

/// bridge.toml as a flat list of values by dotted path ("deck.foot.radius", "damper.0.units.1.s"; lists count from 0).
///
/// An override (of a change or a variant) replaces the value of a path that exists. It cannot add a key. Each value keeps its
/// line, so that a message names the line after an override too. Each value also keeps whether it was read: a value that was
/// never read has an unknown key.
class DefinitionFile {
 public:
  /// Interval of admissible values [in the unit asked for].
  struct Range {
    double lower, upper;
  };

  /// @throws InputError for a file that is missing or is no TOML (file, line)
  static DefinitionFile load(const std::filesystem::path& file);

  /// The value in `unit`. @throws InputError if it is missing, no number, of another dimension, or out of `range`
  [[nodiscard]] double number(const std::string& path, const std::string& unit, Range range);
  [[nodiscard]] int integer(const std::string& path, int lower, int upper);
  [[nodiscard]] std::string text(const std::string& path);
  /// A text that must be one of `allowed`; the message names the nearest.
  [[nodiscard]] std::string choice(const std::string& path, const std::vector<std::string>& allowed);
  [[nodiscard]] std::vector<std::string> texts(const std::string& path);
  [[nodiscard]] std::vector<double> numbers(const std::string& path, const std::string& unit, Range range);

  /// The numbers below a table by their paths in it: "deck.foot.radius" where `table` has that key.
  [[nodiscard]] std::map<std::string, double> numbers_below(const std::string& table);

  /// True if the path is a value, a list or a table.
  [[nodiscard]] bool has(const std::string& path) const;
  /// Names below a table, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names_below(const std::string& path) const;
  /// Length of a list (0 if it is not there).
  [[nodiscard]] std::size_t size(const std::string& path) const;

  /// Checks the overrides of a table ("change.0.set"), whose keys are dotted paths of this file.
  /// @throws InputError for a path that is not there, naming the nearest
  void check_overrides(const std::string& table);
  /// Applies the overrides of a table.
  void apply(const std::string& table);
  /// Puts a number [SI] in the place of a value that is there.
  /// @throws InputError for a path that is not there, naming the nearest
  void set_number(const std::string& path, double value);
  /// A number for a key that the file leaves out; one that is there stays.
  void offer_number(const std::string& path, double value);
  /// Line of a value, or of a list's or table's first one by name; 0 if it is not there.
  [[nodiscard]] long line_of(const std::string& path) const;
  /// @throws InputError for the first value that was never read, naming the nearest known path
  void refuse_unknown() const;

  /// An InputError that names file, line and path.
  [[noreturn]] void fail(const std::string& path, const std::string& problem, const std::string& mend = "") const;
  [[nodiscard]] const std::string& name() const { return file_; }

 private:
  struct Value {
    std::string text;  // of a string, or digits of a number
    bool is_text = false;
    long line = 0;
    bool known = false;
  };
  Value& find(const std::string& path);
  [[nodiscard]] std::vector<std::string> paths_below(const std::string& table) const;

  std::string file_;
  std::map<std::string, Value> values_;
  friend struct Flattener;
};

}  // namespace twindeck::ponte
