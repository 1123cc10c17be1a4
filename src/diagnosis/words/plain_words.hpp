#pragma once

#include <map>
#include <string>
#include <vector>

/// Numbers, lists and ids as a sentence for people has them.
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

/// With a capital at its beginning.
[[nodiscard]] std::string capitalised(std::string text);

/// With a full stop at its end, where it has none; an empty text stays empty.
[[nodiscard]] std::string ended(std::string text);

/// Texts that name causes and locations by their ids, for people: "support:pier_W" becomes "the support pier_W",
/// "brg@support:pier_W" becomes "support softer or stiffer than modelled at the support pier_W".
class IdsInWords {
 public:
  void add_location(const std::string& location, const std::string& words);
  /// @param place_words  empty where the cause is of the whole structure
  void add_cause(const std::string& id, const std::string& title, const std::string& place_words);
  /// The text with every id that was added in words. Of ids that begin alike the longest is taken; a part of a longer name is
  /// left alone.
  [[nodiscard]] std::string in_text(const std::string& text) const;

 private:
  std::map<std::string, std::string> words_;  ///< by id
};

}  // namespace twindeck::diagnosis
