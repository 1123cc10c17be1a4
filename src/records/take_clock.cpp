#include "records/take_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/letters.hpp"
#include "records/text_cells.hpp"

namespace twindeck::records {
using Eigen::Index;

namespace {

std::string rows_of(Index count, const char* what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

/// One line on all gaps (sign 1) or repeats (sign -1): how many, how long, where the longest lies.
void note_gaps(RecordInfo& info, Index sign, Index all) {
  const ClockGap* longest = nullptr;
  Index count = 0;
  for (const ClockGap& gap : info.clock.gaps) {
    if (sign * gap.samples <= 0) continue;
    ++count;
    if (longest == nullptr || sign * gap.samples > sign * longest->samples) longest = &gap;
  }
  if (longest == nullptr) return;
  const std::string place = place_of(info, longest->row);
  if (sign > 0) {
    info.notes.push_back(
        count == 1 ? fmt::format("a gap in the time stamps: {} missing from {} on, read as NaN", rows_of(all, "sample"), place)
                   : fmt::format("{} gaps in the time stamps, {} missing in all, read as NaN; the longest has {} from {} on",
                                 count, rows_of(all, "sample"), longest->samples, place));
  } else {
    info.notes.push_back(fmt::format("{} from {} on {} time stamps that were there before{}; a second copy is left out",
                                     rows_of(-longest->samples, "row"), place, longest->samples == -1 ? "has" : "have",
                                     count == 1 ? "" : fmt::format(", and so have others, {} in all", all)));
  }
}

void note_faults(RecordInfo& info) {
  const RecordClock& clock = info.clock;
  if (clock.stands_still) info.notes.push_back(info.rate_source + " stands still and says no rate");
  if (clock.hour_again >= 0)
    info.notes.push_back("an hour begins a second time at " + place_of(info, clock.hour_again) +
                         ": read as the end of summer time, the record goes on");
  if (clock.reversed) info.notes.push_back(info.rate_source + ": the time runs backwards throughout");
  if (clock.steps_back >= 0) info.notes.push_back("the time runs backwards at " + place_of(info, clock.steps_back));
  constexpr double even = 2.0;  // [samples] largest scatter of unshared stamps about even ones
  if (clock.shared_by == 1.0 && clock.scatter_s * clock.rate_Hz > even)
    info.notes.push_back(fmt::format("the time stamps lie {:.3g} samples about even ones: the samples may not be evenly spaced",
                                     clock.scatter_s * clock.rate_Hz));
  if (clock.changes_rate >= 0)
    info.notes.push_back("the time stamps run at different rates, at another from " + place_of(info, clock.changes_rate) +
                         " on");
}

}  // namespace

double time_unit_s(const std::string& unit) {
  const std::string text = lower_case(trimmed(unit));
  if (is_one_of("|s|sec|secs|second|seconds|", text)) return 1.0;
  if (is_one_of("|ms|msec|millis|millisecond|milliseconds|", text)) return 1e-3;
  if (is_one_of("|us|\xC2\xB5s|\xCE\xBCs|usec|micros|microseconds|", text)) return 1e-6;
  if (is_one_of("|ns|nsec|nanos|nanoseconds|", text)) return 1e-9;
  if (is_one_of("|min|minutes|", text)) return 60.0;
  if (is_one_of("|h|hours|", text)) return 3600.0;
  return is_one_of("|d|day|days|", text) ? 86400.0 : 0.0;
}

std::pair<std::string, double> without_time_unit(const std::string& name) {
  const std::size_t last = name.find_last_of("_ ([");
  if (last == std::string::npos) return {name, 0.0};
  const std::string before = name.substr(0, name.find_last_not_of("_ ([", last) + 1), text = lower_case(before);
  if (text.ends_with(" of") || text.ends_with("_of")) {  // "ms of day": the last word tells where the time begins
    const double whole = time_unit_s(before.substr(0, before.size() - 3));
    return {name, whole > 0.0 ? whole : without_time_unit(before.substr(0, before.size() - 3)).second};
  }
  const double unit = time_unit_s(name.substr(last + 1, name.find_last_not_of(")]") - last));
  return {unit > 0.0 ? before : name, unit};
}

std::string place_of(const RecordInfo& info, Index row) {
  Index sample = row;
  for (const ClockGap& gap : info.clock.gaps) sample += gap.row < row ? gap.samples : 0;
  const long line = line_of(info, row);
  return fmt::format("sample {}", sample) + (line > 0 ? fmt::format(" (line {})", line) : "");
}

long line_of(const RecordInfo& info, Index row) {
  const auto after = std::ranges::find_if(info.lines, [&](const auto& l) { return l.first > row; });
  return after == info.lines.begin() ? 0 : std::prev(after)->second + (row - std::prev(after)->first);
}

void take_clock(const StampedRows& stamps, double unit_s, const std::string& source, RecordInfo& info) {
  info.clock = stamps.clock(unit_s);
  info.clock_unit_known = unit_s > 0.0;
  info.rate_Hz = info.clock.rate_Hz;
  info.rate_source = source;
  note_gaps(info, 1, info.clock.missing());
  note_gaps(info, -1, info.clock.repeated());
  note_faults(info);
}

void take_stated_rate(double rate_Hz, const std::string& source, RecordInfo& info) {
  if (!(rate_Hz > 0.0)) return;
  if (info.rate_Hz == 0.0) {
    info.rate_Hz = rate_Hz;
    info.rate_source = source;
  } else if (info.clock.rate_Hz > 0.0 && std::abs(rate_Hz - info.rate_Hz) <= kDeviationsOfARate * info.clock.deviation_Hz) {
    info.rate_Hz = rate_Hz;
  } else if (std::abs(rate_Hz / info.rate_Hz - 1.0) > kSameRate) {
    info.notes.push_back(fmt::format("{} says {:.9g} Hz, {} {:.9g} Hz", source, rate_Hz, info.rate_source, info.rate_Hz));
  }
}

Samples on_the_clock(Samples samples, const RecordInfo& info, const std::filesystem::path& file) {
  const RecordClock& clock = info.clock;
  if (info.apart || clock.gaps.empty() || clock.changes_rate >= 0 || clock.steps_back >= 0) return samples;
  const auto back = std::ranges::count_if(clock.gaps, [](const ClockGap& gap) { return gap.samples < 0; });
  double lost = 0.0;
  for (const ClockGap& gap : clock.gaps) {
    lost += static_cast<double>(std::max<Index>(gap.samples, 0));
    if (lost > static_cast<double>(samples.rows()))  // bridged, it would be no measurement
      throw InputError(
          {file.string(), line_of(info, gap.row), ""},
          fmt::format("sample {} comes {:.6g} s after the row before it, a gap of {:.6g} samples; with {:.6g} missing "
                      "by then, more is missing than the {} samples that are there",
                      gap.row, static_cast<double>(gap.samples + 1) / clock.rate_Hz, static_cast<double>(gap.samples), lost,
                      samples.rows()),
          "correct the times if the clock did not stop; else split the record where its clock jumps, into files and "
          "[[record]] tables of their own");
    const Index twice = -gap.samples;
    if (twice <= 0) continue;
    const bool there = gap.row >= twice && gap.row + twice <= samples.rows();
    const auto same = [&](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    if (!there || !samples.middleRows(gap.row, twice).binaryExpr(samples.middleRows(gap.row - twice, twice), same).all())
      throw InputError(
          {file.string(), line_of(info, gap.row), ""},
          fmt::format("the time runs backwards by {:.6g} s at {}, and the rows there are no copy of those before{}",
                      static_cast<double>(twice) / clock.rate_Hz, place_of(info, gap.row),
                      back > 1 ? fmt::format("; it is set back at {} places", back) : ""),
          back > 1 ? "correct the times, or remove the column of time if its clock is of no use and the rate is known"
                   : "split the record there: write the rows from there on into a file and a [[record]] of their own");
  }
  Samples whole(samples.rows() + clock.missing() - clock.repeated(), samples.cols());
  Index from = 0, to = 0;
  const auto copy = [&](Index end) {
    whole.middleRows(to, end - from) = samples.middleRows(from, end - from);
    to += end - from;
    from = end;
  };
  for (const ClockGap& gap : clock.gaps) {
    copy(gap.row);
    if (gap.samples < 0) from -= gap.samples;
    if (gap.samples > 0) whole.middleRows(to, gap.samples).setConstant(std::numeric_limits<double>::quiet_NaN());
    to += std::max<Index>(gap.samples, 0);
  }
  copy(samples.rows());
  return whole;
}

}  // namespace twindeck::records
