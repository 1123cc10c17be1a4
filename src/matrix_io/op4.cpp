#include "matrix_io/op4.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "io/letters.hpp"
#include "io/regular_file.hpp"
#include "matrix_io/op4_binary.hpp"
#include "matrix_io/op4_entries.hpp"

namespace twindeck::matrix_io {
namespace {

constexpr std::size_t header_width = 8;  ///< columns of each number of the header
constexpr long string_base = 65536;      ///< of a string's header: row + 65536 (words + 1)

/// Formatted files.
class Op4Reader {
 public:
  explicit Op4Reader(const std::filesystem::path& file) : file_(file.string()) {
    io::require_regular_file(file);
    stream_.open(file, std::ios::binary);
    if (!stream_) fail("cannot be read", "check that you may read it");
    read_header();
  }

  [[nodiscard]] Eigen::Index rows() const { return rows_; }

  linalg::SparseMatrix matrix() {
    next();
    while (!at_end_) {
      const std::vector<long> head = integers();
      if (head.size() != 3)
        fail(fmt::format("'{}' is no column: number, first row, words", line_text_), "write it again by OUTPUT4");
      if (head[0] > rows_) break;
      if (head[0] < 1) fail(fmt::format("column {} lies outside of the matrix", head[0]), "columns count from 1");
      next();
      if (head[1] > 0)
        take_values(head[0], head[1], head[2]);
      else
        take_strings(head[0]);
    }
    if (at_end_) fail("the file ends before the matrix does", "it was cut off");
    refuse_what_follows();
    return entries_.assembled(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& mend) const {
    throw InputError({file_, line_, ""}, problem, mend);
  }

  void next() {
    ++line_;
    if (!std::getline(stream_, line_text_)) at_end_ = true;
    if (!line_text_.empty() && line_text_.back() == '\r') line_text_.pop_back();
    if (line_text_.find('\0') != std::string::npos)
      fail("is neither formatted nor a binary file of OUTPUT4", "write it again by OUTPUT4, formatted or binary");
  }

  /// NCOL, NROW, FORM, TYPE, NAME and the format of the values, as in "1P,5E16.9".
  void read_header() {
    next();
    const auto number_at = [&](std::size_t i) {
      const std::string field = line_text_.size() > i * header_width ? line_text_.substr(i * header_width, header_width) : "";
      const auto first = field.find_first_not_of(' ');
      return whole(first == std::string::npos ? "" : field.substr(first, field.find_last_not_of(' ') - first + 1));
    };
    const long columns = number_at(0), rows = number_at(1), type = number_at(3);
    entries_.form = number_at(2);
    if (type != 1 && type != 2)
      fail(fmt::format("holds numbers of type {}, expected 1 or 2: real", type), "stiffness and mass are real");
    if (columns != std::abs(rows) || columns < 1)
      fail(fmt::format("is {} x {}", std::abs(rows), columns), "a square matrix is expected");
    rows_ = entries_.rows = columns;
    words_ = type == 2 ? 2 : 1;
    const std::string format = io::upper_case(line_text_.substr(std::min(line_text_.size(), 5 * header_width)));
    const auto e = format.find_first_of("ED");
    const auto [end, error] = e == std::string::npos
                                  ? std::from_chars_result{nullptr, std::errc::invalid_argument}
                                  : std::from_chars(format.data() + e + 1, format.data() + format.size(), width_);
    if (error != std::errc() || width_ < 8 || width_ > 40)
      fail(fmt::format("'{}' is no format of values, expected one as 1P,5E16.9", format), "write it again by OUTPUT4");
  }

  [[nodiscard]] long whole(const std::string& word) const {
    long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("'{}' is no whole number", word), "write it again by OUTPUT4, formatted");
    return value;
  }

  [[nodiscard]] std::vector<long> integers() const {
    std::istringstream stream(line_text_);
    std::vector<long> numbers;
    for (std::string word; stream >> word;) numbers.push_back(whole(word));
    return numbers;
  }

  [[nodiscard]] bool has_values() const { return !at_end_ && line_text_.find('.') != std::string::npos; }

  [[nodiscard]] double value_of(std::string text) const {
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    std::replace(text.begin(), text.end(), 'D', 'E');
    if (text.starts_with('+')) text.erase(0, 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(fmt::format("'{}' is no finite number", text), "write it again by OUTPUT4");
    return value;
  }

  /// Values of a column from a row on, up to the next line of whole numbers; `words` is how many words they should fill.
  void take_values(long column, long row, long words) {
    const long first = row;
    for (; has_values(); next()) {
      const std::size_t length = line_text_.find_last_not_of(' ') + 1;
      for (std::size_t at = 0; at < length; at += static_cast<std::size_t>(width_)) {
        const double value = value_of(line_text_.substr(at, std::min(static_cast<std::size_t>(width_), length - at)));
        if (row < 1 || row > rows_) fail(fmt::format("row {} lies outside of the matrix", row), "rows count from 1");
        if (!entries_.add(column, row, value))
          fail(fmt::format("entry ({}, {}) stands twice", row, column), "write it again by OUTPUT4");
        ++row;
      }
    }
    // Programs count a number of double precision as one word or as two.
    if (row - first != words && (row - first) * words_ != words)
      fail(fmt::format("{} values stand above, where {} words were said", row - first, words),
           "the file was cut off or edited");
  }

  void take_strings(long column) {
    while (!at_end_) {
      const std::vector<long> head = integers();
      if (head.size() == 3) return;
      if (head.size() != 1 && head.size() != 2)
        fail(fmt::format("'{}' is no header of a string", line_text_), "write it again by OUTPUT4");
      const long words = head.size() == 2 ? head[0] - 1 : head[0] / string_base - 1;
      const long row = head.size() == 2 ? head[1] : head[0] % string_base;
      next();
      take_values(column, row, words);
    }
  }

  /// The end is a column behind the last with one value.
  void refuse_what_follows() {
    next();
    if (has_values()) next();
    for (; !at_end_; next()) {
      if (line_text_.find_first_not_of(' ') != std::string::npos)
        fail("a second matrix follows, which is not read", "write every matrix into a file of its own");
    }
  }

  std::string file_, line_text_;
  std::ifstream stream_;
  long line_ = 0, rows_ = 0;
  long words_ = 2;  ///< of a number, where they are counted
  int width_ = 16;
  bool at_end_ = false;
  Op4Entries entries_;
};

}  // namespace

linalg::SparseMatrix read_op4(const std::filesystem::path& file) {
  return is_binary_op4(file) ? read_binary_op4(file) : Op4Reader(file).matrix();
}

Eigen::Index op4_rows(const std::filesystem::path& file) {
  return is_binary_op4(file) ? binary_op4_rows(file) : Op4Reader(file).rows();
}

bool is_op4(const std::filesystem::path& file) { return io::upper_case(file.extension().string()) == ".OP4"; }

}  // namespace twindeck::matrix_io
