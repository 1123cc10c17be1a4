#include "io/csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "core/units.hpp"
#include "io/atomic.hpp"
#include "io/spreadsheet.hpp"
#include "io/text_lines.hpp"

namespace twindeck::io {
namespace {

/// Cuts the text of a file into records by RFC 4180: quoted cells may hold commas, line ends and doubled quotes. Blanks around
/// an unquoted cell are dropped (hand-written tables have them), blank lines are skipped, CRLF is tolerated.
class RecordReader {
 public:
  RecordReader(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}

  /// @return false at the end of the file
  bool next(std::vector<std::string>& cells, long& line) {
    while (at_ < text_.size()) {
      cells.clear();
      line = line_;
      const bool quoted = record(cells);
      if (quoted || cells.size() > 1 || !cells.front().empty()) return true;
    }
    return false;
  }

 private:
  bool record(std::vector<std::string>& cells) {
    bool any_quoted = false;
    while (true) {
      while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
      if (at_ < text_.size() && text_[at_] == '"') {
        any_quoted = true;
        cells.push_back(quoted_cell());
      } else {
        const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
        cells.emplace_back(without_blanks(std::string_view(text_).substr(at_, end - at_), " \t"));
        at_ = end;
      }
      if (at_ >= text_.size()) return any_quoted;
      const char separator = text_[at_++];
      if (separator == ',') continue;
      if (separator == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
      ++line_;
      return any_quoted;
    }
  }

  std::string quoted_cell() {
    const long opened = line_;
    std::string cell;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
          ++at_;
        } else {
          ++at_;
          while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
          if (at_ < text_.size() && text_.find_first_of(",\r\n", at_) != at_)
            throw InputError({file_, line_, ""}, "has text after a closing quote", "double a quote inside a quoted cell: \"\"");
          return cell;
        }
      } else if (text_[at_] == '\n') {
        ++line_;
      }
      cell += text_[at_];
    }
    throw InputError({file_, opened, ""}, "opens a quoted cell that is never closed", "add the closing quote");
  }

  std::string text_;
  std::string file_;
  std::size_t at_ = 0;
  long line_ = 1;
};

std::string joined(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ",")); }

std::string quoted_where_needed(const std::string& cell, bool only_cell) {
  const bool blank_end =
      !cell.empty() && (cell.front() == ' ' || cell.front() == '\t' || cell.back() == ' ' || cell.back() == '\t');
  if (cell.find_first_of(",\"\r\n") == std::string::npos && !blank_end && !(only_cell && cell.empty())) return cell;
  std::string quoted = "\"";
  for (const char letter : cell) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + "\"";
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& asked, const std::vector<std::string>& required,
                        const std::vector<std::string>& optional, bool allow_other) {
  CsvTable table;
  const std::filesystem::path file = table_file(asked);
  table.file_ = file;
  RecordReader reader(text_of_file(file), file.string());
  long line = 1;
  if (!reader.next(table.columns_, line))
    throw InputError({file.string(), 1, ""}, "is empty, expected a header row", "start the file with: " + joined(required));
  if (table.columns_.size() == 1 && table.columns_.front().find(';') != std::string::npos)
    throw InputError({file.string(), line, ""}, "is separated by semicolons", "separate the columns by commas");
  std::vector<std::string> known = required;
  known.insert(known.end(), optional.begin(), optional.end());
  const std::set<std::string> known_set(known.begin(), known.end());
  for (std::size_t i = 0; i < table.columns_.size(); ++i) {
    const std::string& column = table.columns_[i];
    if (!table.index_.emplace(column, i).second)
      throw InputError({file.string(), line, column}, "column stands twice", "remove or rename one of them");
    if (!allow_other && !known_set.contains(column)) {
      const std::string nearest = nearest_name(column, known);
      throw InputError(
          {file.string(), line, ""}, "unknown column '" + column + "'",
          nearest.empty() ? fmt::format("known columns are {}", fmt::join(known, ", ")) : "did you mean '" + nearest + "'?");
    }
  }
  for (const std::string& column : required)
    if (!table.index_.contains(column))
      throw InputError({file.string(), line, column}, "column is missing" + did_you_mean(column, table.columns_),
                       "expected columns: " + joined(required));
  std::vector<std::string> cells;
  while (reader.next(cells, line)) {
    if (cells.size() != table.columns_.size())
      throw InputError({file.string(), line, ""},
                       fmt::format("has {} cells, expected {} as in the header", cells.size(), table.columns_.size()),
                       "give every column a cell, empty where there is no value");
    table.cells_.push_back(cells);
    table.line_.push_back(line);
  }
  return table;
}

std::string CsvTable::text(std::size_t row, const std::string& column) const {
  const auto found = index_.find(column);
  return found == index_.end() ? "" : cells_.at(row).at(found->second);
}

std::optional<double> CsvTable::number_if(std::size_t row, const std::string& column) const {
  const std::string cell(without_blanks(text(row, column), " \t"));
  if (cell.empty()) return std::nullopt;
  const char* begin = cell.data() + (cell.size() > 1 && cell[0] == '+' && cell[1] != '-' ? 1 : 0);  // from_chars takes no '+'
  const char* end = cell.data() + cell.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range)
    fail(row, column, "is \"" + cell + "\", beyond what a number can hold", "give a number between 1e-300 and 1e60");
  if (error != std::errc{} || stop != end)
    fail(row, column, "is \"" + cell + "\", expected a number",
         "write it like 12.5 or 1.25e1; the unit stands in the column name");
  if (!std::isfinite(value))
    fail(row, column, "is \"" + cell + "\", expected a finite number", "leave the row out or mend the value");
  if (std::abs(value) > largest_number)
    fail(row, column, "is \"" + cell + "\", larger than any quantity of a structure", "correct the value or its unit");
  return value;
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  const std::optional<double> value = number_if(row, column);
  if (!value) fail(row, column, "is empty, expected a number", "fill the cell");
  return *value;
}

double CsvTable::number_or(std::size_t row, const std::string& column, double fallback) const {
  return number_if(row, column).value_or(fallback);
}

std::optional<long> CsvTable::integer_if(std::size_t row, const std::string& column) const {
  const std::optional<double> value = number_if(row, column);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value) || std::abs(*value) > 9e15)
    fail(row, column, "is \"" + text(row, column) + "\", expected a whole number", "write it without a fraction");
  return static_cast<long>(*value);
}

long CsvTable::integer(std::size_t row, const std::string& column) const {
  const std::optional<long> value = integer_if(row, column);
  if (!value) fail(row, column, "is empty, expected a whole number", "fill the cell");
  return *value;
}

void CsvTable::fail(std::size_t row, const std::string& column, const std::string& problem, const std::string& mend) const {
  throw InputError({file_.string(), row < line_.size() ? line_[row] : 0, column}, problem, mend);
}

Cell::Cell(const char* text) : value(text) {}
Cell::Cell(std::string text) : value(std::move(text)) {}
Cell::Cell(double number) : value(format_number(number)) {
  if (!std::isfinite(number)) throw InternalError("a CSV cell was given a number that is not finite");
}
Cell::Cell(int number) : value(std::to_string(number)) {}
Cell::Cell(long number) : value(std::to_string(number)) {}
Cell::Cell(std::size_t number) : value(std::to_string(number)) {}
Cell::Cell(std::optional<double> number) : value(number ? Cell(*number).value : "") {}

CsvWriter::CsvWriter(std::vector<std::string> columns) : columns_(std::move(columns)) { TWINDECK_ASSERT(!columns_.empty()); }

void CsvWriter::row(std::initializer_list<Cell> cells) { row(std::vector<Cell>(cells)); }

void CsvWriter::row(const std::vector<Cell>& cells) {
  TWINDECK_ASSERT(cells.size() == columns_.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) body_ += ',';
    body_ += quoted_where_needed(cells[i].value, columns_.size() == 1);
  }
  body_ += '\n';
}

void CsvWriter::save(const std::filesystem::path& file) const {
  std::string header;
  for (const std::string& column : columns_) header += (header.empty() ? "" : ",") + quoted_where_needed(column, false);
  write_file_atomically(file, header + "\n" + body_);
}

std::string format_number(double value) { return value == 0.0 ? "0" : fmt::format("{:.12g}", value); }

}  // namespace twindeck::io
