#include "matrix_io/op4.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "io/regular_file.hpp"
#include "matrix_io/matrix_market.hpp"

namespace twindeck::matrix_io {
namespace {

constexpr std::size_t header_width = 8;  ///< columns of each number of the header
constexpr long string_base = 65536;      ///< of a string's header: row + 65536 (words + 1)

/// What formatted and binary files share: the place in the file, the header's numbers, the entries.
class Op4Source {
 public:
  [[nodiscard]] Eigen::Index rows() const { return rows_; }

 protected:
  Op4Source(const std::filesystem::path& file, bool binary) : file_(file.string()), binary_(binary) {
    io::require_regular_file(file);
    stream_.open(file, std::ios::binary);
    if (!stream_) fail("cannot be read", "check that you may read it");
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& mend) const {
    throw InputError({file_, line_, binary_ ? fmt::format("byte {}", at_) : ""}, problem, mend);
  }

  /// NCOL, NROW, FORM and TYPE of the header.
  void take_header(long columns, long rows, long form, long type) {
    if (type != 1 && type != 2)
      fail(fmt::format("holds numbers of type {}, expected 1 or 2: real", type), "stiffness and mass are real");
    if (columns < 1 || columns != std::abs(rows))
      fail(fmt::format("is {} x {}", std::abs(rows), columns), "a square matrix is expected");
    rows_ = columns;
    form_ = form;
  }

  /// @param column, row  from 1
  void add(long column, long row, double value) {
    if (row < 1 || row > rows_) fail(fmt::format("row {} lies outside of the matrix", row), "rows count from 1");
    if (!entries_.emplace(std::pair{column - 1, row - 1}, value).second)
      fail(fmt::format("entry ({}, {}) stands twice", row, column), "write it again by OUTPUT4");
  }

  /// Lower triangle. Of two triangles the mean is taken; one alone is that of a matrix of form 6.
  [[nodiscard]] linalg::SparseMatrix assembled() const {
    bool below = false, above = false;
    for (const auto& [place, value] : entries_) {
      below = below || place.second > place.first;
      above = above || place.second < place.first;
    }
    const bool triangle = form_ == 6 && !(below && above);
    return symmetric_lower(entries_, rows_, triangle, [&](const std::pair<long, long>& place, double value, double mirrored) {
      throw InputError({file_, 0, ""},
                       fmt::format("is not symmetric: entry ({0}, {1}) is {2:.9g}, entry ({1}, {0}) is {3:.9g}",
                                   place.second + 1, place.first + 1, value, mirrored),
                       "stiffness and mass matrices must be symmetric");
    });
  }

  std::string file_;
  bool binary_ = false;
  std::ifstream stream_;
  long line_ = 0;       ///< of a formatted file
  std::size_t at_ = 0;  ///< [bytes] of a binary file
  long rows_ = 0, form_ = 0;

 private:
  std::map<std::pair<long, long>, double> entries_;  ///< by column, row, from 0
};

/// Formatted files.
class Op4Reader : public Op4Source {
 public:
  explicit Op4Reader(const std::filesystem::path& file) : Op4Source(file, false) { read_header(); }

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
    return assembled();
  }

 private:
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
      return whole(std::string(without_blanks(field, " ")));
    };
    const long columns = number_at(0), rows = number_at(1), type = number_at(3);
    take_header(columns, rows, number_at(2), type);
    words_ = type == 2 ? 2 : 1;
    const std::string format = upper_case(line_text_.substr(std::min(line_text_.size(), 5 * header_width)));
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
    std::ranges::replace(text, 'D', 'E');
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
        add(column, row, value_of(line_text_.substr(at, std::min(static_cast<std::size_t>(width_), length - at))));
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
    for (; !at_end_; next())
      if (line_text_.find_first_not_of(' ') != std::string::npos)
        fail("a second matrix follows, which is not read", "write every matrix into a file of its own");
  }

  std::string line_text_;
  long words_ = 2;  ///< of a number, where they are counted
  int width_ = 16;
  bool at_end_ = false;
};

constexpr std::size_t marker_bytes = 4;                    ///< of a record's length
constexpr std::size_t header_of_4 = 24, header_of_8 = 48;  ///< [bytes] by the size of a word
constexpr long largest = 1L << 40;  ///< of a whole number: far beyond any matrix, and safe to reckon with

/// A number of `T` out of bytes, turned round where the file has the other order.
template <class T>
T number_at(const std::string& bytes, std::size_t at, bool reversed) {
  std::array<char, sizeof(T)> raw{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), sizeof(T), raw.begin());
  if (reversed) std::ranges::reverse(raw);
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

/// How the first four bytes say that words are stored.
struct Layout {
  bool known = false, reversed = false;
  std::size_t word = 4;
};

Layout layout_of(const std::string& bytes) {
  if (bytes.size() < marker_bytes) return {};
  for (const bool reversed : {false, true}) {
    const auto length = number_at<std::uint32_t>(bytes, 0, reversed);
    if (length == header_of_4) return {true, reversed, 4};
    if (length == header_of_8) return {true, reversed, 8};
  }
  return {};
}

/// Binary files.
///
/// They are Fortran's unformatted records, each between two lengths of four bytes. The first holds NCOL, NROW, form, type and
/// the name; its length of 24 or 48 bytes tells whether words have four or eight bytes, and in which order the bytes stand.
/// Every further record is a column: its number, the first row (0: strings of nonzeros), the count of words, the words. Numbers
/// of type 1 have a word, those of type 2 eight bytes. A string begins with one word, row + 65536 (words + 1), or with two in
/// BIGMAT (NROW below 0), words + 1 and row. The last record has the number of a column behind the last.
/// Source: NX Nastran User's Guide, "OUTPUT4 binary files"; as of formatted files otherwise (op4.hpp).
class BinaryOp4 : public Op4Source {
 public:
  explicit BinaryOp4(const std::filesystem::path& file) : Op4Source(file, true) {
    bytes_.assign(std::istreambuf_iterator<char>(stream_), std::istreambuf_iterator<char>());
    layout_ = layout_of(bytes_);
    read_header();
  }

  linalg::SparseMatrix matrix() {
    for (bool ended = false; !ended;) ended = !read_column();
    if (at_ != bytes_.size()) fail("a second matrix follows, which is not read", "write every matrix into a file of its own");
    return assembled();
  }

 private:
  /// Enters the next record: its bytes are those from at_ to end_.
  void open_record() {
    const char* mend = "it was cut off or edited: write it again by OUTPUT4";
    if (at_ + marker_bytes > bytes_.size()) fail("the file ends before the matrix does", mend);
    const std::size_t length = number_at<std::uint32_t>(bytes_, at_, layout_.reversed);
    if (const std::size_t left = bytes_.size() - at_ - marker_bytes; left < marker_bytes || length > left - marker_bytes)
      fail(fmt::format("a record of {} bytes passes the end of the file", length), mend);
    end_ = at_ + marker_bytes + length;
    if (number_at<std::uint32_t>(bytes_, end_, layout_.reversed) != length) fail("the record's two lengths differ", mend);
    at_ += marker_bytes;
  }

  void close_record() { at_ = end_ + marker_bytes; }

  long integer() {
    if (end_ - at_ < layout_.word) fail("the record ends within a number", "write it again by OUTPUT4");
    const long value = layout_.word == 4 ? static_cast<long>(number_at<std::int32_t>(bytes_, at_, layout_.reversed))
                                         : static_cast<long>(number_at<std::int64_t>(bytes_, at_, layout_.reversed));
    if (value > largest || value < -largest)
      fail(fmt::format("{} is no count or number of a row", value), "write it again by OUTPUT4");
    at_ += layout_.word;
    return value;
  }

  void read_header() {
    open_record();
    const long columns = integer(), rows = integer(), form = integer(), type = integer();
    take_header(columns, rows, form, type);
    if (columns > std::ssize(bytes_))
      fail(fmt::format("says {} columns, more than a file of {} bytes holds", columns, bytes_.size()),
           "it was cut off or edited");
    big_ = rows < 0;
    value_bytes_ = type == 2 ? 8 : layout_.word;
    close_record();
  }

  void take_values(long column, long row, long words) {
    const std::size_t bytes = static_cast<std::size_t>(std::max(words, 0L)) * layout_.word;
    if (words < 0 || bytes > end_ - at_ || bytes % value_bytes_ != 0)
      fail(fmt::format("{} words are said, which the record does not hold", words), "it was cut off or edited");
    for (const std::size_t stop = at_ + bytes; at_ < stop; at_ += value_bytes_, ++row) {
      const double value = value_bytes_ == 8 ? number_at<double>(bytes_, at_, layout_.reversed)
                                             : static_cast<double>(number_at<float>(bytes_, at_, layout_.reversed));
      if (!std::isfinite(value)) fail("holds a value that is no finite number", "write it again by OUTPUT4");
      add(column, row, value);
    }
  }

  /// False for the record behind the last column.
  bool read_column() {
    open_record();
    const long column = integer(), row = integer(), words = integer();
    if (column < 1) fail(fmt::format("column {} lies outside of the matrix", column), "columns count from 1");
    const bool is_end = column > rows_;
    if (!is_end && row > 0) take_values(column, row, words);
    while (!is_end && row <= 0 && at_ < end_) {
      const long first = integer();
      if (big_)
        take_values(column, integer(), first - 1);
      else
        take_values(column, first % string_base, first / string_base - 1);
    }
    close_record();
    return !is_end;
  }

  std::string bytes_;
  Layout layout_;
  std::size_t end_ = 0;
  bool big_ = false;
  std::size_t value_bytes_ = 8;
};

/// Whether the file begins with a record of 24 or 48 bytes. False for a file that cannot be read.
bool is_binary_op4(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(marker_bytes, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(marker_bytes));
  return stream.gcount() == static_cast<std::streamsize>(marker_bytes) && layout_of(start).known;
}

}  // namespace

linalg::SparseMatrix read_op4(const std::filesystem::path& file) {
  return is_binary_op4(file) ? BinaryOp4(file).matrix() : Op4Reader(file).matrix();
}

Eigen::Index op4_rows(const std::filesystem::path& file) {
  return is_binary_op4(file) ? BinaryOp4(file).rows() : Op4Reader(file).rows();
}

bool is_op4(const std::filesystem::path& file) { return upper_case(file.extension().string()) == ".OP4"; }

}  // namespace twindeck::matrix_io
