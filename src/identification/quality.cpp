#include "identification/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

#include "core/statistics.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr double kLeastDeviations = 10.0;  // a sample nearer than this belongs to the normal distribution of the record
constexpr Index kLongest = 3;              // different values in a row; one value, held, counts once
constexpr Index kAround = 10;              // samples on each side that are compared
constexpr double kQuiet = 1.0 / 20.0;  // of the distance; beside a filtered pulse neighbours have more, on a shaking table 0.1
constexpr double kSame = 0.5;          // of the distance; samples above it belong to the same group
constexpr Index kDrawn = 65536;        // samples for the median
constexpr double kNormal = 1.4826;     // deviation of a normal distribution over its median absolute deviation

/// The existing samples. In a long record, a random draw gives the median to a hundredth of a deviation. The seed is fixed.
/// Evenly spaced samples could fall into step with a sine.
std::vector<double> drawn(const Eigen::Ref<const Eigen::VectorXd>& x) {
  std::vector<double> values;
  const bool all = x.size() <= kDrawn;
  std::mt19937_64 random(1);
  for (Index k = 0; k < std::min<Index>(x.size(), kDrawn); ++k) {
    const Index t = all ? k : static_cast<Index>(random() % static_cast<std::uint64_t>(x.size()));
    if (std::isfinite(x[t])) values.push_back(x[t]);
  }
  return values;
}

/// Distances of samples from the median, and their robust deviation.
class Distance {
 public:
  explicit Distance(const Eigen::Ref<const Eigen::VectorXd>& x) : x_(x) {
    std::vector<double> values = drawn(x);
    if (values.empty()) return;
    middle_ = upper_median(values);
    for (double& value : values) value = std::abs(value - middle_);
    deviation_ = kNormal * upper_median(values);
    if (deviation_ > 0.0) return;
    for (Index t = 0; t < size(); ++t) {  // if most samples are one value, the unit is the distance to the next value
      const double d = at(t);
      if (d > 0.0 && (deviation_ == 0.0 || d < deviation_)) deviation_ = d;
    }
  }
  [[nodiscard]] Index size() const { return x_.size(); }
  [[nodiscard]] double at(Index t) const { return std::abs(x_[t] - middle_); }  // NaN or infinite if the sample is missing
  [[nodiscard]] double deviation() const { return deviation_; }

 private:
  Eigen::Ref<const Eigen::VectorXd> x_;
  double middle_ = 0.0, deviation_ = 0.0;
};

/// Whether the samples on one side are small beside a distance. @param first  next to the group @param step  1 or -1
bool is_quiet(const Distance& distance, Index first, Index step, double large) {
  std::vector<double> side;
  for (Index k = 0, t = first; k < kAround && t >= 0 && t < distance.size(); ++k, t += step)
    if (std::isfinite(distance.at(t))) side.push_back(distance.at(t));
  return side.empty() || (side.front() < kQuiet * large && upper_median(side) < kQuiet * large);
}

/// Number of samples in the group around t if it stands alone, else 0.
Index alone_around(const Distance& distance, Index t) {
  const double large = distance.at(t);
  Index begin = t, end = t + 1, values = 1;
  const auto goes_on = [&](Index from, Index to) {
    if (to < 0 || to >= distance.size() || values > kLongest || !(distance.at(to) >= kSame * large)) return false;
    values += distance.at(to) != distance.at(from) ? 1 : 0;
    return true;
  };
  while (goes_on(begin, begin - 1)) --begin;
  while (goes_on(end - 1, end)) ++end;
  const bool alone = values <= kLongest && is_quiet(distance, begin - 1, -1, large) && is_quiet(distance, end, 1, large);
  return alone ? end - begin : 0;
}

ChannelQuality quality_of(const Eigen::Ref<const Eigen::VectorXd>& x) {
  ChannelQuality q;
  q.samples = x.size();
  double sum = 0.0, lowest = 0.0, highest = 0.0;
  long run = 0, there = 0;
  for (Index t = 0; t < x.size(); ++t) {
    run = std::isfinite(x[t]) ? 0 : run + 1;
    q.longest_gap = std::max(q.longest_gap, run);
    if (run > 0) continue;
    lowest = there == 0 ? x[t] : std::min(lowest, x[t]);
    highest = there == 0 ? x[t] : std::max(highest, x[t]);
    sum += x[t];
    ++there;
  }
  q.missing = q.samples - there;
  if (there == 0 || lowest == highest) {
    q.mean = lowest;
    q.dead = true;
    return q;
  }
  q.mean = sum / static_cast<double>(there);
  q.held = held_samples(x);
  q.clipped = q.held * clipped_samples(x(Eigen::seq(0, Eigen::last, q.held)), lowest, highest);
  q.lone = lone_sample(x);
  // Least-squares line in u in [-1, 1] over the existing samples.
  double squares = 0.0, u_sum = 0.0, u_squares = 0.0, product = 0.0;
  for (Index t = 0; t < x.size(); ++t) {
    if (!std::isfinite(x[t])) continue;
    const double u = x.size() < 2 ? 0.0 : 2.0 * static_cast<double>(t) / static_cast<double>(x.size() - 1) - 1.0,
                 v = x[t] - q.mean;
    squares += v * v;
    u_sum += u;
    u_squares += u * u;
    product += u * v;
  }
  q.rms = std::sqrt(squares / static_cast<double>(there));
  q.drift = 2.0 * product / (u_squares - u_sum * u_sum / static_cast<double>(there)) / q.rms;
  return q;
}

constexpr long kRun = 3;             // samples in a row at an extreme value; no motion does that
constexpr long kFewestAtRail = 10;   // fewer samples at the extreme may be chance: 0.03 % of a short record of 30,000 samples
constexpr std::size_t kNearby = 10;  // number of values next to the extreme one for comparison
constexpr double kPile = 5.0;        // times the samples of those values; the crest of a sine has half as many
constexpr double kRounding = 1e-9;   // [-] of the range: values closer than this are one value

/// Whether the extreme value has far more samples than the values next to it. @param sign  1: the largest, -1: the smallest
bool is_rail(const Eigen::Ref<const Eigen::VectorXd>& x, double extreme, double sign, double range) {
  std::vector<double> below;
  for (Index t = 0; t < x.size(); ++t)
    if (std::isfinite(x[t])) below.push_back(sign * (extreme - x[t]));
  std::ranges::sort(below);
  std::vector<long> samples;  // of the extreme value and of the next ones
  auto from = below.begin();
  while (from != below.end() && samples.size() <= kNearby) {
    const auto to = std::upper_bound(from, below.end(), *from + kRounding * range);
    samples.push_back(static_cast<long>(to - from));
    from = to;
  }
  if (from == below.end()) return false;  // too few values: the other end is among them
  return static_cast<double>(samples.front()) >
         kPile * static_cast<double>(*std::max_element(samples.begin() + 1, samples.end()));
}

}  // namespace

std::optional<LoneSample> lone_sample(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() < 2 * kAround + kLongest) return {};
  const Distance distance(x);
  std::optional<LoneSample> found;
  double least = kLeastDeviations * distance.deviation();
  for (Index t = 0; t < x.size(); ++t) {
    const double d = distance.at(t);
    if (!(d > least) || !std::isfinite(d) || (t > 0 && x[t] == x[t - 1])) continue;  // a value that is held, once
    const Index samples = alone_around(distance, t);
    if (samples == 0) continue;
    found = LoneSample{t, x[t], d / distance.deviation(), samples};
    least = d;
  }
  return found;
}

long held_samples(const Eigen::Ref<const Eigen::VectorXd>& x) {
  constexpr std::ptrdiff_t fewest = 64;  // values
  constexpr double most = 0.98;          // of the stretches: a lost row changes two
  std::vector<long> held;
  for (Index t = 1, from = 0; t < x.size(); ++t)
    if (x[t] != x[t - 1]) held.push_back(t - std::exchange(from, t));
  if (std::ssize(held) < fewest) return 1;
  std::ranges::nth_element(held, held.begin() + std::ssize(held) / 2);
  const long usual = held[held.size() / 2];
  const auto whole = std::ranges::count_if(held, [&](long samples) { return samples % usual == 0; });  // two equal values too
  return static_cast<double>(whole) >= most * static_cast<double>(held.size()) ? usual : 1;
}

std::vector<ChannelQuality> channel_quality(const Samples& data, const std::vector<std::string>& channels,
                                            const std::string& setup, const std::string& record) {
  std::vector<ChannelQuality> rows;
  for (Index c = 0; c < data.cols(); ++c) {
    rows.push_back(quality_of(data.col(c)));
    rows.back().setup = setup;
    rows.back().record = record;
    rows.back().channel = channels[static_cast<std::size_t>(c)];
  }
  return rows;
}

long fill_gaps(Eigen::MatrixXd& data, const std::vector<std::string>& channels, long longest, const std::string& record) {
  long filled = 0;
  for (Index c = 0; c < data.cols(); ++c) {
    for (Index t = 0; t < data.rows(); ++t) {
      if (std::isfinite(data(t, c))) continue;
      Index end = t;
      while (end < data.rows() && !std::isfinite(data(end, c))) ++end;
      const long gap = end - t;
      if (gap > longest || t == 0 || end == data.rows()) {
        long most = 0;
        bool bridges = true;  // each gap lies between samples, and less is missing than measured
        for (Index k = 0; k < data.cols(); ++k) {
          const ChannelQuality q = quality_of(data.col(k));
          most = std::max(most, q.longest_gap);
          const bool ends = std::isfinite(data(0, k)) && std::isfinite(data(data.rows() - 1, k));
          bridges = bridges && ends && 2 * q.missing < q.samples;
        }
        throw UnusableRecord(
            {record, 0, channels[static_cast<std::size_t>(c)]},
            fmt::format("has a gap of {} samples from sample {} on, expected none over {} and none at an end", gap, t, longest),
            fmt::format("cut the record, leave the channel out (--set 'exclude=[\"{}\"]'){}",
                        channels[static_cast<std::size_t>(c)],
                        !bridges ? "" : fmt::format(", or bridge gaps (--set longest_gap={})", most)));
      }
      const double before = data(t - 1, c), step = (data(end, c) - before) / static_cast<double>(gap + 1);
      for (Index k = t; k < end; ++k) data(k, c) = before + step * static_cast<double>(k - t + 1);
      filled += gap;
      t = end;
    }
  }
  return filled;
}

long clipped_samples(const Eigen::Ref<const Eigen::VectorXd>& x, double lowest, double highest) {
  const auto at = [&](double extreme) { return static_cast<long>((x.array() == extreme).count()); };
  const long at_lowest = at(lowest), at_highest = at(highest);
  const double range = highest - lowest;
  const bool low_rail = at_lowest >= kFewestAtRail && is_rail(x, lowest, -1.0, range),
             high_rail = at_highest >= kFewestAtRail && is_rail(x, highest, 1.0, range);
  long clipped = (low_rail ? at_lowest : 0) + (high_rail ? at_highest : 0), run = 0;
  for (Index t = 0; t <= x.size(); ++t) {
    const bool at_limit = t < x.size() && (x[t] == lowest || x[t] == highest);
    if (at_limit && (run == 0 || x[t] == x[t - 1])) {
      ++run;
      continue;
    }
    const bool counted = run > 0 && (x[t - 1] == lowest ? low_rail : high_rail);
    if (run >= kRun && !counted) clipped += run;
    run = at_limit ? 1 : 0;
  }
  return clipped;
}

}  // namespace twindeck::identification
