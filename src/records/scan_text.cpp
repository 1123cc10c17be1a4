#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.hpp"
#include "records/record.hpp"
#include "records/text_layout.hpp"
#include "records/time_stamp.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr Index kRows = 4096;          // a part
constexpr double kLongestGap = 1e7;    // samples that a jump of the clock may leave out and still be a gap

/// Collects rows into parts.
class Parts {
 public:
  Parts(Index columns, const Visitor& visit) : visit_(visit), block_(kRows, columns) {}
  void add(const std::vector<double>& row) {
    for (Index c = 0; c < block_.cols(); ++c) block_(used_, c) = row[static_cast<std::size_t>(c)];
    if (++used_ == kRows) flush();
  }
  void flush() {
    if (used_ > 0) visit_(first_, 0, block_.topRows(used_));
    first_ += used_;
    used_ = 0;
  }
  [[nodiscard]] Index rows() const { return first_ + used_; }

 private:
  const Visitor& visit_;
  Eigen::MatrixXd block_;
  Index first_ = 0, used_ = 0;
};

std::string describe(const TextLayout& layout) {
  const std::string separator = layout.separator == ' ' ? "blanks" : layout.separator == '\t' ? "tabs" : fmt::format("'{}'", layout.separator);
  return fmt::format("text, separated by {}, decimal {}{}, {} header line{}", separator, layout.decimal_comma ? "comma" : "point",
                     layout.latin1 ? ", latin-1" : "", layout.first_data_line - 1, layout.first_data_line == 2 ? "" : "s");
}

/// Time of each row, and the step between rows from the first that differ.
class Clock {
 public:
  explicit Clock(const TextLayout& layout) : layout_(layout) {}
  std::optional<double> time(const std::vector<std::string_view>& cells) {
    const auto at = static_cast<std::size_t>(layout_.time_column);
    if (at >= cells.size()) return {};
    if (!layout_.stamps) {
      const auto value = number_in(cells[at], layout_.decimal_comma);
      return value && std::isfinite(*value) ? std::optional(*value * layout_.time_unit_s) : std::nullopt;
    }
    if (!layout_.date_and_time || at + 1 >= cells.size()) return stamps_.next(cells[at]);
    return stamps_.next(std::string(cells[at]) + " " + std::string(cells[at + 1]));
  }
  [[nodiscard]] long exchanged() const { return stamps_.exchanged(); }

 private:
  const TextLayout& layout_;
  TimeStampReader stamps_;
};

/// Median step of the first rows; 0 if the clock is too coarse (most steps are zero).
double first_step(const fs::path& file, const TextLayout& layout) {
  std::ifstream in(file, std::ios::binary);
  Clock clock(layout);
  std::vector<double> times;
  long number = 0;
  for (std::string line; times.size() < 2000 && std::getline(in, line);) {
    if (++number < layout.first_data_line) continue;
    if (const auto t = clock.time(cells_of(line, layout.separator))) times.push_back(*t);
  }
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  if (steps.empty()) return 0.0;
  std::nth_element(steps.begin(), steps.begin() + static_cast<long>(steps.size() / 2), steps.end());
  const double middle = steps[steps.size() / 2];
  // A mean over the even steps is finer than a printed one.
  double sum = 0.0;
  long count = 0;
  for (const double s : steps) {
    if (middle > 0.0 && std::abs(s - middle) < 0.5 * middle) {
      sum += s;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

RecordInfo scan_text(const fs::path& file, const Visitor& visit) {
  const TextLayout layout = find_layout(file);
  RecordInfo info;
  info.format = describe(layout);
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < layout.columns; ++c) {
    const int from = layout.time_column, to = from + (layout.date_and_time ? 1 : 0);
    if (from >= 0 && static_cast<int>(c) >= from && static_cast<int>(c) <= to) continue;
    columns.push_back(c);
    ChannelInfo channel;
    channel.name = layout.names.empty() || layout.names[c].empty() ? "column " + std::to_string(c + 1) : layout.names[c];
    if (!layout.units.empty()) channel.unit = layout.units[c];
    info.channels.push_back(channel);
  }
  if (columns.empty()) throw InputError({file.string(), layout.first_data_line, ""}, "has a time column only", "give the channels too");

  const double step = layout.time_column >= 0 ? first_step(file, layout) : 0.0;
  std::ifstream in(file, std::ios::binary);
  Clock clock(layout);
  Parts parts(static_cast<Index>(columns.size()), visit);
  std::vector<double> row(columns.size()), nothing(columns.size(), std::numeric_limits<double>::quiet_NaN());
  std::optional<double> first_time, last_time;
  long number = 0, gaps = 0, backwards = 0, short_rows = 0, text_cells = 0, skipped = 0, first_odd = 0;
  double lost = 0.0;
  for (std::string line; std::getline(in, line);) {
    if (++number < layout.first_data_line) continue;
    const auto cells = cells_of(line, layout.separator);
    if (cells.empty() || (cells.size() == 1 && cells.front().empty())) continue;
    bool any = false;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto value = columns[k] < cells.size() ? number_in(cells[columns[k]], layout.decimal_comma) : std::optional(nothing.front());
      row[k] = value.value_or(nothing.front());
      any = any || (value && columns[k] < cells.size());
      if (!value) ++text_cells;
    }
    if (!any) {
      // A footer, or a second header.
      ++skipped;
      text_cells -= static_cast<long>(columns.size());
      if (first_odd == 0) first_odd = number;
      continue;
    }
    if (cells.size() < layout.columns) {
      ++short_rows;
      if (first_odd == 0) first_odd = number;
    }
    if (layout.time_column >= 0) {
      const auto time = clock.time(cells);
      if (time && last_time && step > 0.0) {
        const double passed = std::round((*time - *last_time) / step);
        if (passed < 0.0) ++backwards;
        if (passed > 1.0 && passed < kLongestGap) {
          ++gaps;
          lost += passed - 1.0;
          for (double k = 1.0; k < passed; k += 1.0) parts.add(nothing);
        }
      }
      if (time) {
        if (!first_time) first_time = time;
        last_time = time;
      }
    }
    parts.add(row);
  }
  parts.flush();
  for (ChannelInfo& channel : info.channels) channel.samples = parts.rows();

  const double span = first_time && last_time ? *last_time - *first_time : 0.0;
  if (step > 0.0 && span > 0.0 && gaps == 0 && backwards == 0) {
    info.rate_Hz = static_cast<double>(parts.rows() - 1) / span;
    info.rate_source = "time column";
  } else if (step > 0.0) {
    info.rate_Hz = 1.0 / step;
    info.rate_source = "time column";
  } else if (span > 0.0 && !layout.header_rate_Hz) {
    info.rate_Hz = static_cast<double>(parts.rows() - 1) / span;
    info.rate_source = "number of samples over the time that they span: the time stamps are coarser than the samples";
  }
  if (info.rate_Hz > 0.0) {
    // Loggers run at round rates; the clock's printed digits hide that.
    const double round = std::round(info.rate_Hz * 1000.0) / 1000.0;
    if (std::abs(round / info.rate_Hz - 1.0) < 1e-6) info.rate_Hz = round;
  }
  if (layout.header_rate_Hz) {
    if (info.rate_Hz > 0.0 && std::abs(info.rate_Hz / *layout.header_rate_Hz - 1.0) > 0.01) {
      info.notes.push_back(fmt::format("the header says {} Hz ('{}'), the time column {:.6g} Hz", *layout.header_rate_Hz, layout.header_rate_text,
                                       info.rate_Hz));
    } else if (info.rate_Hz == 0.0) {
      info.rate_Hz = *layout.header_rate_Hz;
      info.rate_source = fmt::format("header: '{}'", layout.header_rate_text);
    }
  }
  if (gaps > 0) info.notes.push_back(fmt::format("{} gaps in the time stamps, {:.0f} samples missing, read as NaN", gaps, lost));
  if (backwards > 0) info.notes.push_back(fmt::format("time runs backwards {} times", backwards));
  if (clock.exchanged() > 0) info.notes.push_back(fmt::format("day and month are exchanged in {} time stamps, put right by their order", clock.exchanged()));
  if (short_rows > 0) info.notes.push_back(fmt::format("{} lines have fewer cells than the others, read as missing; first oddity on line {}", short_rows, first_odd));
  if (skipped > 0) info.notes.push_back(fmt::format("{} lines among or after the numbers hold none and are left out; first oddity on line {}", skipped, first_odd));
  if (text_cells > 0) info.notes.push_back(fmt::format("{} cells hold text, read as missing", text_cells));
  return info;
}

}  // namespace twindeck::records
