#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace twindeck {

/// Text of an input as it may stand in a message or on a terminal: always valid UTF-8, one line, bounded.
/// Line ends and tabs become a blank. Other control characters (escape, NUL, those that turn the direction of writing) and
/// bytes that are no UTF-8 become `\x1b`. Text beyond `longest` bytes is cut and ends in "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = std::string_view::npos);

/// Bytes of the UTF-8 letter that begins at `at`; 0 if no valid one does.
[[nodiscard]] std::size_t utf8_letter(std::string_view text, std::size_t at);

}  // namespace twindeck
