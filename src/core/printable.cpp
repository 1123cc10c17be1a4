#include "core/printable.hpp"

#include <array>
#include <cstdint>

namespace twindeck {
namespace {

/// Code point of a letter of `bytes` bytes, known to have that form.
std::uint32_t code_point(std::string_view letter) {
  const auto first = static_cast<unsigned char>(letter.front());
  std::uint32_t code = letter.size() == 1 ? first : first & (0x7FU >> letter.size());
  for (const char c : letter.substr(1)) code = code << 6U | (static_cast<unsigned char>(c) & 0x3FU);
  return code;
}

/// Characters that move the cursor, end a line, or turn the direction in which text is written.
bool is_control(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 ||
         (code >= 0x200E && code <= 0x200F) || (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::size_t utf8_letter(std::string_view text, std::size_t at) {
  if (at >= text.size()) return 0;
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t bytes = first < 0x80 ? 1 : first >> 5U == 6 ? 2 : first >> 4U == 14 ? 3 : first >> 3U == 30 ? 4 : 0;
  if (bytes == 0 || at + bytes > text.size()) return 0;
  for (std::size_t k = 1; k < bytes; ++k)
    if ((static_cast<unsigned char>(text[at + k]) & 0xC0U) != 0x80U) return 0;
  constexpr std::array<std::uint32_t, 5> smallest = {0, 0, 0x80, 0x800, 0x10000};  // a longer form than needed is no UTF-8
  const std::uint32_t code = code_point(text.substr(at, bytes));
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < smallest[bytes] || code > 0x10FFFF || surrogate ? 0 : bytes;
}

std::string printable(std::string_view text, std::size_t longest) {
  static const char* const digits = "0123456789abcdef";
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    if (result.size() >= longest) return result + "...";
    const std::size_t bytes = utf8_letter(text, at);
    if (text[at] == '\n' || text[at] == '\r' || text[at] == '\t') {
      result += ' ';
    } else if (bytes > 0 && !is_control(code_point(text.substr(at, bytes)))) {
      result += text.substr(at, bytes);
    } else {
      for (const char c : text.substr(at, bytes == 0 ? 1 : bytes)) {
        const auto byte = static_cast<unsigned char>(c);
        result += {'\\', 'x', digits[byte >> 4U], digits[byte & 15U]};
      }
    }
    at += bytes == 0 ? 1 : bytes;
  }
  return result;
}

}  // namespace twindeck
