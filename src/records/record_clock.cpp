#include "records/record_clock.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "records/clock_turns.hpp"
#include "records/lost_rows.hpp"
#include "records/round_rate.hpp"

namespace twindeck::records {

using Eigen::Index;

namespace {

constexpr double kNormal = 1.4826;    ///< standard deviation of a normal distribution over its median absolute deviation
constexpr double kAlone = 0.6;        ///< [samples] least gap between unshared stamps; rounding is less
constexpr double kShared = 1.5;       ///< [packets] least gap between shared stamps, where a row's position is uncertain
constexpr double kNoise = 20.0;       ///< robust deviations of the envelope that a gap must exceed
constexpr double kRowsOfALag = 50.0;  ///< least packets between two shared stamps for a slope, certain to 2 %
constexpr double kEvenSlopes = 0.2;   ///< [-] quartile range of slopes over their median; below it most slopes contain no gap
constexpr std::size_t kWidest = 64;   ///< largest number of stamps that the envelope looks ahead and back
constexpr std::size_t kStretch = 32;  ///< stamps of a stretch; gaps in half of them mean another rate
constexpr double kEven = 1.0;         ///< [samples] most scatter of even stamps about a line
constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kSharesOfADay = 0.02;  ///< of a period: a step back from its last to its first 2 % begins it anew
/// Where clocks begin anew: at midnight in s, ms, us and days; where 32 bits of ticks are full; with the GPS week in s, ms.
constexpr std::array<double, 7> kPeriods = {86400.0, 86400e3, 86400e6, 1.0, 4294967296.0, 604800.0, 604800e3};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double robust_deviation(std::vector<double> values) {
  const double middle = quantile(values, 0.5);
  for (double& value : values) value = std::abs(value - middle);
  return kNormal * quantile(std::move(values), 0.5);
}

/// Stamps of one file, during the search for its clock.
struct Search {
  std::vector<double> row, time;  ///< of each stamp: first row, and time after the first stamp's
  bool shared = false;
  double packet = 1.0;  ///< rows that arrive together, several times under one stamp; 1 if the rows of a stamp vary by one
  double step = 0.0;    ///< of a sample
  std::vector<Index> missing;  ///< m of each stamp
  [[nodiscard]] std::size_t size() const { return row.size(); }
  /// The first stamp in use. If rows share stamps, the first stamp is skipped: it may have begun before the record.
  [[nodiscard]] std::size_t begin() const { return shared && size() > 2 ? 1 : 0; }
  [[nodiscard]] double place(std::size_t k) const { return row[k] + static_cast<double>(missing[k]); }
};

/// Rows that arrive together, if stamps are coarser than their packets (packets of 25, whole seconds): then each stamp has a
/// multiple of them, not always the same one. The longest such divisor of the usual number of rows.
double rows_of_a_packet(const Search& s) {
  constexpr std::size_t fewest = 3;  // stamps with another number of rows; single ones are gaps
  constexpr double most = 0.9;       // of these are multiples of a packet, as its loss leaves one
  std::vector<double> rows, others;
  for (std::size_t k = s.begin(); k + 1 < s.size(); ++k) rows.push_back(s.row[k + 1] - s.row[k]);
  const double usual = quantile(rows, 0.5);
  std::ranges::copy_if(rows, std::back_inserter(others), [&](double count) { return count != usual; });
  for (double packet = usual; others.size() >= fewest && packet > 1.0; --packet) {
    if (std::fmod(usual, packet) != 0.0) continue;
    const auto whole = std::ranges::count_if(others, [&](double count) { return std::fmod(count, packet) == 0.0; });
    if (static_cast<double>(whole) >= most * static_cast<double>(others.size())) return packet;
  }
  return 1.0;
}

/// First estimate of the step: slopes between stamps so far apart that most of them agree. The mean of the slopes near the
/// median keeps the digits.
double first_step(const Search& s) {
  const std::size_t n = s.size(), begin = s.begin();
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t lag = 1; lag == 1 || lag <= (n - begin) / 3; lag *= 2) {
    std::vector<double> slopes;
    for (std::size_t k = begin; k + lag < n; ++k) slopes.push_back((s.time[k + lag] - s.time[k]) / (s.row[k + lag] - s.row[k]));
    const double rows = (s.row[n - 1] - s.row[0]) / static_cast<double>(n - 1) * static_cast<double>(lag);
    const double middle = quantile(slopes, 0.5);
    if (middle <= 0.0 || (s.shared && rows < kRowsOfALag * s.packet && 2 * lag <= (n - begin) / 3)) continue;
    const double spread = (quantile(slopes, 0.75) - quantile(slopes, 0.25)) / middle;
    if (spread >= least) continue;
    least = spread;
    double time = 0.0, length = 0.0;
    for (std::size_t k = begin; k + lag < n; ++k) {
      if (std::abs(slopes[k - begin] - middle) > 0.5 * middle) continue;
      time += s.time[k + lag] - s.time[k];
      length += s.row[k + lag] - s.row[k];
    }
    best = time / length;
    if (spread <= kEvenSlopes) break;
  }
  return best;
}

/// The smallest residual of `width` stamps from each one on.
std::vector<double> lowest_ahead(const std::vector<double>& residual, std::size_t width) {
  std::vector<double> lowest(residual.size());
  std::vector<std::size_t> queue;  // ascending values from the back; read at `first`
  for (std::size_t k = residual.size(), first = 0; k-- > 0;) {
    while (queue.size() > first && residual[queue.back()] >= residual[k]) queue.pop_back();
    queue.push_back(k);
    while (queue[first] >= k + width) ++first;
    lowest[k] = residual[queue[first]];
  }
  return lowest;
}

/// Number of stamps that the envelope looks ahead, and the least rise that is a gap.
struct Envelope {
  std::size_t width = 4;
  double least = 0.0, noise = 0.0;
};

Envelope envelope_of(const std::vector<double>& residual, const Search& s) {
  Envelope envelope;
  const double step = s.step, base = (s.shared ? kShared * s.packet : kAlone) * step;
  for (;; envelope.width *= 2) {
    std::vector<double> change, folded;
    double last = 0.0;
    for (std::size_t k = 0; k + envelope.width <= residual.size(); k += envelope.width) {
      const auto begin = residual.begin() + static_cast<long>(k);
      const double low = *std::min_element(begin, begin + static_cast<long>(envelope.width));
      if (k > 0) change.push_back(low - last);
      if (k > 0)
        folded.push_back(std::remainder(low - last, s.packet * step));  // the remainder hides gaps, however many there are
      last = low;
    }
    envelope.noise = robust_deviation(std::move(folded)) / std::sqrt(2.0);
    if (kNoise * envelope.noise > base) envelope.noise = robust_deviation(std::move(change)) / std::sqrt(2.0);
    envelope.least = std::max(base, kNoise * envelope.noise);
    if (envelope.least <= base || 2 * envelope.width > kWidest || 16 * envelope.width > residual.size()) return envelope;
  }
}

/// Whether the envelope rises most at k, within its width. Late stamps before a gap would raise it too early.
bool is_steepest(const std::vector<double>& ahead, std::size_t k, std::size_t width) {
  if (width == Envelope().width) return true;  // no stamp is late: gaps are where they appear
  for (std::size_t j = k + 1; j < std::min(k + width, ahead.size()); ++j)
    if (ahead[j] - ahead[j - 1] > ahead[k] - ahead[k - 1]) return false;
  return true;
}

/// Finds missing and repeated samples with the current step. @return whether m has changed
/// @param full  set where many short gaps add up
bool find_gaps(Search& s, std::vector<ClockGap>& gaps, Index& changes_rate, const FullStretches* full = nullptr) {
  const std::size_t n = s.size();
  std::vector<double> residual(n), level(n);
  for (std::size_t k = 0; k < n; ++k) residual[k] = s.time[k] - s.step * s.row[k];
  const Envelope envelope = full ? Envelope{.least = kShared * full->constant} : envelope_of(residual, s);
  const std::vector<double> ahead = lowest_ahead(residual, envelope.width);
  std::vector<Index> missing(n, 0);
  std::vector<std::size_t> at;
  gaps.clear();
  changes_rate = -1;
  double shift = 0.0;
  const std::size_t begin = s.begin();
  level[begin] = residual[begin];
  for (std::size_t k = begin + 1; k < n; ++k) {
    const std::size_t reach = std::max(envelope.width, full ? full->stamps / 2 : 0),
                      back = std::max(begin, k < reach ? 0 : k - reach);
    const double behind = *std::min_element(level.begin() + static_cast<long>(back), level.begin() + static_cast<long>(k));
    // At either end of the record the minimum is over fewer residuals and is less certain.
    const auto least = [&](std::size_t seen) {
      const double share = static_cast<double>(envelope.width) / static_cast<double>(std::min(seen, envelope.width));
      return std::max(envelope.least, kNoise * envelope.noise * share);
    };
    const double up = ahead[k] - shift - behind, down = behind - (residual[k] - shift);
    double samples = 0.0;
    if (up > least(n - k) && is_steepest(ahead, k, envelope.width)) samples = std::round(up / s.step);
    if (down > least(k - begin)) samples = std::round(std::min(up, 0.0) / s.step);
    if (samples != 0.0) {
      constexpr double most = 1e15;  // samples, so that sums stay whole numbers
      const auto count = static_cast<Index>(std::clamp(samples, -most, most));
      const bool within = count < 0 && s.time[k] > s.time[k - 1];  // the repeated row shares a stamp before this one
      gaps.push_back({static_cast<Index>(s.row[k]) + (within ? count : 0), count});
      shift += static_cast<double>(count) * s.step;
      missing[k] = count;
      at.push_back(k);
      if (!full && at.size() >= kStretch / 2 && k - at[at.size() - kStretch / 2] < kStretch && changes_rate < 0)
        changes_rate = static_cast<Index>(s.row[at[at.size() - kStretch / 2]]);
    }
    level[k] = residual[k] - shift;
  }
  for (std::size_t k = 1; k < n; ++k) missing[k] += missing[k - 1];
  const bool changed = missing != s.missing;
  s.missing = std::move(missing);
  return changed;
}

struct Line {
  double slope = 0.0, deviation = 0.0, scatter = 0.0;
};

/// Standard deviation of the slope: the larger of the value for white residuals and of that for means in ten blocks, which
/// shows slow residuals too.
double slope_deviation(const Search& s, const std::vector<double>& weight, const std::vector<double>& residual, double middle) {
  constexpr std::size_t blocks = 10;
  std::array<double, blocks> w{}, x{}, r{};
  double sum = 0.0, squares = 0.0, spread = 0.0;
  for (std::size_t k = s.begin(); k < s.size(); ++k) {
    const std::size_t b = k * blocks / s.size();
    const double off = s.place(k) - middle;
    sum += weight[k];
    squares += weight[k] * residual[k] * residual[k];
    spread += weight[k] * off * off;
    w[b] += weight[k];
    x[b] += weight[k] * off;
    r[b] += weight[k] * residual[k];
  }
  const double white = std::sqrt(squares / std::max(sum - 2.0, 1.0) / spread);
  if (s.size() < 4 * blocks) return white;
  double means = 0.0, apart = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    if (w[b] <= 0.0) continue;
    means += r[b] * r[b] / (w[b] * w[b]);
    apart += x[b] * x[b] / (w[b] * w[b]);
  }
  return std::max(white, std::sqrt(means / (blocks - 2.0) / apart));
}

/// A line of time over k + m by Tukey's biweight.
Line robust_line(const Search& s) {
  constexpr double cut = 4.685;  // deviations: 95 % efficient for normal residuals
  const std::size_t n = s.size(), begin = s.begin();
  Line line{s.step, 0.0, 0.0};
  std::vector<double> residual(n), weight(n, 0.0);
  double middle = 0.0;
  for (int turn = 0; turn < 20; ++turn) {
    for (std::size_t k = 0; k < n; ++k) residual[k] = s.time[k] - line.slope * s.place(k);
    std::vector<double> inner(residual.begin() + static_cast<long>(begin), residual.end());
    const double centre = quantile(inner, 0.5);
    line.scatter = robust_deviation(inner);
    const double scale = std::max(line.scatter, 1e-9 * line.slope);
    double sum = 0.0, x = 0.0, t = 0.0, xx = 0.0, xt = 0.0;
    for (std::size_t k = begin; k < n; ++k) {
      const double u = (residual[k] - centre) / (cut * scale);
      weight[k] = std::abs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
      sum += weight[k];
      x += weight[k] * s.place(k);
      t += weight[k] * residual[k];
    }
    middle = x / sum;
    const double mean = t / sum;
    for (std::size_t k = begin; k < n; ++k) {
      const double off = s.place(k) - middle;
      xx += weight[k] * off * off;
      xt += weight[k] * off * (residual[k] - mean);
      residual[k] -= mean;
    }
    const double change = xx > 0.0 ? xt / xx : 0.0;
    line.slope += change;
    if (std::abs(change) < 1e-13 * line.slope) break;
  }
  line.deviation = n - begin > 2 ? slope_deviation(s, weight, residual, middle) : 0.0;
  const double span = s.place(n - 1) - s.place(begin);
  if (s.shared) line.deviation = std::max(line.deviation, line.slope * s.packet / span * (n < 5 ? 1.0 : 1.0 / std::sqrt(12.0)));
  return line;
}

/// Whether a part of the record runs at another rate than the first part: its slope differs by two per cent, by two samples or
/// packets, and by more than its scatter.
bool has_other_rate(const Search& s) {
  constexpr std::size_t parts = 8, fewest = 8;   // stamps of a part
  constexpr double least = 0.02, packets = 4.0;  // of each slope, half the part long, one at either end
  double first = 0.0;
  for (std::size_t p = 0; p < parts && s.size() >= parts * fewest; ++p) {
    const std::size_t from = std::max(s.begin(), p * s.size() / parts), to = (p + 1) * s.size() / parts;
    std::vector<double> slopes, residual;
    const std::size_t half = (to - from) / 2;
    for (std::size_t k = from; k + half < to; ++k)
      slopes.push_back((s.time[k + half] - s.time[k]) / (s.place(k + half) - s.place(k)));
    const double slope = quantile(std::move(slopes), 0.5);
    for (std::size_t k = from; k < to; ++k) residual.push_back(s.time[k] - slope * s.place(k));
    const double rows = s.place(to - 1) - s.place(from), scatter = robust_deviation(std::move(residual));
    if (p == 0) first = slope;
    if (std::abs(slope - first) > least * s.step &&
        std::abs(slope - first) * rows > packets * s.packet * s.step + kNoise * scatter)
      return true;
  }
  return false;
}

/// The row from which another rate holds: there the two lines with the least squares meet.
Index other_rate_from(const Search& s) {
  struct Sums {
    double n = 0.0, x = 0.0, t = 0.0, xx = 0.0, xt = 0.0, tt = 0.0;
    [[nodiscard]] double left() const {
      const double sx = xx - x * x / n, st = xt - x * t / n;
      return tt - t * t / n - (sx > 0.0 ? st * st / sx : 0.0);
    }
  };
  const auto with = [&](Sums sums, std::size_t k, double sign) {
    const double x = s.row[k] - s.row.back() / 2.0, t = s.time[k] - s.time.back() / 2.0;
    return Sums{sums.n + sign,          sums.x + sign * x,      sums.t + sign * t,
                sums.xx + sign * x * x, sums.xt + sign * x * t, sums.tt + sign * t * t};
  };
  Sums before, after;
  for (std::size_t k = 0; k < s.size(); ++k) after = with(after, k, 1.0);
  double least = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (std::size_t k = 0; k + 2 < s.size(); ++k) {
    if (k >= 2 && before.left() + after.left() < least) {
      least = before.left() + after.left();
      at = k;
    }
    before = with(before, k, 1.0);
    after = with(after, k, -1.0);
  }
  return static_cast<Index>(s.row[at]);
}

}  // namespace

Index RecordClock::missing() const {
  Index sum = 0;
  for (const ClockGap& gap : gaps) sum += std::max<Index>(gap.samples, 0);
  return sum;
}

Index RecordClock::repeated() const {
  Index sum = 0;
  for (const ClockGap& gap : gaps) sum += std::max<Index>(-gap.samples, 0);
  return sum;
}

void StampedRows::take_as_digits(double given) {
  constexpr double longest = 1.5;  // [s] between stamps; 1 if they are whole
  const double rise = given - last_, before = last_ - stamps_[stamps_.size() - 2].time;
  for (const double unit : {1.0, 1e3}) {
    const double time = seconds_of_digits(given / unit) - seconds_of_digits(last_ / unit);
    const bool turns = rise > 40.0 * unit || rise < -235e3 * unit;  // of a minute, or at midnight
    if (!turns || std::fmod(last_ / unit, 100.0) >= 60.0 || before > longest * unit ||
        std::fmod(time + 86400.0, 86400.0) > longest)
      continue;
    digits_ = unit;
    for (Stamp& stamp : stamps_) stamp.time = unit * seconds_of_digits(stamp.time / unit);
    last_ = stamps_.back().time;
    return;
  }
}

void StampedRows::add(double given) {
  const Index row = row_++;
  if (!std::isfinite(given)) {
    ++without_;
    return;
  }
  if (digits_ == 0.0 && begun_ == 0.0 && stamps_.size() > 1) take_as_digits(given);
  double stamp = begun_ + (digits_ > 0.0 ? digits_ * seconds_of_digits(given / digits_) : given);
  if (!stamps_.empty()) {
    const double rise = (last_ - stamps_.front().time) / static_cast<double>(std::max<Index>(row - 1, 1));
    for (const double period : kPeriods) {
      if ((period_ > 0.0 && period != period_) || (period == 1.0 && likely_unit_s(rise) != 86400.0)) continue;
      const bool dated = period == 86400.0 && last_ > 1e8 && last_ < 1e11;  // [s] since 1970
      const double days = dated ? std::ceil((last_ - begun_) / period) - 1.0 : 0.0, begin = begun_ + days * period,
                   near = kSharesOfADay * period;
      const bool passed = last_ <= begin + period && last_ > begin + period - near && stamp >= begin && stamp < begin + near &&
                          stamps_.front().time >= 0.0;
      const bool date_follows =
          period_ > 0.0 && begun_ >= period && stamp - period >= last_ && stamp - period < last_ + near;  // some rows late
      if (!passed && !date_follows) continue;
      period_ = period;
      begun_ += passed ? period : -period;
      stamp += passed ? period : -period;
      break;
    }
    if (const double hour = hour_again(last_, stamp); hour > 0.0) {
      hour_again_ = row;
      begun_ += hour;
      stamp += hour;
    }
    counts_ = counts_ && std::abs(stamp - last_ - 1.0) <= std::min(1e-3, 2e-7 * std::abs(stamp));  // of single precision
    if (stamp < last_) ++falls_;
    if (stamp == last_) return;
  }
  last_ = stamp;
  stamps_.push_back({row, stamp});
}

bool StampedRows::mostly_rises() const {
  constexpr Index one_in = 50;  // rows per fall: a clock is seldom set, but noise falls every other time
  return row_ > without_ && without_ <= row_ / 2 && one_in * falls_ <= row_;
}

std::optional<double> StampedRows::samples_about_a_line(Index most_set, bool of_one_rate) const {
  constexpr Index fewest = 16;  // rows: no vibration rises so many times in a row
  constexpr Index one_in = 50;  // rows per row without a stamp
  if (counts_ || stamps_.size() < 3 || without_ * one_in > row_) return {};
  const RecordClock found = clock(1.0);
  if (found.rate_Hz <= 0.0) return {};
  const Index again = std::ranges::count_if(found.gaps, [](const ClockGap& gap) { return gap.samples < 0; });
  if (found.changes_rate < 0) return again > most_set ? std::nullopt : std::optional(found.scatter_s * found.rate_Hz);
  if (of_one_rate || std::min(found.changes_rate, row_ - found.changes_rate) < fewest) return {};
  std::array<StampedRows, 2> parts;
  for (std::size_t k = 0; k < stamps_.size(); ++k) {
    const Index end = k + 1 < stamps_.size() ? stamps_[k + 1].row : row_;
    for (Index row = stamps_[k].row; row < end; ++row) parts[row < found.changes_rate ? 0 : 1].add(stamps_[k].time);
  }
  const double most = std::max(parts[0].samples_about_a_line(most_set, true).value_or(kNone),
                               parts[1].samples_about_a_line(most_set, true).value_or(kNone));
  return most <= kEven ? std::optional(most) : std::nullopt;
}

bool StampedRows::runs_like_time(Straight straight) const {
  constexpr double roughly = 0.05;    // [-] scatter about the line over the rows
  constexpr std::size_t fewest = 16;  // stamps in a column that is named otherwise
  constexpr Index a_start = 500;      // least rows, on average, between two starts of a clock: angles start anew sooner
  const auto off = samples_about_a_line(straight == Straight::named         ? row_
                                        : straight == Straight::to_a_sample ? 1
                                                                            : std::max<Index>(1, row_ / a_start));
  if (!off || *off <= kEven || straight == Straight::to_a_sample) return off && *off <= kEven;
  const auto rows = static_cast<double>(row_), stamps = static_cast<double>(stamps_.size());
  if (straight == Straight::named) return *off <= roughly * rows;
  if (falls_ > 0 || straight == Straight::roughly) return falls_ == 0 && *off <= roughly * rows;
  std::vector<double> rises;
  for (std::size_t k = 1; k < stamps_.size(); ++k) rises.push_back(stamps_[k].time - stamps_[k - 1].time);
  const double rise = quantile(rises, 0.5), spread = quantile(rises, 0.75) - quantile(rises, 0.25);
  const bool whole = std::ranges::all_of(stamps_, [](const Stamp& s) { return s.time == std::floor(s.time); });
  return stamps_.size() >= fewest && *off <= rows / stamps && (whole || spread > 1e-3 * rise);
}

double StampedRows::likely_unit_s(double step, double first) {
  constexpr double slowest = 1.0, fastest = 1e5;       // [Hz] rates of vibration records
  constexpr double tick = 1e-7;                        // [s]
  for (const double year_1990 : {6.278e17, 1.228e17})  // [ticks] of 1990 since the years 1 and 1601; a century is 3.2e16 ticks
    if (first > year_1990 && first < year_1990 + 3.2e16) return tick;
  for (const double unit : {1.0, 1e-3, 1e-6, 1e-9, 86400.0}) {
    if (const double rate = 1.0 / (step * unit); rate >= slowest * (1.0 - 1e-3) && rate <= fastest) return unit;
  }
  return 1.0;
}

RecordClock StampedRows::clock(double unit_s) const {
  RecordClock found;
  found.hour_again = hour_again_;
  const std::size_t n = stamps_.size();
  found.stands_still = n == 1 && row_ > 1;
  if (n < 2) return found;
  found.shared_by = static_cast<double>(row_) / static_cast<double>(n);
  found.reversed = n > 2 && falls_ > (static_cast<Index>(n) - 1) * 9 / 10;
  if (found.reversed) return found;
  Search s;
  constexpr double few = 0.005;  // of the rows: as many repeated rows share stamps although the stamps are fine
  const double sharing = static_cast<double>(row_ - without_) - static_cast<double>(n);
  s.shared = sharing > 2.0 && sharing > few * static_cast<double>(row_);
  for (const Stamp& stamp : stamps_) {
    s.row.push_back(static_cast<double>(stamp.row));
    s.time.push_back(stamp.time - stamps_.front().time);
  }
  if (s.shared && n == 2) return found;  // it is unknown how long before the record the first stamp began
  if (s.shared) s.packet = rows_of_a_packet(s);
  s.step = first_step(s);
  if (s.step <= 0.0) {
    for (std::size_t k = 1; k < n && found.steps_back < 0; ++k)
      found.steps_back = s.time[k] < s.time[k - 1] ? stamps_[k].row : -1;
    return found;
  }
  Line line{s.step, 0.0, 0.0};
  for (int turn = 0; turn < 6; ++turn) {
    if (!find_gaps(s, found.gaps, found.changes_rate) && turn > 0) break;
    if (found.changes_rate >= 0) break;
    line = robust_line(s);
    s.step = line.slope;
  }
  std::vector<double> places;
  for (std::size_t k = 0; s.shared && found.changes_rate < 0 && k < n; ++k) places.push_back(s.place(k));
  if (const auto full = full_stretches(s.time, places, line.slope, line.deviation, s.packet)) {
    s.step = full->step;
    find_gaps(s, found.gaps, found.changes_rate, &*full);
    line = robust_line(s);
    line.deviation = std::max(line.deviation, full->deviation);
  }
  if (found.changes_rate >= 0 || has_other_rate(s)) found.changes_rate = other_rate_from(s);
  const double tolerance = std::max(s.step, kNoise * line.scatter);
  for (std::size_t k = 1; k < n && found.steps_back < 0; ++k) {
    const bool told =
        std::ranges::any_of(found.gaps, [&](const ClockGap& gap) { return gap.samples < 0 && gap.row == stamps_[k].row; });
    if (!told && s.time[k] < s.time[k - 1] - tolerance) found.steps_back = stamps_[k].row;
  }
  const double unit = unit_s > 0.0 ? unit_s : likely_unit_s(line.slope, stamps_.front().time);
  const double rate = 1.0 / (line.slope * unit);
  found.deviation_Hz = rate * line.deviation / line.slope;
  found.rate_Hz = round_rate(rate, found.deviation_Hz);
  found.scatter_s = line.scatter * unit;
  return found;
}

}  // namespace twindeck::records
