#include "matrix_io/op4_binary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/error.hpp"
#include "io/regular_file.hpp"
#include "matrix_io/op4_entries.hpp"

namespace twindeck::matrix_io {
namespace {

constexpr std::size_t marker_bytes = 4;                    ///< of a record's length
constexpr std::size_t header_of_4 = 24, header_of_8 = 48;  ///< [bytes] by the size of a word
constexpr long row_base = 65536;                           ///< of a string's first word
constexpr long largest = 1L << 40;  ///< of a whole number: far beyond any matrix, and safe to reckon with

/// A number of `T` out of bytes, turned round where the file has the other order.
template <class T>
T number_at(const std::string& bytes, std::size_t at, bool reversed) {
  std::array<char, sizeof(T)> raw{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), sizeof(T), raw.begin());
  if (reversed) std::reverse(raw.begin(), raw.end());
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

class BinaryOp4 {
 public:
  explicit BinaryOp4(const std::filesystem::path& file) : file_(file.string()) {
    io::require_regular_file(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) fail("cannot be read", "check that you may read it");
    bytes_.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    layout_ = layout_of(bytes_);
    read_header();
  }

  [[nodiscard]] Eigen::Index rows() const { return entries_.rows; }

  linalg::SparseMatrix matrix() {
    for (bool ended = false; !ended;) ended = !read_column();
    if (at_ != bytes_.size()) fail("a second matrix follows, which is not read", "write every matrix into a file of its own");
    return entries_.assembled(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& mend) const {
    throw InputError({file_, 0, fmt::format("byte {}", at_)}, problem, mend);
  }

  /// Enters the next record: its bytes are those from at_ to end_.
  void open_record() {
    const char* mend = "it was cut off or edited: write it again by OUTPUT4";
    if (at_ + marker_bytes > bytes_.size()) fail("the file ends before the matrix does", mend);
    const std::size_t length = number_at<std::uint32_t>(bytes_, at_, layout_.reversed);
    const std::size_t left = bytes_.size() - at_ - marker_bytes;
    if (left < marker_bytes || length > left - marker_bytes)
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
    const long columns = integer(), rows = integer();
    entries_.form = integer();
    const long type = integer();
    if (type != 1 && type != 2)
      fail(fmt::format("holds numbers of type {}, expected 1 or 2: real", type), "stiffness and mass are real");
    if (columns < 1 || (rows != columns && rows != -columns))
      fail(fmt::format("is {} x {}", rows < 0 ? -rows : rows, columns), "a square matrix is expected");
    if (columns > static_cast<long>(bytes_.size()))
      fail(fmt::format("says {} columns, more than a file of {} bytes holds", columns, bytes_.size()),
           "it was cut off or edited");
    entries_.rows = columns;
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
      if (row < 1 || row > entries_.rows) fail(fmt::format("row {} lies outside of the matrix", row), "rows count from 1");
      if (!entries_.add(column, row, value))
        fail(fmt::format("entry ({}, {}) stands twice", row, column), "write it again by OUTPUT4");
    }
  }

  /// False for the record behind the last column.
  bool read_column() {
    open_record();
    const long column = integer(), row = integer(), words = integer();
    if (column < 1) fail(fmt::format("column {} lies outside of the matrix", column), "columns count from 1");
    const bool is_end = column > entries_.rows;
    if (!is_end && row > 0) take_values(column, row, words);
    while (!is_end && row <= 0 && at_ < end_) {
      const long first = integer();
      if (big_)
        take_values(column, integer(), first - 1);
      else
        take_values(column, first % row_base, first / row_base - 1);
    }
    close_record();
    return !is_end;
  }

  std::string file_, bytes_;
  Layout layout_;
  std::size_t at_ = 0, end_ = 0;
  bool big_ = false;
  std::size_t value_bytes_ = 8;
  Op4Entries entries_;
};

}  // namespace

bool is_binary_op4(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(marker_bytes, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(marker_bytes));
  return stream.gcount() == static_cast<std::streamsize>(marker_bytes) && layout_of(start).known;
}

linalg::SparseMatrix read_binary_op4(const std::filesystem::path& file) { return BinaryOp4(file).matrix(); }

Eigen::Index binary_op4_rows(const std::filesystem::path& file) { return BinaryOp4(file).rows(); }

}  // namespace twindeck::matrix_io
