#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_lines.hpp"

namespace twindeck::records {

/// Cells of a line, blanks and quotes around them taken off; a last separator opens an empty cell.
/// @param separator  ' ' for any run of blanks
[[nodiscard]] std::vector<std::string_view> cells_of(std::string_view line, char separator);
/// A number ("1,5" with a decimal comma; Fortran's D exponent), NaN for a missing value (empty, NaN, ---, ***, #N/A, OVER …),
/// nothing for other text.
[[nodiscard]] std::optional<double> number_in(std::string_view cell, bool decimal_comma);
/// "03.04.2021", "2021-04-03" and the like: three whole numbers with '-', '.' or '/' between.
[[nodiscard]] bool is_date(std::string_view cell);

/// Without blanks, line ends and quotes at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// Letters A to Z in lower case.
[[nodiscard]] std::string lower(std::string_view text);
[[nodiscard]] bool is_utf8(std::string_view text);
using io::append_utf8;
/// Latin-1 as UTF-8.
[[nodiscard]] std::string from_latin1(std::string_view text);

}  // namespace twindeck::records
