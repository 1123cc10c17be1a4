#pragma once

#include <optional>
#include <string_view>

namespace twindeck::io {

/// Levels of tables and arrays, and names of one dotted key, that a TOML text may have. Our own files need four. The parser and
/// the destructors of what it builds call themselves once a level, so that a file of a million brackets or dots ends on the
/// stack.
inline constexpr int most_toml_levels = 32;

/// Line (from 1) at which a TOML text first goes deeper than `most_toml_levels`, in brackets or in the names of a dotted key;
/// nothing for a text that does not. Strings and comments are passed over; whether the text is TOML at all is not checked.
[[nodiscard]] std::optional<long> line_nested_too_deep(std::string_view toml);

}  // namespace twindeck::io
