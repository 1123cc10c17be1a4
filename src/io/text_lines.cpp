#include "io/text_lines.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/error.hpp"
#include "io/regular_file.hpp"
#include "io/spreadsheet.hpp"

namespace twindeck::io {

namespace {

/// Letters of ASCII with a zero byte after each ('<') or before each ('>'): UTF-16 without a mark. 0 for none.
char order_without_mark(std::string_view text) {
  constexpr std::size_t looked_at = 16;  // bytes
  if (text.size() < looked_at) return 0;
  const auto all = [&](std::size_t letter) {
    for (std::size_t k = 0; k < looked_at; k += 2)
      if (text[k + letter] == '\0' || text[k + 1 - letter] != '\0') return false;
    return true;
  };
  if (all(0)) return '<';
  return all(1) ? '>' : '\0';
}

}  // namespace

void refuse_longer(const std::filesystem::path& file, std::uintmax_t most) {
  std::error_code unknown;
  if (const std::uintmax_t bytes = std::filesystem::file_size(file, unknown); !unknown && bytes > most)
    throw InputError({file.string(), 0, ""},
                     fmt::format("has {:.1f} GB, expected at most {:.0f} GB", 1e-9 * static_cast<double>(bytes),
                                 1e-9 * static_cast<double>(most)),
                     "give a shorter file");
}

TextLines::TextLines(const std::filesystem::path& file, std::uintmax_t most) : in_(file, std::ios::binary) {
  refuse_longer(file, most);
  if (is_spreadsheet(file) && in_.is_open()) {
    const std::filesystem::path csv = csv_of_spreadsheet(file);
    in_.close();
    in_.open(csv, std::ios::binary);
    std::filesystem::remove(csv);  // the open file can still be read
  }
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
  without_end_ = !line.empty();
  return without_end_;
}

std::string text_of_file(const std::filesystem::path& file) {
  // A pipe is refused before it is opened, which would wait for a writer.
  if (std::filesystem::exists(file) && !std::filesystem::is_directory(file)) require_regular_file(file);
  TextLines lines(file, longest_text);
  if (!lines.opened() || std::filesystem::is_directory(file))
    throw InputError({file.string(), 0, ""}, "cannot be opened", "check the path and that the file is readable");
  std::string text;
  for (std::string line; lines.next(line);) (text += line) += '\n';
  if (lines.without_end() && !text.empty()) text.pop_back();
  return text;
}

void append_utf8(std::uint32_t code, std::string& text) {
  if (code >= 0x110000 || (code >= 0xD800 && code <= 0xDFFF)) code = '?';
  const auto following = [&](unsigned shift) { text += static_cast<char>(0x80U | (code >> shift & 0x3FU)); };
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0U | code >> 6U);
    following(0);
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0U | code >> 12U);
    following(6);
    following(0);
  } else {
    text += static_cast<char>(0xF0U | code >> 18U);
    following(12);
    following(6);
    following(0);
  }
}

}  // namespace twindeck::io
