#pragma once

#include <map>
#include <string>
#include <vector>

/// Numbers, lists and ids in the words of a sentence.
namespace twindeck::diagnosis {

/// "34", "2.5": no more decimals than asked for, zeros at the end left out.
[[nodiscard]] std::string with_decimals(double value, int decimals);

/// Significant digits (three, since sizes are known to a per cent at best): "0.612", "434", "18,500", "5.4 million".
[[nodiscard]] std::string number_in_words(double value, int digits = 3);

/// The same with its unit, in thousands, millions or billions of it where engineers say so: "434 N", "5.4 MN/m", "18,500 kg",
/// "0.612" ("-" is no unit).
[[nodiscard]] std::string quantity_in_words(double value, const std::string& unit);

/// "A, B and C".
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

/// The text with a capital at its beginning.
[[nodiscard]] std::string capitalised(std::string text);

/// The text with a full stop at its end; an empty text stays empty.
[[nodiscard]] std::string ended(std::string text);

/// Replaces the ids of causes and locations in texts by words: "support:pier_W" becomes "the support pier_W",
/// "brg@support:pier_W" becomes "support softer or stiffer than modelled at the support pier_W".
class IdsInWords {
 public:
  void add_location(const std::string& location, const std::string& words);
  /// @param place_words  empty if the cause concerns the whole structure
  void add_cause(const std::string& id, const std::string& title, const std::string& place_words);
  /// The text with words in place of every added id. Of ids with the same beginning, the longest is replaced. A part of a
  /// longer name is kept.
  [[nodiscard]] std::string in_text(const std::string& text) const;

 private:
  std::map<std::string, std::string> words_;  ///< by id
};

}  // namespace twindeck::diagnosis
