#include "records/text_lines.hpp"

#include <cstdint>
#include <string_view>

#include "records/text_cells.hpp"

namespace twindeck::records {

namespace {

/// Letters of ASCII with a zero byte after each ('<') or before each ('>'): UTF-16 without a mark. 0 for none.
char order_without_mark(std::string_view text) {
  constexpr std::size_t looked_at = 16;  // bytes
  if (text.size() < looked_at) return 0;
  const auto all = [&](std::size_t letter) {
    for (std::size_t k = 0; k < looked_at; k += 2) {
      if (text[k + letter] == '\0' || text[k + 1 - letter] != '\0') return false;
    }
    return true;
  };
  if (all(0)) return '<';
  return all(1) ? '>' : '\0';
}

}  // namespace

TextLines::TextLines(const std::filesystem::path& file) : in_(file, std::ios::binary) {
  std::string text(65536, '\0');
  in_.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in_.gcount()));
  in_.clear();
  std::size_t mark = 0;
  if (text.starts_with("\xEF\xBB\xBF")) {
    mark = 3;
  } else if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    mark = 2;
    utf16_ = true;
    big_endian_ = text.front() == '\xFE';
  } else if (const char order = order_without_mark(text); order != '\0') {
    utf16_ = true;
    big_endian_ = order == '>';
  }
  if (text.find('\n') == std::string::npos && text.find('\r') != std::string::npos) end_ = '\r';
  in_.seekg(static_cast<std::streamoff>(mark));
}

/// The next sixteen bits of UTF-16, -1 at the end of the file.
int TextLines::unit() {
  const int first = in_.get(), second = in_.get();
  if (second < 0) return -1;
  return big_endian_ ? 256 * first + second : 256 * second + first;
}

bool TextLines::next(std::string& line) {
  ++number_;
  if (!utf16_) {
    if (!std::getline(in_, line, end_)) return false;
    without_end_ = in_.eof();
    return true;
  }
  line.clear();
  for (int code = unit(); code >= 0; code = unit()) {
    if (code == static_cast<unsigned char>(end_)) return true;
    if (code >= 0xD800 && code < 0xDC00) {  // the first of two that make one letter
      const int low = unit();
      code = low < 0 ? '?' : 0x10000 + (code - 0xD800) * 0x400 + (low - 0xDC00);
    }
    append_utf8(static_cast<std::uint32_t>(code), line);
  }
  without_end_ = true;
  return !line.empty();
}

}  // namespace twindeck::records
