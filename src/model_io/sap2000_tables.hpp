#pragma once

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "model_io/deck_card.hpp"

/// Inside of the library: the text tables that SAP2000 exports, as rows of keys and values.
namespace twindeck::model_io {

/// One row: `Joint=1   XorR=0   Y=0`. Keys are compared in upper case, values stand as written, without their quotes.
struct SapRow : DeckFields {
  std::vector<std::string> keys;

  [[nodiscard]] bool has(const std::string& key) const { return position(key) < keys.size(); }
  /// Value of a key, or `fallback`.
  [[nodiscard]] std::string get(const std::string& key, const std::string& fallback = "") const {
    return has(key) ? fields[position(key)] : fallback;
  }
  /// Value of a key that must be there.
  [[nodiscard]] std::string required(const std::string& key) const {
    if (blank(position(key))) fail("has no " + key, "complete the row");
    return fields[position(key)];
  }
  [[nodiscard]] double number_of(const std::string& key) const {
    (void)required(key);
    return number(position(key));
  }
  [[nodiscard]] double number_of(const std::string& key, double fallback) const { return number_or(position(key), fallback); }
  [[nodiscard]] bool yes(const std::string& key) const { return word(position(key)) == "YES"; }
  /// Whether an assignment says what holds without it: factors of 1 (keys ...Mod, f11 ... v23), offsets of 0, the centroid.
  [[nodiscard]] bool is_neutral() const;

 private:
  [[nodiscard]] std::size_t position(const std::string& key) const {
    return static_cast<std::size_t>(std::ranges::find(keys, upper_case(key)) - keys.begin());
  }
};

/// The rules of the format: `TABLE:  "NAME"` opens a table, each line is a row, a line that ends with ` _` goes on in the next.
class SapTables {
 public:
  /// @throws InputError  if it cannot be opened, or a row stands above the first table
  explicit SapTables(const std::filesystem::path& file);

  /// Rows of a table; none for one that the file does not have.
  [[nodiscard]] const std::vector<SapRow>& rows(const std::string& table) const {
    static const std::vector<SapRow> none;
    const auto found = tables_.find(table);
    return found == tables_.end() ? none : found->second;
  }
  [[nodiscard]] const std::map<std::string, std::vector<SapRow>>& all() const { return tables_; }
  [[nodiscard]] DeckPlace whole(const std::string& table) const { return {&files_.front(), 0, table}; }

 private:
  std::deque<std::filesystem::path> files_;  ///< the file; rows point to it
  std::map<std::string, std::vector<SapRow>> tables_;
};

}  // namespace twindeck::model_io
