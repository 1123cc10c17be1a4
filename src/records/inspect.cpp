#include "records/inspect.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/printable.hpp"
#include "records/recorded_unit.hpp"
#include "records/take_clock.hpp"

namespace twindeck::records {
using Eigen::Index;

void ChannelStatistics::close_run() {
  if (run_ < 3) return;
  if (last_ == lowest_) at_lowest_ += run_;
  if (last_ == highest_) at_highest_ += run_;
}

void ChannelStatistics::add(double value) {
  ++seen_;
  if (!std::isfinite(value)) {
    longest_gap_ = std::max(longest_gap_, ++gap_);
    close_run();
    run_ = 0;
    return;
  }
  gap_ = 0;
  if (run_ > 0 && value == last_) {
    ++run_;
  } else {
    close_run();
    run_ = 1;
  }
  if (there_ == 0 || value < lowest_) {
    lowest_ = value;
    at_lowest_ = 0;
  }
  if (there_ == 0 || value > highest_) {
    highest_ = value;
    at_highest_ = 0;
  }
  last_ = value;
  // Welford's sums keep their digits if the mean is large.
  ++there_;
  const double off = value - mean_;
  mean_ += off / static_cast<double>(there_);
  squares_ += off * (value - mean_);
}

ChannelSummary ChannelStatistics::summary(Index count) const {
  ChannelStatistics closed = *this;
  closed.close_run();
  ChannelSummary summary;
  summary.samples = std::max(count, seen_);
  summary.missing = summary.samples - there_;
  summary.longest_gap = std::max(longest_gap_, gap_ + summary.samples - seen_);
  summary.mean = mean_;
  summary.rms = there_ > 0 ? std::sqrt(squares_ / static_cast<double>(there_)) : 0.0;
  summary.lowest = lowest_;
  summary.highest = highest_;
  summary.dead = there_ == 0 || lowest_ == highest_;
  summary.clipped = summary.dead ? 0 : closed.at_lowest_ + closed.at_highest_;
  return summary;
}

Inspection inspect(const std::filesystem::path& file) {
  Inspection result;
  std::vector<ChannelStatistics> statistics;
  Index samples = 0;
  const Visitor look = [&](Index first_sample, Index first_channel, const Eigen::MatrixXd& block) {
    statistics.resize(std::max(statistics.size(), static_cast<std::size_t>(first_channel + block.cols())));
    samples = std::max(samples, first_sample + block.rows());
    for (Index c = 0; c < block.cols(); ++c) {
      ChannelStatistics& channel = statistics[static_cast<std::size_t>(first_channel + c)];
      for (Index t = 0; t < block.rows(); ++t) channel.add(block(t, c));
    }
  };
  result.info = scan(file, look, {.skip_stray_lines = true});
  const Index lost = result.info.clock.missing();
  Index longest = 0;
  for (const ClockGap& gap : result.info.clock.gaps) longest = std::max(longest, gap.samples);
  for (const ChannelStatistics& channel : statistics) {
    result.channels.push_back(channel.summary(samples));
    ChannelSummary& s = result.channels.back();
    s.samples += lost;
    s.missing += lost;
    s.longest_gap = std::max(s.longest_gap, longest);
  }
  result.channels.resize(result.info.channels.size());
  for (const ChannelInfo& point : result.info.response_points) {
    result.info.channels.push_back(point);
    result.channels.emplace_back().samples = point.samples;
  }
  return result;
}

namespace {

// Bytes of a name or unit, and of a note, that are shown.
constexpr std::size_t kLongestShown = 100, kLongestNote = 1000;

constexpr double kNearGravity = 0.05;   ///< [g] between a mean and gravity: offset of an uncalibrated sensor
constexpr double kBesideGravity = 0.2;  ///< [g] RMS: with gravity in the mean, ambient vibration is far below this
constexpr double kBelowAnyUnit = 1e-7;  ///< RMS: smaller values are below the noise of accelerometers in any unit
constexpr double kAmbientInG = 3e-3;    ///< RMS: the vibration of bridges is below this in g; in m/s² it may be above

/// Guesses the unit of ambient vibration from the size of the numbers.
std::string guess(const ChannelSummary& channel) {
  const double mean = std::abs(channel.mean), rms = channel.rms;
  if (channel.dead) return "";
  if (std::abs(mean - 9.81) < kNearGravity * 10.0) return "m/s² with gravity in it, by the mean";
  if (std::abs(mean - 1.0) < kNearGravity && rms < kBesideGravity) return "g with gravity in it, by the mean";
  if (std::abs(mean - 1000.0) < kNearGravity * 1000.0) return "mg with gravity in it, by the mean";
  if (rms < kBelowAnyUnit) return "too small for any usual unit: gain or volts?";
  if (rms < kAmbientInG) return "g or m/s², by the size";
  if (rms < 1.0) return "m/s² or V, by the size";
  return "mg, mV, µm or counts, by the size";
}

std::string deviation_of(const RecordInfo& info) {
  return info.clock.deviation_Hz > 1e-9 * info.rate_Hz ? fmt::format(" +- {:.2g} Hz", info.clock.deviation_Hz) : "";
}

/// Deviation of the time stamps from even ones, with missing and repeated samples.
std::string stamps_of(const RecordInfo& info) {
  constexpr std::size_t most = 10;  // gaps that are listed
  const RecordClock& clock = info.clock;
  std::string text = fmt::format("{:.4g} sample{} each, {:.2g} s about even ones (robust deviation){}", clock.shared_by,
                                 clock.shared_by == 1.0 ? "" : "s", clock.scatter_s,
                                 info.clock_unit_known ? "" : "; their unit is not given, the likely one is taken");
  text += clock.gaps.empty() ? "; no gaps, no repeats" : "";
  for (std::size_t k = 0; k < std::min(clock.gaps.size(), most); ++k) {
    const ClockGap& gap = clock.gaps[k];
    text += gap.samples > 0 ? fmt::format("; {} missing from {} on", gap.samples, place_of(info, gap.row))
                            : fmt::format("; {} there twice from {} on", -gap.samples, place_of(info, gap.row));
  }
  return text + (clock.gaps.size() > most ? fmt::format("; {} more", clock.gaps.size() - most) : "");
}

}  // namespace

std::vector<std::string> describe(const Inspection& inspection) {
  const RecordInfo& info = inspection.info;
  std::vector<std::string> lines = {printable(fmt::format("format    {}", info.format))};
  Index samples = 0;
  for (const ChannelSummary& channel : inspection.channels) samples = std::max(samples, channel.samples);
  lines.push_back(
      fmt::format("channels  {}, {} {}{}", info.channels.size(), samples, info.response_points.empty() ? "samples" : "lines",
                  info.rate_Hz > 0.0 ? fmt::format(", {:.6g} s", static_cast<double>(samples) / info.rate_Hz) : ""));
  const bool has_rate = info.response_points.empty();  // frequency response functions have none
  if (!has_rate) lines.push_back(printable("functions " + info.functions));
  if (has_rate)
    lines.push_back(info.rate_Hz > 0.0 ? fmt::format("rate      {:.9g} Hz{}, from the {}", info.rate_Hz, deviation_of(info),
                                                     printable(info.rate_source))
                                       : "rate      unknown");
  if (info.clock.rate_Hz > 0.0) lines.push_back("stamps    " + stamps_of(info));
  lines.push_back(fmt::format("{:<24} {:<12} {:>10} {:>9} {:>9} {:>8} {:>12} {:>12}", "channel", "unit", "samples", "missing",
                              "longest", "clipped", "mean", "rms"));
  std::vector<std::string> missing;
  bool unknown_unit = false;
  for (std::size_t c = 0; c < info.channels.size(); ++c) {
    const ChannelInfo& channel = info.channels[c];
    const ChannelSummary& s = inspection.channels[c];
    const bool known = si_factor(channel.unit) > 0.0;
    std::string remark = s.dead ? "  constant" : "";
    if (channel.unit.empty()) {
      remark += s.dead ? "" : !has_rate ? "  unit not given" : "  unit not given: " + guess(s);
      unknown_unit = true;
    } else if (!known) {
      remark += "  no unit of motion";
      unknown_unit = true;
    }
    if (s.clipped > 0) remark += fmt::format("  stays at {:.6g} or {:.6g}", s.lowest, s.highest);
    lines.push_back(fmt::format("{:<24} {:<12} {:>10} {:>9} {:>9} {:>8} {:>12.5g} {:>12.5g}{}",
                                printable(channel.name, kLongestShown),
                                channel.unit.empty() ? "?" : printable(channel.unit, kLongestShown), s.samples, s.missing,
                                s.longest_gap, s.clipped, s.mean, s.rms, remark));
  }
  for (const std::string& note : info.notes) lines.push_back("note      " + printable(note, kLongestNote));
  if (has_rate && info.rate_Hz == 0.0) missing.push_back("the sampling rate (campaign.toml: sampling_rate_Hz)");
  if (unknown_unit) missing.push_back("units (channels.csv: unit and gain to SI)");
  missing.push_back("positions and directions of the sensors (channels.csv)");
  lines.push_back("missing   " + fmt::format("{}", fmt::join(missing, "; ")));
  return lines;
}

}  // namespace twindeck::records
