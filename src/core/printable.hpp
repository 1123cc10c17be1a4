#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace twindeck {

/// Makes the text of an input safe for a message or a terminal: valid UTF-8, one line, bounded length.
/// Line ends and tabs become a blank. Other control characters (escape, NUL, changes of the writing direction) and
/// invalid UTF-8 bytes become `\x1b`. Text beyond `longest` bytes is cut and ends in "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// Number of bytes of the UTF-8 character that begins at `at`; 0 if there is no valid one.
[[nodiscard]] std::size_t utf8_letter(std::string_view text, std::size_t at);

}  // namespace twindeck
