#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace twindeck::records {

/// Lines of a universal file, with their numbers for messages.
class UniversalLines {
 public:
  explicit UniversalLines(const std::filesystem::path& file);
  /// The next line without its end; false at the end of the file.
  bool next(std::string& line);
  /// The next line; @throws InputError  if the file ends: "breaks off in <what>"
  std::string need(const std::string& what);
  /// The line just read is given again.
  void back(const std::string& line);
  /// `n` bytes of binary data, or fewer at the end of the file. Line ends among them count as lines, as in an editor.
  std::string take(std::size_t n);
  /// `n` bytes that stand `offset` bytes ahead; nothing is taken.
  std::string peek(std::size_t offset, std::size_t n);
  [[noreturn]] void fail(const std::string& problem, const std::string& mend = "") const;
  [[nodiscard]] long number() const { return number_; }
  /// The line just read has no line end: the file ends in it.
  [[nodiscard]] bool is_last_without_end() const { return without_end_; }
  /// Length of the file [bytes]: no set holds more values than that.
  [[nodiscard]] long size() const { return static_cast<long>(bytes_); }

 private:
  std::string bytes(std::size_t n);

  std::filesystem::path file_;
  std::uintmax_t bytes_ = 0;
  std::ifstream in_;
  long number_ = 0;
  bool has_back_ = false, without_end_ = false;
  std::string back_;
};

/// What helps with a file that breaks off.
inline constexpr const char* kCopyAgain = "the file was cut off; copy it again";

/// The next line of a set. @throws InputError  if it is the set's end
std::string need_inside(UniversalLines& in, const std::string& what);
/// A label or code: a whole number. @throws InputError  for any other
long label_of(UniversalLines& in, double number);
/// True for the line -1 that begins and ends a set.
[[nodiscard]] bool is_delimiter(const std::string& line);
/// Nothing but blanks, or the letter by which DOS ended a file.
[[nodiscard]] bool is_blank(const std::string& line);
/// Columns [from, from + width) without blanks at its ends; "" beyond the end.
[[nodiscard]] std::string field(const std::string& line, std::size_t from, std::size_t width);
/// All numbers in a line: Fortran's D exponents, numbers that touch ("1.0E+00-2.0E+00").
[[nodiscard]] std::vector<double> numbers_in(const std::string& line);
/// A number that counts something: whole, from 0 to `most`; nothing for any other.
[[nodiscard]] std::optional<long> count_in(double number, long most);
/// Whole number of a field, `fallback` if it is empty or none.
[[nodiscard]] long integer_or(const std::string& text, long fallback);

}  // namespace twindeck::records
