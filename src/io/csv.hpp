#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace twindeck::io {

/// A CSV file as typed columns (UTF-8, comma, header row, one record a row). The reader keeps the line number of each row for
/// error messages. `row` counts from 0; messages count lines of the file from 1.
class CsvTable {
 public:
  /// @param required  columns that must be present
  /// @param optional  further known columns. Any other column is refused with the nearest known name, unless `allow_other` is
  ///                  true
  /// @throws InputError  for a missing file, a missing or doubled column, a row of the wrong length
  static CsvTable read(const std::filesystem::path& file, const std::vector<std::string>& required,
                       const std::vector<std::string>& optional = {}, bool allow_other = false);

  [[nodiscard]] std::size_t rows() const { return cells_.size(); }
  [[nodiscard]] bool has(const std::string& column) const { return index_.contains(column); }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// Line of the file in which a row begins, from 1.
  [[nodiscard]] long line(std::size_t row) const { return line_.at(row); }

  /// Text of a cell; "" if the column is missing.
  [[nodiscard]] std::string text(std::size_t row, const std::string& column) const;
  /// A finite number. @throws InputError if the cell is empty, no number, NaN or infinite.
  [[nodiscard]] double number(std::size_t row, const std::string& column) const;
  /// A finite number, or `fallback` if the cell is empty or the column is missing.
  [[nodiscard]] double number_or(std::size_t row, const std::string& column, double fallback) const;
  [[nodiscard]] std::optional<double> number_if(std::size_t row, const std::string& column) const;
  /// A whole number. @throws InputError as `number`, and for a fraction.
  [[nodiscard]] long integer(std::size_t row, const std::string& column) const;
  [[nodiscard]] std::optional<long> integer_if(std::size_t row, const std::string& column) const;
  /// An InputError that names this file, the row's line and the column.
  [[noreturn]] void fail(std::size_t row, const std::string& column, const std::string& problem,
                         const std::string& mend = "") const;

 private:
  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::map<std::string, std::size_t> index_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<long> line_;
};

/// One CSV cell: text, a number (12 significant digits) or a whole number. An empty optional gives an empty cell.
struct Cell {
  std::string value;
  Cell(const char* text);
  Cell(std::string text);
  Cell(double number);
  Cell(int number);
  Cell(long number);
  Cell(std::size_t number);
  Cell(std::optional<double> number);
};

/// Collects rows and writes them all at once. Numbers have 12 significant digits and do not depend on the locale.
class CsvWriter {
 public:
  explicit CsvWriter(std::vector<std::string> columns);
  /// @throws InternalError if the number of cells is not the number of columns.
  void row(std::initializer_list<Cell> cells);
  void row(const std::vector<Cell>& cells);
  void save(const std::filesystem::path& file) const;

 private:
  std::vector<std::string> columns_;
  std::string body_;
};

/// 12 significant digits, shortest form ("0.5", "1e-07").
[[nodiscard]] std::string format_number(double value);

}  // namespace twindeck::io
