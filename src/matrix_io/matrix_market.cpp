#include "matrix_io/matrix_market.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "io/atomic.hpp"
#include "io/regular_file.hpp"

namespace twindeck::matrix_io {
namespace {

struct Entry {
  int row, column;
  double value;
  long line;
};

/// Reads line by line and knows where it stands.
class MarketReader {
 public:
  explicit MarketReader(const std::filesystem::path& file) : file_(file.string()) {
    io::require_regular_file(file);
    stream_.open(file, std::ios::binary);
    if (!stream_) fail("cannot be read", "check that you may read it");
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& mend, long line = -1) const {
    throw InputError({file_, line < 0 ? line_ : line, ""}, problem, mend);
  }

  /// Banner line; true if symmetric.
  bool banner() {
    std::string line, mark, object, format, field, symmetry;
    next(line);
    std::istringstream(line) >> mark >> object >> format >> field >> symmetry;
    if (lower_case(mark) != "%%matrixmarket") fail("is no Matrix Market file", "its first line must begin with %%MatrixMarket");
    const std::string kind = lower_case(object + " " + format + " " + field + " " + symmetry);
    if (kind == "matrix coordinate real symmetric" || kind == "matrix coordinate integer symmetric") return true;
    if (kind == "matrix coordinate real general" || kind == "matrix coordinate integer general") return false;
    fail("holds a '" + kind + "'", "write it as 'matrix coordinate real symmetric' (or general with symmetric numbers)");
  }

  /// The next line that is neither empty nor a comment, split at white space.
  bool fields(std::vector<std::string>& words) {
    std::string line;
    while (next(line)) {
      if (line.empty() || line[0] == '%') continue;
      words.clear();
      std::istringstream stream(line);
      for (std::string word; stream >> word;) words.push_back(word);
      if (!words.empty()) return true;
    }
    return false;
  }

  [[nodiscard]] long line() const { return line_; }
  /// What is left to read.
  [[nodiscard]] std::uintmax_t bytes_left() {
    return stream_.eof() ? 0 : std::filesystem::file_size(file_) - static_cast<std::uintmax_t>(stream_.tellg());
  }

  template <class Number>
  Number number(const std::string& word) const {
    Number value{};
    const char* first = word.c_str() + (word[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(first, word.c_str() + word.size(), value);
    if (error != std::errc() || end != word.c_str() + word.size()) fail("'" + word + "' is no number", "check the entry");
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) fail("'" + word + "' is not finite", "replace NaN and infinity by numbers");
    }
    return value;
  }

 private:
  bool next(std::string& line) {
    ++line_;
    if (!std::getline(stream_, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  }

  std::string file_;
  std::ifstream stream_;
  long line_ = 0;
};

std::vector<Entry> read_entries(MarketReader& reader, int n, long count) {
  std::vector<Entry> entries;
  std::vector<std::string> words;
  while (reader.fields(words)) {
    if (words.size() != 3)
      reader.fail(fmt::format("has {} words, expected row, column and value", words.size()), "mend the line");
    const Entry entry{reader.number<int>(words[0]), reader.number<int>(words[1]), reader.number<double>(words[2]),
                      reader.line()};
    if (entry.row < 1 || entry.row > n || entry.column < 1 || entry.column > n)
      reader.fail(fmt::format("entry ({}, {}) lies outside the {} x {} matrix", entry.row, entry.column, n, n),
                  "indices count from 1");
    entries.push_back({entry.row - 1, entry.column - 1, entry.value, entry.line});
  }
  if (std::ssize(entries) != count)
    reader.fail(fmt::format("holds {} entries, but its size line says {}", entries.size(), count),
                "the file was cut off or edited", 0);
  return entries;
}

linalg::SparseMatrix from_entries(const std::vector<Eigen::Triplet<double, int>>& entries, int n) {
  linalg::SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Lower triangle of a general matrix whose numbers must be symmetric.
linalg::SparseMatrix symmetric_part(const MarketReader& reader, const std::vector<Entry>& entries, int n) {
  std::map<std::pair<long, long>, double> value;
  for (const Entry& e : entries) value[{e.row, e.column}] = e.value;
  return symmetric_lower(value, n, false, [&](const std::pair<long, long>& at, double a, double b) {
    reader.fail(fmt::format("is not symmetric: entry ({0}, {1}) is {2:.9g}, entry ({1}, {0}) is {3:.9g}", at.first + 1,
                            at.second + 1, a, b),
                "stiffness and mass matrices must be symmetric", 0);
  });
}

struct Contents {
  int n;
  std::vector<Entry> entries;
};

/// The size line: rows of a square matrix, and how many entries follow.
struct SizeLine {
  int n;
  long count;
};

/// Nothing is allocated on the word of a size line: more entries than there are bytes are refused at once.
SizeLine read_size(MarketReader& reader) {
  std::vector<std::string> words;
  if (!reader.fields(words) || words.size() != 3) reader.fail("the size line is missing", "expected 'rows columns entries'");
  const int n = reader.number<int>(words[0]);
  if (reader.number<int>(words[1]) != n || n < 1)
    reader.fail(fmt::format("is {} x {}", words[0], words[1]), "a square matrix is expected");
  const long count = reader.number<long>(words[2]);
  if (const std::uintmax_t left = reader.bytes_left(); count < 0 || static_cast<std::uintmax_t>(count) > left)
    reader.fail(fmt::format("its size line says {} entries, but {} bytes follow", count, left),
                "the file was cut off or edited");
  return {n, count};
}

/// Size line and entries of a square matrix, none of them twice.
Contents read_square(MarketReader& reader) {
  const SizeLine size = read_size(reader);
  std::vector<Entry> entries = read_entries(reader, size.n, size.count);

  std::vector<const Entry*> sorted;
  for (const Entry& e : entries) sorted.push_back(&e);
  const auto place = [](const Entry* e) { return std::pair(e->row, e->column); };
  std::ranges::stable_sort(sorted, [&](const Entry* a, const Entry* b) { return place(a) < place(b); });
  const auto twice = std::ranges::adjacent_find(sorted, [&](const Entry* a, const Entry* b) { return place(a) == place(b); });
  if (twice != sorted.end())
    reader.fail(fmt::format("entry ({}, {}) stands twice", (*twice)->row + 1, (*twice)->column + 1),
                "sum or remove one of the two", (*(twice + 1))->line);
  return {size.n, std::move(entries)};
}

void refuse_upper_triangle(const MarketReader& reader, const std::vector<Entry>& entries) {
  for (const Entry& e : entries)
    if (e.row < e.column)
      reader.fail(fmt::format("entry ({}, {}) lies above the diagonal of a symmetric matrix", e.row + 1, e.column + 1),
                  "write the lower triangle only, or call the matrix general", e.line);
}

void write_entries(const linalg::SparseMatrix& matrix, const char* symmetry, const std::filesystem::path& file) {
  std::string body;
  long count = 0;
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (linalg::SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      if (entry.value() == 0.0) continue;
      fmt::format_to(std::back_inserter(body), "{} {} {:.17g}\n", entry.row() + 1, entry.col() + 1, entry.value());
      ++count;
    }
  }
  io::write_file_atomically(
      file, fmt::format("%%MatrixMarket matrix coordinate real {0}\n{1} {1} {2}\n", symmetry, matrix.rows(), count) + body);
}

}  // namespace

linalg::SparseMatrix symmetric_lower(const std::map<std::pair<long, long>, double>& entries, long n, bool triangle,
                                     const RefuseUnsymmetric& refuse) {
  constexpr double most_unsymmetric = 1e-9;  ///< [-]
  std::vector<double> diagonal(static_cast<std::size_t>(n), 0.0);
  for (const auto& [at, value] : entries)
    if (at.first == at.second) diagonal[static_cast<std::size_t>(at.first)] = value;
  std::vector<Eigen::Triplet<double, int>> lower;
  for (const auto& [at, value] : entries) {
    const auto mirrored = entries.find({at.second, at.first});
    const bool alone = triangle || mirrored == entries.end();
    const double other = triangle ? value : alone ? 0.0 : mirrored->second;
    const double on_diagonal = diagonal[static_cast<std::size_t>(at.first)] * diagonal[static_cast<std::size_t>(at.second)];
    const double scale = std::max({std::abs(value), std::abs(other), std::sqrt(std::abs(on_diagonal))});
    if (std::abs(value - other) > most_unsymmetric * scale) refuse(at, value, other);
    if (alone || at.first >= at.second)
      lower.emplace_back(static_cast<int>(std::max(at.first, at.second)), static_cast<int>(std::min(at.first, at.second)),
                         0.5 * (value + other));
  }
  return from_entries(lower, static_cast<int>(n));
}

MatrixMarketSize matrix_market_size(const std::filesystem::path& file) {
  MarketReader reader(file);
  static_cast<void>(reader.banner());
  const Eigen::Index rows = read_size(reader).n;
  return {rows, reader.line()};
}

linalg::SparseMatrix read_matrix_market(const std::filesystem::path& file) {
  MarketReader reader(file);
  const bool symmetric = reader.banner();
  const auto [n, entries] = read_square(reader);
  if (!symmetric) return symmetric_part(reader, entries, n);
  refuse_upper_triangle(reader, entries);
  std::vector<Eigen::Triplet<double, int>> lower;
  for (const Entry& e : entries) lower.emplace_back(e.row, e.column, e.value);
  return from_entries(lower, n);
}

Eigen::MatrixXd read_square_matrix(const std::filesystem::path& file) {
  MarketReader reader(file);
  const bool symmetric = reader.banner();
  const auto [n, entries] = read_square(reader);
  if (symmetric) refuse_upper_triangle(reader, entries);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (const Entry& e : entries) {
    matrix(e.row, e.column) = e.value;
    if (symmetric) matrix(e.column, e.row) = e.value;
  }
  return matrix;
}

void write_square_matrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix, const std::filesystem::path& file) {
  TWINDECK_ASSERT(matrix.rows() == matrix.cols());
  write_entries(matrix.sparseView(), "general", file);
}

void write_matrix_market(const linalg::SparseMatrix& lower, const std::filesystem::path& file) {
  TWINDECK_ASSERT(lower.rows() == lower.cols());
  for (int column = 0; column < lower.outerSize(); ++column)
    for (linalg::SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) TWINDECK_ASSERT(entry.row() >= entry.col());
  write_entries(lower, "symmetric", file);
}

void write_full_matrix_market(const linalg::SparseMatrix& full, const std::filesystem::path& file) {
  TWINDECK_ASSERT(full.rows() == full.cols());
  const linalg::SparseMatrix transposed = full.transpose();
  if (linalg::SparseMatrix(full - transposed).coeffs().isZero(0.0))
    write_entries(full.triangularView<Eigen::Lower>(), "symmetric", file);
  else
    write_entries(full, "general", file);
}

}  // namespace twindeck::matrix_io
