#include "records/scan_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "core/lists.hpp"
#include "io/text_lines.hpp"
#include "records/take_clock.hpp"
#include "records/text_cells.hpp"
#include "records/text_layout.hpp"
#include "records/time_stamp.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;

namespace {

constexpr Index kPart = 524288;  // values that are passed on at once

class RowParts {
 public:
  RowParts(Index columns, const Visitor& visit) : visit_(visit), block_(std::clamp<Index>(kPart / columns, 1, 4096), columns) {}
  void add(const std::vector<double>& row) {
    for (Index c = 0; c < block_.cols(); ++c) block_(used_, c) = row[static_cast<std::size_t>(c)];
    if (++used_ == block_.rows()) flush();
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
                     layout.decimal_comma ? "comma" : "point",
                     layout.utf16    ? ", UTF-16"
                     : layout.latin1 ? ", latin-1"
                                     : "",
                     layout.first_data_line - 1, layout.first_data_line == 2 ? "" : "s");
}

class RowTime {
 public:
  explicit RowTime(const TextLayout& layout) : layout_(layout) {}
  std::optional<double> time(const std::vector<std::string_view>& cells) {
    const auto at = static_cast<std::size_t>(layout_.time_column);
    if (!layout_.stamps && !layout_.time_parts) return number_in(cells[at], layout_.decimal_comma);
    std::optional<double> time = layout_.stamps ? std::nullopt : std::optional(0.0);
    const int date = layout_.date_column;
    if (layout_.stamps)
      time = stamps_.next(date < 0 ? cells[at]
                                   : std::string(cells[static_cast<std::size_t>(date)]) + " " + std::string(cells[at]));
    const auto parts = layout_.time_parts ? seconds_of_parts(cells, *layout_.time_parts, layout_.decimal_comma) : 0.0;
    return time && parts ? std::optional(*time + *parts) : std::nullopt;
  }
  [[nodiscard]] long exchanged() const { return stamps_.exchanged(); }

 private:
  const TextLayout& layout_;
  TimeStampReader stamps_;
};

/// Columns of the channels: all but those of time.
std::vector<std::size_t> channel_columns(const TextLayout& layout) {
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < layout.columns; ++c) {
    const bool other = contains(layout.other_times, c);
    if (static_cast<int>(c) != layout.time_column && !other) columns.push_back(c);
  }
  return columns;
}

RecordInfo info_of(const TextLayout& layout, const std::vector<std::size_t>& columns) {
  RecordInfo info;
  info.format = describe(layout);
  info.unaligned_header = layout.unaligned;
  info.unaligned_line = layout.unaligned_line;
  info.notes = layout.notes;
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

std::string time_name(const TextLayout& layout) {
  const auto at = static_cast<std::size_t>(layout.time_column);
  return layout.names.empty() || layout.names[at].empty() ? "" : " '" + layout.names[at] + "'";
}

class Rows {
 public:
  Rows(const TextLayout& layout, std::vector<std::size_t> columns)
      : layout_(layout), columns_(std::move(columns)), clock_(layout), row_(columns_.size()) {}

  /// Whether the stray line has the number of cells of a row, with text in one of them.
  [[nodiscard]] bool is_one_cell() const { return one_cell_; }
  enum class Kind { blank, row, stray, cut };
  /// Kind of a line. For a row, keeps the values and the time; for a stray line, the reason.
  /// @param without_end  the file ends in this line, so that its last number may be cut
  Kind take(std::string_view line, bool without_end) {
    one_cell_ = false;
    auto cells = cells_of(line, layout_.separator);
    if (cells.empty() || (cells.size() == 1 && cells.front().empty())) return Kind::blank;
    if (cells.size() >= layout_.fewest && cells.size() < layout_.columns) cells.resize(layout_.columns);
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
    one_cell_ = any && !text.empty();
    if (!any || !text.empty()) {
      problem_ = any ? text : "holds no number";
      return Kind::stray;
    }
    const std::string_view last = cells.back();
    const std::size_t sign = last.find(layout_.decimal_comma ? ',' : '.');
    const std::size_t decimals = sign == std::string_view::npos ? 0 : last.size() - sign;
    if (without_end && decimals < fewest_decimals_ && fewest_decimals_ != kNone) return Kind::cut;
    if (!last.empty()) fewest_decimals_ = std::min(fewest_decimals_, decimals);
    return Kind::row;
  }
  [[nodiscard]] const std::vector<double>& values() const { return row_; }
  [[nodiscard]] std::optional<double> time() const { return time_; }
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] long exchanged() const { return clock_.exchanged(); }

 private:
  const TextLayout& layout_;
  std::vector<std::size_t> columns_;
  RowTime clock_;
  std::vector<double> row_;
  std::optional<double> time_;
  std::string problem_;
  bool one_cell_ = false;
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t fewest_decimals_ = kNone;  ///< least number of characters from the decimal sign on in the last cell of a row
};

/// Tells channels that never have values in one row: series of different clocks in one table, each on rows of its own.
class RowGroups {
 public:
  explicit RowGroups(std::size_t channels) : group_(channels), there_(channels, false) {
    for (std::size_t c = 0; c < channels; ++c) group_[c] = static_cast<Index>(c);
  }
  void add(const std::vector<double>& row) {
    if (std::ranges::all_of(group_, [&](Index group) { return group == group_.front(); })) return;
    const auto first =
        static_cast<std::size_t>(std::ranges::find_if(row, [](double value) { return std::isfinite(value); }) - row.begin());
    for (std::size_t c = first; c < row.size(); ++c) {
      if (!std::isfinite(row[c])) continue;
      there_[c] = true;
      if (const Index old = group_[c]; old != group_[first]) std::ranges::replace(group_, old, group_[first]);
    }
  }
  /// Enters the groups, with a note if there are several. A channel without a value belongs to each.
  void finish(RecordInfo& info) const {
    const auto first = static_cast<std::size_t>(std::ranges::find(there_, true) - there_.begin());
    for (std::size_t c = 0; c < group_.size(); ++c) {
      info.channels[c].row_group = first < group_.size() && there_[c] ? group_[c] : -1;
      if (info.channels[c].row_group < 0 || group_[c] == group_[first] || info.apart) continue;
      info.apart = true;
      info.notes.push_back(fmt::format("'{}' has values in no row in which '{}' has: they stand on rows of their own",
                                       info.channels[c].name, info.channels[first].name));
    }
  }

 private:
  std::vector<Index> group_;
  std::vector<bool> there_;
};

/// A line without its digits, so that "Channel 1" and "Channel 2" are equal.
std::string form_of(std::string_view line) {
  std::string out(trimmed(line));
  std::erase_if(out, [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
  return out;
}

[[noreturn]] void refuse_next_block(const fs::path& file, long number, std::string_view line) {
  throw InputError({file.string(), number, ""},
                   fmt::format("'{}' stands in the header too: another block of numbers begins, and no column of time says "
                               "whether it goes on",
                               trimmed(line).substr(0, 60)),
                   "write each block into a file of its own, or side by side as columns");
}

[[noreturn]] void refuse_stray(const fs::path& file, long number, std::string_view line, const Rows& rows) {
  throw InputError({file.string(), number, ""},
                   fmt::format("'{}' is no row of the table: it {}", trimmed(line).substr(0, 60), rows.problem()),
                   fmt::format("{}, or set skip_stray_lines = true in its [[record]] of campaign.toml to leave out such lines",
                               rows.is_one_cell() ? "empty the cell, which then is a missing value" : "remove the line"));
}

/// Refuses a single series that is written along the rows: the header states about as many samples as the rows hold numbers. A
/// table with time or with a line of names has channels instead.
void refuse_wrapped_series(const fs::path& file, const TextLayout& layout, Index rows) {
  const auto columns = static_cast<Index>(layout.columns);
  const Index stated = layout.header_samples.value_or(0), full = stated / columns;
  const bool named = !layout.names.empty() && layout.header_samples_line + 1 != layout.first_data_line;
  if (columns < 2 || layout.time_column >= 0 || named || stated <= rows || (rows != full && rows != full + 1)) return;
  throw InputError({file.string(), layout.header_samples_line, ""},
                   fmt::format("states {} samples, and {} rows of {} numbers follow: one series, written on from row to row",
                               stated, rows, columns),
                   "write one number a line: tr -s ' \\t,' '\\n' on the lines below the header");
}

/// Notes on rows that were put right or left out, with their number.
void note_lines(RecordInfo& info, long exchanged, long of_others, long stray, long first_stray) {
  const auto note = [&](long count, const std::string& one, const std::string& several) {
    if (count > 0) info.notes.push_back(count == 1 ? one : fmt::format("{} {}", count, several));
  };
  note(exchanged, "one time stamp has day and month exchanged, put right by its order",
       "time stamps have day and month exchanged, put right by their order");
  note(of_others, "one row has no value of the channels asked for and is left out",
       "rows have no value of the channels asked for and are left out");
  note(stray, fmt::format("line {} is no row of the table and is left out", first_stray),
       fmt::format("lines are no rows of the table and are left out, the first is line {}", first_stray));
}

}  // namespace

RecordInfo scan_text(const fs::path& file, const Visitor& visit, const ReadOptions& options) {
  const TextLayout layout = find_layout(file);
  const std::vector<std::size_t> columns = channel_columns(layout);
  if (columns.empty())
    throw InputError({file.string(), layout.first_data_line, ""}, "has a time column only", "give the channels too");
  RecordInfo info = info_of(layout, columns);
  StampedRows stamps;
  Rows rows(layout, columns);
  RowParts parts(std::ssize(columns), visit);
  io::TextLines in(file);
  RowGroups groups(columns.size());
  long stray = 0, first_stray = 0, of_others = 0;
  std::set<std::string> header;
  for (std::string line; in.next(line);) {
    if (in.number() < layout.first_data_line) {
      header.insert(form_of(line));
      continue;
    }
    const Rows::Kind kind = rows.take(line, in.without_end());
    if (kind == Rows::Kind::blank) continue;
    if (kind == Rows::Kind::cut) {
      info.notes.push_back(
          fmt::format("line {}, the last, has no end and fewer digits than any other in its last cell: it was "
                      "cut off there and is left out",
                      in.number()));
      continue;
    }
    if (kind == Rows::Kind::stray) {
      refuse_wrapped_series(file, layout, parts.rows());  // its last row may be shorter
      if (layout.time_column < 0 && header.contains(form_of(line))) refuse_next_block(file, in.number(), line);
      if (!options.skip_stray_lines) refuse_stray(file, in.number(), line, rows);
      if (++stray == 1) first_stray = in.number();
      continue;
    }
    const auto has_value = [&](Index c) { return std::isfinite(rows.values()[static_cast<std::size_t>(c)]); };
    if (!options.rows_of.empty() && std::ranges::none_of(options.rows_of, has_value)) {
      ++of_others;
      continue;
    }
    groups.add(rows.values());
    const Index row = parts.rows();
    if (info.lines.empty() || in.number() - row != info.lines.back().second - info.lines.back().first)
      info.lines.emplace_back(row, in.number());
    if (layout.time_column >= 0) stamps.add(rows.time().value_or(std::numeric_limits<double>::quiet_NaN()));
    parts.add(rows.values());
  }
  parts.flush();
  refuse_wrapped_series(file, layout, parts.rows());
  for (ChannelInfo& channel : info.channels) channel.samples = parts.rows();
  if (options.rows_of.empty()) groups.finish(info);
  if (layout.time_column >= 0)
    take_clock(stamps, layout.stamps || layout.time_parts ? 1.0 : layout.time_unit_s, "time column" + time_name(layout), info);
  if (layout.header_rate_Hz)
    take_stated_rate(*layout.header_rate_Hz, fmt::format("header: '{}'", layout.header_rate_text), info);
  note_lines(info, rows.exchanged(), of_others, stray, first_stray);
  return info;
}

}  // namespace twindeck::records
