#include "records/scan_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.hpp"
#include "records/text_cells.hpp"
#include "records/text_layout.hpp"
#include "records/time_stamp.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr Index kPart = 524288;  // values that are handed on at once

/// Values that gaps of the clock may add in all (80 MB; ten channels at 100 Hz for 2.8 hours): a clock that jumps further is no
/// gap but another record.
constexpr double kMostLost = 1e7;

/// Collects rows into parts.
class RowParts {
 public:
  RowParts(Index columns, const Visitor& visit) : visit_(visit), block_(std::clamp<Index>(kPart / columns, 1, 4096), columns) {}
  void add(const std::vector<double>& row) {
    for (Index c = 0; c < block_.cols(); ++c) block_(used_, c) = row[static_cast<std::size_t>(c)];
    if (++used_ == block_.rows()) flush();
  }
  /// Rows of NaN.
  void add_missing(Index count) {
    while (count > 0) {
      const Index n = std::min(count, block_.rows() - used_);
      block_.middleRows(used_, n).setConstant(std::numeric_limits<double>::quiet_NaN());
      used_ += n;
      count -= n;
      if (used_ == block_.rows()) flush();
    }
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
  const std::string separator = layout.separator == ' '    ? "blanks"
                                : layout.separator == '\t' ? "tabs"
                                                           : fmt::format("'{}'", layout.separator);
  return fmt::format("text, separated by {}, decimal {}{}, {} header line{}", separator,
                     layout.decimal_comma ? "comma" : "point", layout.latin1 ? ", latin-1" : "", layout.first_data_line - 1,
                     layout.first_data_line == 2 ? "" : "s");
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
    const auto cells = cells_of(number == 1 ? without_mark(line) : std::string_view(line), layout.separator);
    if (cells.size() != layout.columns) continue;
    if (const auto t = clock.time(cells)) times.push_back(*t);
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

/// Columns of the channels: all but the time's.
std::vector<std::size_t> channel_columns(const TextLayout& layout) {
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < layout.columns; ++c) {
    const int from = layout.time_column, to = from + (layout.date_and_time ? 1 : 0), at = static_cast<int>(c);
    if (from < 0 || at < from || at > to) columns.push_back(c);
  }
  return columns;
}

RecordInfo info_of(const TextLayout& layout, const std::vector<std::size_t>& columns) {
  RecordInfo info;
  info.format = describe(layout);
  info.unaligned_header = layout.unaligned;
  info.unaligned_line = layout.unaligned_line;
  for (const std::size_t c : columns) {
    ChannelInfo channel;
    const bool named = !layout.names.empty() && !layout.names[c].empty();
    info.names_channels = info.names_channels || named;
    channel.name = named ? layout.names[c] : "column " + std::to_string(c + 1);
    channel.position = static_cast<Index>(c) + 1;
    if (!layout.units.empty()) channel.unit = layout.units[c];
    info.channels.push_back(channel);
  }
  return info;
}

/// Reads the lines below the header one after another.
class Rows {
 public:
  Rows(const TextLayout& layout, std::vector<std::size_t> columns)
      : layout_(layout), columns_(std::move(columns)), clock_(layout), row_(columns_.size()) {}

  enum class Kind { blank, row, stray };
  /// What a line is; of a row the values and the time, of a stray line why it is no row.
  Kind take(std::string_view line) {
    auto cells = cells_of(line, layout_.separator);
    if (cells.empty() || (cells.size() == 1 && cells.front().empty())) return Kind::blank;
    if (cells.size() + 1 == layout_.columns && ends_with_separator(line, layout_.separator)) cells.emplace_back();
    while (cells.size() > layout_.columns && cells.back().empty()) cells.pop_back();
    if (cells.size() != layout_.columns) {
      problem_ = fmt::format("has {} cell{}, expected {}", cells.size(), cells.size() == 1 ? "" : "s", layout_.columns);
      return Kind::stray;
    }
    const auto nothing = std::numeric_limits<double>::quiet_NaN();
    bool any = false;
    std::string text;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const auto value = number_in(cells[columns_[k]], layout_.decimal_comma);
      row_[k] = value.value_or(nothing);
      any = any || value;
      if (!value && text.empty())
        text = fmt::format("has '{}' in column {}", cells[columns_[k]].substr(0, 40), columns_[k] + 1);
    }
    const bool timed = layout_.time_column >= 0;
    time_ = timed ? clock_.time(cells) : std::nullopt;
    const std::string_view stamp = timed ? cells[static_cast<std::size_t>(layout_.time_column)] : std::string_view{};
    if (timed && !time_ && !number_in(stamp, layout_.decimal_comma)) {
      problem_ = fmt::format("has the time '{}'", stamp.substr(0, 40));
      return Kind::stray;
    }
    if (!any || !text.empty()) {
      problem_ = any ? text : "holds no number";
      return Kind::stray;
    }
    return Kind::row;
  }
  [[nodiscard]] const std::vector<double>& values() const { return row_; }
  [[nodiscard]] std::optional<double> time() const { return time_; }
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] long exchanged() const { return clock_.exchanged(); }

 private:
  const TextLayout& layout_;
  std::vector<std::size_t> columns_;
  Clock clock_;
  std::vector<double> row_;
  std::optional<double> time_;
  std::string problem_;
};

/// What the clock did from row to row.
struct ClockHistory {
  double step = 0.0, lost = 0.0;                      ///< [s], [samples]
  long gaps = 0, backwards = 0, first_backwards = 0;  ///< the last is a line
  std::optional<double> first, last;

  /// @return samples that are missing before this row
  double missing_before(std::optional<double> time, long line) {
    double missing = 0.0;
    if (!time) return missing;
    if (last && step > 0.0) {
      const double passed = std::round((*time - *last) / step);
      if (passed < 0.0 && ++backwards == 1) first_backwards = line;
      if (passed > 1.0) {
        ++gaps;
        missing = passed - 1.0;
        lost += missing;
      }
    }
    if (!first) first = time;
    last = time;
    return missing;
  }
};

/// The rate by the time column, or by a line of the header; where both say one they are held against each other.
void find_rate(const TextLayout& layout, const ClockHistory& clock, Index rows, RecordInfo& info) {
  const double span = clock.first && clock.last ? *clock.last - *clock.first : 0.0;
  if (clock.step > 0.0 && span > 0.0 && clock.gaps == 0 && clock.backwards == 0) {
    info.rate_Hz = static_cast<double>(rows - 1) / span;
    info.rate_source = "time column";
  } else if (clock.step > 0.0) {
    info.rate_Hz = 1.0 / clock.step;
    info.rate_source = "time column";
  } else if (span > 0.0 && !layout.header_rate_Hz) {
    info.rate_Hz = static_cast<double>(rows - 1) / span;
    info.rate_source = "number of samples over the time that they span: the time stamps are coarser than the samples";
  }
  if (info.rate_Hz > 0.0) {
    // Loggers run at round rates; the clock's printed digits hide that.
    const double round = std::round(info.rate_Hz * 1000.0) / 1000.0;
    if (std::abs(round / info.rate_Hz - 1.0) < 1e-6) info.rate_Hz = round;
  }
  if (!layout.header_rate_Hz) return;
  if (info.rate_Hz > 0.0 && std::abs(info.rate_Hz / *layout.header_rate_Hz - 1.0) > 0.01) {
    info.notes.push_back(fmt::format("the header says {} Hz ('{}'), the time column {:.6g} Hz", *layout.header_rate_Hz,
                                     layout.header_rate_text, info.rate_Hz));
  } else if (info.rate_Hz == 0.0) {
    info.rate_Hz = *layout.header_rate_Hz;
    info.rate_source = fmt::format("header: '{}'", layout.header_rate_text);
  }
}

}  // namespace

RecordInfo scan_text(const fs::path& file, const Visitor& visit, const ReadOptions& options) {
  const TextLayout layout = find_layout(file);
  const std::vector<std::size_t> columns = channel_columns(layout);
  if (columns.empty())
    throw InputError({file.string(), layout.first_data_line, ""}, "has a time column only", "give the channels too");
  RecordInfo info = info_of(layout, columns);
  ClockHistory clock;
  clock.step = layout.time_column >= 0 ? first_step(file, layout) : 0.0;
  Rows rows(layout, columns);
  RowParts parts(std::ssize(columns), visit);
  std::ifstream in(file, std::ios::binary);
  long number = 0, stray = 0, first_stray = 0;
  for (std::string line; std::getline(in, line);) {
    if (++number < layout.first_data_line) continue;
    const std::string_view text = number == 1 ? without_mark(line) : std::string_view(line);
    const Rows::Kind kind = rows.take(text);
    if (kind == Rows::Kind::blank) continue;
    if (kind == Rows::Kind::stray) {
      if (!options.skip_stray_lines) {
        throw InputError(
            {file.string(), number, ""},
            fmt::format("'{}' is no row of the table: it {}", trimmed(text).substr(0, 60), rows.problem()),
            "remove the line, or set skip_stray_lines = true in its [[record]] of campaign.toml to leave out such lines");
      }
      if (++stray == 1) first_stray = number;
      continue;
    }
    const double missing = clock.missing_before(rows.time(), number);
    if (clock.lost * static_cast<double>(columns.size()) > kMostLost) {
      throw InputError(
          {file.string(), number, ""},
          fmt::format("comes {:.6g} s after the row before it, a gap of {:.6g} samples", missing * clock.step, missing),
          "split the record where its clock jumps");
    }
    parts.add_missing(static_cast<Index>(missing));
    parts.add(rows.values());
  }
  parts.flush();
  for (ChannelInfo& channel : info.channels) channel.samples = parts.rows();
  find_rate(layout, clock, parts.rows(), info);
  const auto note = [&](long count, const std::string& one, const std::string& several) {
    if (count > 0) info.notes.push_back(count == 1 ? one : fmt::format("{} {}", count, several));
  };
  note(clock.gaps, fmt::format("a gap in the time stamps, {:.0f} samples missing, read as NaN", clock.lost),
       fmt::format("gaps in the time stamps, {:.0f} samples missing, read as NaN", clock.lost));
  note(clock.backwards, fmt::format("the time runs backwards on line {}", clock.first_backwards),
       fmt::format("rows whose time runs backwards, the first on line {}", clock.first_backwards));
  note(rows.exchanged(), "one time stamp has day and month exchanged, put right by its order",
       "time stamps have day and month exchanged, put right by their order");
  note(stray, fmt::format("line {} is no row of the table and is left out", first_stray),
       fmt::format("lines are no rows of the table and are left out, the first is line {}", first_stray));
  return info;
}

}  // namespace twindeck::records
