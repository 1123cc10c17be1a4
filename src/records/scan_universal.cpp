#include "records/scan_universal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "core/letters.hpp"
#include "core/lists.hpp"
#include "records/frequency_responses.hpp"
#include "records/take_clock.hpp"
#include "records/text_cells.hpp"
#include "records/universal_lines.hpp"
#include "records/universal_shapes.hpp"

namespace twindeck::records {
namespace fs = std::filesystem;
using Eigen::Index;
namespace {

constexpr Index kValuesOfAPart = 65536;  // a part

const char* direction_name(long code) {
  static const char* const names[] = {"-rz", "-ry", "-rx", "-z", "-y", "-x", "", "+x", "+y", "+z", "+rx", "+ry", "+rz"};
  return code >= -6 && code <= 6 ? names[code + 6] : "";
}

void skip_set(UniversalLines& in, const std::string& set) {
  for (std::string line; in.next(line);)
    if (is_delimiter(line)) return;
  in.fail(fmt::format("breaks off in set {}, expected -1 at its end", set), kCopyAgain);
}

/// Reads the -1 after the last value. Some writers leave out the last one of the file. Then it is unknown whether sets are
/// missing, and a note says so.
void expect_end(UniversalLines& in, RecordInfo& info, const std::string& set) {
  const bool whole = !in.is_last_without_end();
  std::string line;
  while (in.next(line)) {
    if (is_delimiter(line)) return;
    if (is_blank(line)) continue;
    in.fail(fmt::format("does not end after the values of set {}, expected -1", set),
            "write the set again with the number of its values");
  }
  if (!whole) in.fail(fmt::format("breaks off in the last value of set {}", set), kCopyAgain);
  info.notes.push_back(fmt::format("the last set ({}) has no end: if the file was cut off, channels are missing", set));
}

struct Series {
  int function = 0, data_type = 0, abscissa = 17;
  Index values = 0;
  bool even = true, binary = false, swapped = false;
  double step = 0.0;
  double unit_s = 0.0;  ///< [s] unit of the abscissa, 0 if unknown
  StampedRows stamps;   ///< of an uneven abscissa
  std::size_t bytes = 0;
  ChannelInfo channel;
  bool keeps = false;               ///< values are kept below, not only visited
  double start = 0.0;               ///< of an even abscissa
  std::vector<double> at, numbers;  ///< the uneven abscissa; real and imaginary parts in turn
  UniversalFunction as_function;    ///< header of a set that is no time series
  [[nodiscard]] bool is_complex() const { return data_type == 5 || data_type == 6; }
  [[nodiscard]] bool is_double() const { return data_type == 4 || data_type == 6; }
  [[nodiscard]] bool is_time() const { return (function == 1 || function == 0) && abscissa != 18; }
};

/// Data type, number of values, spacing in columns of ten, then start and step; apart by blanks where a writer did not keep to
/// columns.
std::vector<double> form_of(const std::string& line) {
  std::vector<double> numbers;
  for (const std::size_t at : {0, 10, 20}) {
    const std::string cell = field(line, at, 10);
    if (cell.empty() || cell.find_first_not_of("0123456789") != std::string::npos) return numbers_in(line);
    numbers.push_back(static_cast<double>(integer_or(cell, 0)));
  }
  const std::vector<double> rest = numbers_in(line.substr(std::min<std::size_t>(30, line.size())));
  numbers.insert(numbers.end(), rest.begin(), rest.end());
  return numbers;
}

/// A label and a direction of record 6. Node 0 without a direction is none.
std::string point_of(const std::string& node, const std::string& direction) {
  return (node.empty() || node == "0") && direction.empty() ? "" : node + direction;
}

/// Records 9 to 11: type and unit of the ordinate, its denominator, the third axis.
void read_ordinate_axes(UniversalLines& in, const std::string& what, Series& series) {
  const std::string numerator = need_inside(in, what), denominator = need_inside(in, what);
  need_inside(in, what);
  series.channel.unit = field(numerator, 47, 20);
  if (series.channel.unit == "NONE") series.channel.unit.clear();
  series.as_function.unit = series.channel.unit;
  series.as_function.quantity = static_cast<int>(integer_or(field(numerator, 0, 10), 0));
  series.as_function.over = static_cast<int>(integer_or(field(denominator, 0, 10), 0));
}

Series read_series_header(UniversalLines& in, const std::string& set_line, const std::string& what) {
  Series series;
  series.binary = field(set_line, 6, 1) == "b" || set_line.find('b') != std::string::npos;
  if (series.binary) {
    const auto numbers = numbers_in(set_line.substr(set_line.find('b') + 1));
    if (!numbers.empty()) series.swapped = numbers[0] == 2.0;
    if (numbers.size() >= 4) series.bytes = static_cast<std::size_t>(count_in(numbers[3], in.size()).value_or(0));
  }
  std::vector<std::string>& names = series.channel.other_names;
  for (int i = 0; i < 5; ++i) names.push_back(field(need_inside(in, what), 0, 80));
  const std::string identity = need_inside(in, what), entity = field(identity, 31, 10);
  series.function = static_cast<int>(integer_or(field(identity, 0, 5), 0));
  series.channel.point = field(identity, 41, 10);
  series.channel.direction = direction_name(integer_or(field(identity, 51, 4), 0));
  if (entity != "NONE" && !entity.empty()) names.insert(names.end(), {entity + series.channel.direction, entity});
  names.push_back(series.channel.point + series.channel.direction);
  series.as_function.line = in.number();
  series.as_function.response = point_of(series.channel.point, series.channel.direction);
  series.as_function.reference = point_of(field(identity, 66, 10), direction_name(integer_or(field(identity, 76, 4), 0)));
  const std::string form = need_inside(in, what);
  const auto numbers = form_of(form);
  if (numbers.size() < 5)
    in.fail(fmt::format("holds '{}', expected type, number of values, spacing, start and step", field(form, 0, 80)),
            "write the set again");
  constexpr long most_types = 99;  // sound files have 2 to 6
  series.data_type = static_cast<int>(integer_or(field(form, 0, 10), count_in(numbers[0], most_types).value_or(0)));
  const auto values = count_in(numbers[1], in.size());  // a value takes one byte at least
  if (!values || *values == 0)
    in.fail(
        fmt::format("states {:.6g} values, expected a whole number from 1 to what {} bytes can hold", numbers[1], in.size()),
        "write the set again");
  series.values = *values;
  series.even = numbers[2] != 0.0;
  series.start = numbers[3];
  series.step = numbers[4];
  if (series.data_type != 2 && series.data_type != 4 && !series.is_complex())
    in.fail(fmt::format("has data of type {}, expected 2, 4 (real), 5 or 6 (complex)", series.data_type),
            "write the set again");
  const std::string axis = need_inside(in, what);
  series.abscissa = static_cast<int>(integer_or(field(axis, 0, 10), 17));
  series.unit_s = time_unit_s(field(axis, 47, 20));
  series.as_function.abscissa_unit = field(axis, 47, 20);
  read_ordinate_axes(in, what, series);
  series.channel.samples = series.values;
  if (series.even && series.step > 0.0) {
    const double unit_s = series.unit_s > 0.0 ? series.unit_s : StampedRows::likely_unit_s(series.step);
    series.channel.rate_Hz = 1.0 / (series.step * unit_s);
    series.channel.start = series.start / series.step;
  }
  return series;
}

double binary_value(const char* at, bool is_double, bool swapped) {
  std::array<char, 8> bytes{};
  const std::size_t n = is_double ? 8 : 4;
  std::memcpy(bytes.data(), at, n);
  if (swapped) std::reverse(bytes.data(), bytes.data() + n);
  if (is_double) return std::bit_cast<double>(bytes);
  return static_cast<double>(std::bit_cast<std::array<float, 2>>(bytes)[0]);
}

class Parts {
 public:
  Parts(const Visitor& visit, Index channel) : visit_(visit), channel_(channel), block_(kValuesOfAPart, 1) {}
  void add(double value) {
    block_(used_++, 0) = std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
    if (used_ == kValuesOfAPart) flush();
  }
  void flush() {
    if (used_ > 0 && channel_ >= 0) visit_(first_, channel_, block_.topRows(used_));
    first_ += used_;
    used_ = 0;
  }

 private:
  const Visitor& visit_;
  Index channel_, first_ = 0, used_ = 0;
  Eigen::MatrixXd block_;
};

/// Numbers per sample in the file: an uneven abscissa, real and imaginary part.
Index width(const Series& series) { return (series.even ? 0 : 1) + (series.is_complex() ? 2 : 1); }

/// Numbers of a line of values; NaN for a number that the writer could not write (NaN, Inf, stars).
std::vector<double> series_numbers(UniversalLines& in, const std::string& line) {
  if (line.find_first_not_of("0123456789+-.eEdD \t") == std::string::npos) return numbers_in(line);
  std::vector<double> values;
  for (const std::string_view cell : cells_of(line, ' ')) {
    const std::string word = lower_case(cell.substr(cell.starts_with('-') || cell.starts_with('+') ? 1 : 0));
    if (word == "nan" || word == "inf" || word == "infinity" || word.find_first_not_of('*') == std::string::npos) {
      values.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    if (cell.find_first_not_of("0123456789+-.eEdD") != std::string_view::npos)
      in.fail(fmt::format("holds '{}', expected numbers", cell.substr(0, 40)), "write the set again");
    const std::vector<double> numbers = numbers_in(std::string(cell));
    values.insert(values.end(), numbers.begin(), numbers.end());
  }
  return values;
}

void read_text_values(UniversalLines& in, Series& series, const std::string& what, Parts& parts) {
  const Index each = width(series), wanted = series.values * each;
  for (Index k = 0; k < wanted;) {
    const std::string line = in.need(fmt::format("{} after {} of {} values", what, k / each, series.values));
    if (is_delimiter(line))
      in.fail(fmt::format("{} ends after {} of {} values", what, k / each, series.values), "write the set again");
    for (const double value : series_numbers(in, line)) {
      if (k >= wanted) break;
      const Index within = k % each;
      const bool is_stamp = !series.even && within == 0;
      if (is_stamp) series.stamps.add(value);
      if (within == (series.even ? 0 : 1)) parts.add(value);
      if (series.keeps) (is_stamp ? series.at : series.numbers).push_back(value);
      ++k;
    }
  }
}

void read_binary_values(UniversalLines& in, Series& series, const std::string& what, Parts& parts, RecordInfo& info) {
  const std::size_t size = series.is_double() ? 8 : 4;
  // In set 58 an uneven abscissa has four bytes. Some writers use eight, as the byte count shows.
  const std::size_t ordinate = size * (series.is_complex() ? 2 : 1);
  const bool wide = !series.even && series.bytes == (8 + ordinate) * static_cast<std::size_t>(series.values);
  const std::size_t abscissa = series.even ? 0
                               : wide      ? 8
                                           : 4,
                    sample = abscissa + ordinate, expected = sample * static_cast<std::size_t>(series.values);
  if (series.bytes != 0 && series.bytes != expected)
    info.notes.push_back(fmt::format("{} says {} bytes, {} values take {}", what, series.bytes, series.values, expected));
  // A newline too many before the data moves the end of the set by one byte.
  const auto ends_at = [&](std::size_t offset) {
    const std::string tail = in.peek(offset, 9);
    const std::size_t first = tail.find_first_not_of("\r\n");
    return first != std::string::npos && tail.compare(first, 6, "    -1") == 0;
  };
  if (const std::string ahead = in.peek(0, 1); ahead == "\n" && !ends_at(expected) && ends_at(expected + 1)) {
    in.take(1);
    info.notes.push_back(what + " has a newline before its binary data");
  }
  Index done = 0;
  while (done < series.values) {
    const Index n = std::min(kValuesOfAPart, series.values - done);
    const std::string data = in.take(static_cast<std::size_t>(n) * sample);
    const auto complete = static_cast<Index>(data.size() / sample);
    for (Index k = 0; k < complete; ++k) {
      const char* at = data.data() + static_cast<std::size_t>(k) * sample;
      if (!series.even) series.stamps.add(binary_value(at, wide, series.swapped));
      parts.add(binary_value(at + abscissa, series.is_double(), series.swapped));
      if (!series.keeps) continue;
      if (!series.even) series.at.push_back(binary_value(at, wide, series.swapped));
      for (std::size_t part = abscissa; part < sample; part += size)
        series.numbers.push_back(binary_value(at + part, series.is_double(), series.swapped));
    }
    done += complete;
    if (complete < n) in.fail(fmt::format("breaks off in {} after {} of {} values", what, done, series.values), kCopyAgain);
  }
}

/// A set that is no time series, with its values if they were kept.
UniversalFunction function_of(const Series& series) {
  UniversalFunction function = series.as_function;
  function.function = series.function;
  function.number = static_cast<int>(series.channel.position);
  function.other_names = series.channel.other_names;
  function.abscissa = series.abscissa;
  function.complex = series.is_complex();
  function.lines = series.values;
  if (series.even)
    function.at = Eigen::VectorXd::LinSpaced(series.keeps ? series.values : 2, series.start,
                                             series.start + series.step * static_cast<double>(series.values - 1));
  else
    function.at = Eigen::Map<const Eigen::VectorXd>(series.at.data(), std::ssize(series.at));
  const std::size_t each = series.is_complex() ? 2 : 1;
  for (std::size_t k = 0; k + each <= series.numbers.size(); k += each)
    function.ordinate.emplace_back(series.numbers[k], each == 2 ? series.numbers[k + 1] : 0.0);
  return function;
}

void read_series(UniversalLines& in, const std::string& set_line, const Visitor& visit, RecordInfo& info, UniversalData& data,
                 bool keep_functions) {
  const auto number = info.channels.size() + data.functions.size() + 1;
  const std::string what = fmt::format("set 58 number {}", number);
  Series series = read_series_header(in, set_line, what);
  series.channel.position = static_cast<Index>(number);
  series.keeps = keep_functions && !series.is_time();
  Parts parts(visit, series.is_time() ? std::ssize(info.channels) : -1);
  if (series.binary)
    read_binary_values(in, series, what, parts, info);
  else
    read_text_values(in, series, what, parts);
  parts.flush();
  if (!series.even && series.is_time()) {
    RecordInfo own;  // the clock of the first channel is that of all; other rates are compared with it later
    take_clock(series.stamps, series.unit_s, "abscissa", info.channels.empty() ? info : own);
    series.channel.rate_Hz = info.channels.empty() ? info.rate_Hz : own.rate_Hz;
  }
  if (series.is_time())
    info.channels.push_back(series.channel);
  else
    data.functions.push_back(function_of(series));
  expect_end(in, info, series.binary ? "58b" : "58");
}

long set_number(const std::string& line) { return integer_or(field(line, 0, 6), integer_or(field(line, 0, 80), 0)); }

/// A line with the number of a known set and no other text than the fields of 58b.
bool begins_known_set(const std::string& line) {
  constexpr std::array<long, 8> known = {15, 55, 58, 82, 151, 164, 2411, 2412};
  if (!contains(known, set_number(line))) return false;
  return field(line, 0, 80).find_first_not_of("0123456789") == std::string::npos || field(line, 0, 80).starts_with("58b");
}

void read_set(UniversalLines& in, const std::string& set_line, const Visitor& visit, RecordInfo& info, UniversalData& data,
              bool keep_functions) {
  if (const long set = set_number(set_line); set <= 0) {
    in.fail(fmt::format("holds '{}' after -1, expected the number of a set", field(set_line, 0, 40)), "write the file again");
  } else if (set == 58) {
    read_series(in, set_line, visit, info, data, keep_functions);
  } else if (set == 151) {
    data.title = field(need_inside(in, "set 151"), 0, 80);
    data.has_header = true;
    skip_set(in, "151");
  } else if (!read_shape_set(in, set, data)) {
    ++data.others[std::to_string(set)];
    skip_set(in, std::to_string(set));
  }
}

/// Names the channels of a universal file by their first title line. If that is empty or equal for all, the name is the first
/// of these that differs: point and direction of record 6, its name, another title line. The others become further names if
/// they are unique.
/// @param channels  other_names: the five title lines, then the names of record 6
void name_by_difference(std::vector<ChannelInfo>& channels) {
  const auto tells_apart = [&](std::size_t k) {
    std::set<std::string> seen;
    return std::ranges::all_of(channels, [&](const ChannelInfo& c) {
      return k < c.other_names.size() && !c.other_names[k].empty() && c.other_names[k] != "NONE" &&
             seen.insert(c.other_names[k]).second;
    });
  };
  std::size_t most = 0;
  for (const ChannelInfo& channel : channels) most = std::max(most, channel.other_names.size());
  std::vector<std::size_t> telling;
  for (const std::size_t k : {0, 5, 6, 7, 4, 3, 2, 1})  // positions in other_names: five title lines, then record 6
    if (k < most && tells_apart(k)) telling.push_back(k);
  for (ChannelInfo& channel : channels) {
    const std::string title = channel.other_names.front();
    auto names = each_of(telling, [&](std::size_t k) { return channel.other_names[k]; });
    const std::string point = channel.point + channel.direction;
    channel.name = !names.empty() ? names.front() : title.empty() || title == "NONE" ? point : title;
    channel.other_names = std::move(names);
  }
}

}  // namespace

UniversalData scan_universal_sets(const fs::path& file, const Visitor& visit, RecordInfo& info, bool keep_functions) {
  UniversalLines in(file);
  UniversalData data;
  for (std::string line; in.next(line);) {
    if (is_blank(line)) {
      if (in.is_last_without_end() && line.ends_with(' '))
        in.fail("breaks off within a line of blanks, expected -1 or a line end", kCopyAgain);
      continue;
    }
    if (!is_delimiter(line)) {
      // Some writers end a set and begin the next with one -1. Any other text is refused, because its set would be skipped.
      if (!begins_known_set(line))
        in.fail(fmt::format("holds '{}' between two sets, expected -1", field(line, 0, 40)),
                "remove the line, or write the file again");
      info.notes.push_back(fmt::format("line {}: set {} begins without -1 of its own", in.number(), set_number(line)));
      read_set(in, line, visit, info, data, keep_functions);
      continue;
    }
    std::string set_line;
    do {
      if (!in.next(set_line)) in.fail("breaks off after the -1 that begins a set", kCopyAgain);
    } while (is_blank(set_line));
    if (is_delimiter(set_line)) {
      // Two -1 in a row: the second one begins a set.
      in.back(set_line);
      continue;
    }
    read_set(in, set_line, visit, info, data, keep_functions);
  }
  for (auto& [label, position] : data.nodes) position /= data.length_factor;
  return data;
}

bool holds_frequency_responses(const fs::path& file) {
  if (!fs::is_regular_file(file) || !is_universal_file(file)) return false;
  UniversalLines in(file);
  for (std::string line; in.next(line);) {
    if (!is_delimiter(line) || !in.next(line) || set_number(line) != 58) continue;
    const bool is_binary = line.find('b') != std::string::npos;
    for (int record = 1; record <= 6; ++record)
      if (!in.next(line)) return false;
    const long function = integer_or(field(line, 0, 5), 0);
    if (function == kFrequencyResponse || function == kCoherence) return true;
    if (function <= 1 || is_binary) return false;  // time series, or values that are no lines
  }
  return false;
}

RecordInfo scan_universal(const fs::path& file, const Visitor& visit) {
  RecordInfo info;
  const UniversalData data = scan_universal_sets(file, visit, info);
  info.names_channels = true;
  name_by_difference(info.channels);
  const auto responses = std::ranges::count(data.functions, kFrequencyResponse, &UniversalFunction::function);
  info.format = fmt::format("universal file, {} time series, {}{} nodes, {} lines, {} shapes", info.channels.size(),
                            responses > 0 ? fmt::format("{} frequency response functions, ", responses) : "", data.nodes.size(),
                            data.lines.size(), data.results.size());
  for (const ChannelInfo& channel : info.channels) {
    if (channel.rate_Hz > 0.0 && info.rate_Hz == 0.0) {
      info.rate_Hz = channel.rate_Hz;
      info.rate_source = "step of the abscissa";
    }
    if (std::abs(channel.rate_Hz - info.rate_Hz) > 1e-6 * info.rate_Hz) {
      info.notes.push_back(fmt::format("channels have different rates: {} {} Hz, {} {} Hz", info.channels.front().name,
                                       info.channels.front().rate_Hz, channel.name, channel.rate_Hz));
      info.rate_Hz = 0.0;
      break;
    }
    if (std::abs(channel.start - info.channels.front().start) > 0.5) {
      info.notes.push_back(fmt::format("channels have different starts: {} begins {:.6g} samples after {}", channel.name,
                                       channel.start - info.channels.front().start, info.channels.front().name));
      break;
    }
  }
  if (!data.has_header) info.notes.push_back("no set 151 (header)");
  if (!data.has_units) info.notes.push_back("no set 164 (units): coordinates are taken as metres");
  list_response_points(data.functions, info);
  for (const auto& [set, count] : data.others)
    info.notes.push_back(fmt::format("{} set{} {} left out", count, count == 1 ? "" : "s", set));
  return info;
}

}  // namespace twindeck::records
