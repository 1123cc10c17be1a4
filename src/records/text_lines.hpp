#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace twindeck::records {

/// The lines of a text file as loggers write it: UTF-8 with or without its mark, latin-1 (its bytes are left), UTF-16 in either
/// order of bytes (as UTF-8); lines end in LF, CR LF, or CR alone.
class TextLines {
 public:
  explicit TextLines(const std::filesystem::path& file);
  /// The next line without LF; false at the end of the file.
  bool next(std::string& line);
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

}  // namespace twindeck::records
