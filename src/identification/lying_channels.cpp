#include "identification/lying_channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "core/lists.hpp"
#include "core/statistics.hpp"

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr double kStuck = 0.05;            ///< [-] share of repeated samples, which changes the shape by several per cent
constexpr double kHeld = 0.01;             ///< [-] the same, in one run that resolution does not explain
constexpr double kAlone = 10.0;            ///< times the tenth longest run: a longer run is not due to resolution
constexpr double kRoundingOfGain = 1e-12;  ///< [-] rounding of equal values by the gain
constexpr double kCopy = 0.01;             ///< [RMS] largest rounding error of a copy; two sensors differ by more noise
constexpr double kFiveDigits = 1e-4;       ///< [-] resolution of a number with five digits
constexpr double kSameValues = 1e-9;       ///< [-] tolerance of factor and offset for equal values

struct Run {
  Index first = 0, length = 0;
  Index usual = 1;  ///< length of the tenth longest run
};

Run longest_run(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Run best, now;
  std::vector<Index> lengths;  // of the runs that have ended
  for (Index t = 0; t < x.size(); ++t) {
    const bool same = t > 0 && x[t] == x[t - 1];
    if (!same && now.length > 1) lengths.push_back(now.length);
    now = same ? Run{now.first, now.length + 1, 1} : Run{t, std::isfinite(x[t]) ? 1 : 0};
    if (now.length > best.length) best = now;
  }
  constexpr std::size_t tenth = 9;
  if (lengths.size() <= tenth) return best;
  std::nth_element(lengths.begin(), lengths.begin() + tenth, lengths.end(), std::greater<>());
  best.usual = lengths[tenth];
  return best;
}

std::pair<Index, Index> extremes(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Index low = 0, high = 0;
  for (Index t = 1; t < x.size(); ++t) {
    if (std::isnan(x[low]) || x[t] < x[low]) low = t;
    if (std::isnan(x[high]) || x[t] > x[high]) high = t;
  }
  return {low, high};
}

/// The step of a channel, from its converter or its number of decimals: all values are whole multiples of it. Infinite if there
/// is none.
double resolution(const Eigen::Ref<const Eigen::VectorXd>& x) {
  constexpr double whole = 0.05, none = std::numeric_limits<double>::infinity();  // largest distance from a whole number
  std::vector<double> values;
  std::copy_if(x.begin(), x.end(), std::back_inserter(values), [](double value) { return std::isfinite(value); });
  std::ranges::sort(values);
  double step = none;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] > values[k - 1]) step = std::min(step, values[k] - values[k - 1]);
  const auto off = [&](double value) { return std::abs(std::remainder((value - values.front()) / step, 1.0)) > whole; };
  return std::ranges::any_of(values, off) ? none : step;
}

/// A channel b = factor a + offset.
struct Copy {
  double factor = 1.0, offset = 0.0;
};

/// Factor and offset if b follows from a in every sample, within the resolution of either; if that is coarse beside the motion,
/// within rounding.
/// @param rms_b  of b @param at  extremes of a
std::optional<Copy> copy_of(const Eigen::Ref<const Eigen::VectorXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b,
                            double rms_b, std::pair<Index, Index> at) {
  const auto [low, high] = at;
  const double factor = (b[high] - b[low]) / (a[high] - a[low]), offset = b[low] - factor * a[low];
  const auto follows = [&, bottom = low](double apart) {
    for (Index t = 0; t < a.size(); ++t)
      if (!(std::abs(b[t] - b[bottom] - factor * (a[t] - a[bottom])) <= apart) && !(std::isnan(a[t]) && std::isnan(b[t])))
        return false;
    return true;
  };
  if (!follows(kCopy * rms_b)) return {};
  const double largest = 2.0 * std::max(std::abs(b[high]), std::abs(b[low])) + std::abs(offset);
  double within = kRoundingOfGain * largest;
  for (const double resolved : {resolution(b) + std::abs(factor) * resolution(a), kFiveDigits * largest})
    if (resolved <= kCopy * rms_b) within = std::max(within, resolved);
  if (!follows(within)) return {};
  return Copy{factor, offset};
}

/// Whether a channel is a pure sine: its second difference is proportional to it. Two channels with the same sine are no
/// copies.
bool is_tone(const Eigen::Ref<const Eigen::VectorXd>& x) {
  constexpr double other = 1e-3;  // [-] of the power of the second difference that may remain
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (Index t = 1; t + 2 < x.size(); ++t) {
    const double d = x[t + 1] - x[t], y = x[t + 2] - x[t + 1] - 2.0 * d + x[t] - x[t - 1];
    xx += d * d;
    xy += d * y;
    yy += y * y;
  }
  return yy - xy * xy / xx <= other * yy;
}

/// Whether every sample is one more than the last: a counter of rows, which loggers write beside the time.
bool counts_rows(const Eigen::Ref<const Eigen::VectorXd>& x) {
  constexpr double rounding = 1e-6;  // [-] of a step
  const double step = x.size() > 2 ? x[1] - x[0] : 0.0;
  for (Index t = 1; t < x.size(); ++t)
    if (!(std::abs(x[t] - x[t - 1] - step) <= rounding * std::abs(step))) return false;
  return step != 0.0;
}

double median_rms(const JudgedChannels& judged, const std::vector<ChannelQuality>& quality) {
  return upper_median(each_of(judged.columns, [&](Index c) { return quality[static_cast<std::size_t>(c)].rms; }));
}

void judge_motion(const Samples& raw, const JudgedChannels& judged, std::vector<ChannelQuality>& quality) {
  const double usual = median_rms(judged, quality);
  const auto runs = each_of(judged.columns, [&](Index c) { return longest_run(raw.col(c)); });
  const auto stuck = [&](const Run& run) {
    const bool held = !judged.may_rest && static_cast<double>(run.length) > kAlone * static_cast<double>(run.usual);
    return static_cast<double>(run.length - 1) > (held ? kHeld : kStuck) * static_cast<double>(raw.rows());
  };
  const bool most = 2 * std::ranges::count_if(runs, stuck) > std::ssize(runs);
  for (std::size_t k = 0; k < judged.columns.size(); ++k) {
    ChannelQuality& q = quality[static_cast<std::size_t>(judged.columns[k])];
    if (q.dead) {
      q.left_out = fmt::format("is constant ({}) over {} samples", q.mean, q.samples);
    } else if (counts_rows(raw.col(judged.columns[k]))) {
      q.left_out = "counts its rows: each sample is one step on from the last";
    } else if (q.rms < kUnresolved * usual) {
      q.left_out = fmt::format("does not move: its RMS is {:.3g} beside {:.3g} of the others", q.rms, usual);
    } else if (stuck(runs[k]) && !(judged.may_rest && most)) {
      q.left_out = fmt::format("is stuck: it holds {:.6g} over {} samples in a row from sample {} on, {:.3g} % of the record",
                               raw(runs[k].first, judged.columns[k]), runs[k].length, runs[k].first,
                               100.0 * static_cast<double>(runs[k].length) / static_cast<double>(raw.rows()));
    }
  }
}

}  // namespace

void judge_channels(const Samples& raw, const JudgedChannels& judged, std::vector<ChannelQuality>& quality) {
  if (judged.columns.empty() || raw.rows() == 0) return;
  judge_motion(raw, judged, quality);
  const std::vector<ChannelQuality> moving = quality;
  std::ptrdiff_t scaled = 0;
  for (std::size_t i = 0; i < judged.columns.size(); ++i) {
    const auto at = extremes(raw.col(judged.columns[i]));
    for (std::size_t j = i + 1; j < judged.columns.size(); ++j) {
      ChannelQuality *a = &quality[static_cast<std::size_t>(judged.columns[i])],
                     *b = &quality[static_cast<std::size_t>(judged.columns[j])];
      if (!a->left_out.empty() || !b->left_out.empty()) continue;
      const auto copy = copy_of(raw.col(judged.columns[i]), raw.col(judged.columns[j]), b->rms, at);
      if (!copy) continue;
      const double factor = copy->factor * judged.gain[i] / judged.gain[j],
                   offset = std::abs(copy->offset) < kSameValues * b->rms ? 0.0 : copy->offset / judged.gain[j];
      const bool same = std::abs(factor - 1.0) < kSameValues && offset == 0.0;
      // In a decay in a single mode, and in a sine, all channels are proportional.
      if (!same && (judged.may_rest || is_tone(raw.col(judged.columns[i])))) continue;
      scaled += same ? 0 : 1;
      if (judged.reference[j] && !judged.reference[i]) std::swap(a, b);
      b->left_out = same ? fmt::format("is a copy of {}: both hold the same values", a->channel)
                         : fmt::format("is a copy of {}: in each sample {} = {:.6g} {} {} {:.6g}", a->channel,
                                       quality[static_cast<std::size_t>(judged.columns[j])].channel, factor,
                                       quality[static_cast<std::size_t>(judged.columns[i])].channel, offset < 0.0 ? "-" : "+",
                                       std::abs(offset));
    }
  }
  // If all channels are proportional, the motion has one shape and no noise, and no channel is a copy.
  if (scaled > 1 && scaled + 1 == std::ssize(judged.columns)) quality = moving;
}

}  // namespace twindeck::identification
