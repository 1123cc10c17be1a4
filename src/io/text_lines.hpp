#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace twindeck::io {

/// [bytes] Longest table, configuration or deck that is read whole: a deck of twenty million lines. More is a mistake.
constexpr std::uintmax_t longest_text = 2'000'000'000;

/// @throws InputError  for a regular file longer than `most` bytes; none of it is read
void refuse_longer(const std::filesystem::path& file, std::uintmax_t most);

/// The lines of a text file as programs write it: UTF-8 with or without its mark, latin-1 (its bytes are left), UTF-16 in
/// either order of bytes (as UTF-8); lines end in LF, CR LF, or CR alone.
class TextLines {
 public:
  /// @throws InputError  for a regular file longer than `most` bytes, before any of it is read
  explicit TextLines(const std::filesystem::path& file, std::uintmax_t most = std::numeric_limits<std::uintmax_t>::max());
  /// The next line without LF; false at the end of the file.
  bool next(std::string& line);
  /// The file could be opened.
  [[nodiscard]] bool opened() const { return in_.is_open(); }
  /// The line just read is the last and has no end.
  [[nodiscard]] bool without_end() const { return without_end_; }
  [[nodiscard]] bool is_utf16() const { return utf16_; }
  /// Of the line just read, from 1.
  [[nodiscard]] long number() const { return number_; }

 private:
  int unit();

  std::ifstream in_;
  bool utf16_ = false, big_endian_ = false, without_end_ = false;
  char end_ = '\n';
  long number_ = 0;
};

/// The whole text of a file as TextLines reads it, each line ended by LF.
/// @throws InputError  if it cannot be opened or is longer than `longest_text`
[[nodiscard]] std::string text_of_file(const std::filesystem::path& file);

/// Adds the letter of that code point in UTF-8; '?' for what is none.
void append_utf8(std::uint32_t code, std::string& text);

}  // namespace twindeck::io
