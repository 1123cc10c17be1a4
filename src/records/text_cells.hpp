#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_lines.hpp"

namespace twindeck::records {

/// Cells of a line, without blanks and quotes around them. A separator at the end opens an empty cell.
/// @param separator  ' ' for any run of blanks
[[nodiscard]] std::vector<std::string_view> cells_of(std::string_view line, char separator);
/// A number ("1,5" with a decimal comma; Fortran's D exponent; "1,234.5" in groups of three), NaN for a missing value (empty,
/// NaN, ---, ***, #N/A, OVER …), nothing for other text.
[[nodiscard]] std::optional<double> number_in(std::string_view cell, bool decimal_comma);

/// The text without blanks, line ends and quotes at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// @param words  with '|' before and behind each
[[nodiscard]] bool is_one_of(std::string_view words, const std::string& word);
[[nodiscard]] bool is_utf8(std::string_view text);
using io::append_utf8;
/// Latin-1 as UTF-8.
[[nodiscard]] std::string from_latin1(std::string_view text);

/// Whether a cell of a header may be a unit: short, or in brackets. Whether it is one that loggers write.
[[nodiscard]] bool looks_like_unit(std::string_view cell);
[[nodiscard]] bool is_known_unit(std::string_view cell);
/// "Acc 1 [m/s2]" -> name and unit, which may be given apart, in brackets too.
void split_unit(std::string& name, std::string& unit);

}  // namespace twindeck::records
