#include "sysid/tension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/error.hpp"

namespace twindeck::sysid {

using std::numbers::pi;

double lambda_squared_of(double ratio) {
  TWINDECK_ASSERT(ratio < 3.0);
  if (ratio <= 1.0) return 0.0;
  const double half = 0.5 * pi * ratio;  // in (pi/2, 3 pi/2)
  return std::max(0.0, 4.0 * half * half * half / (half - std::tan(half)));
}

double first_frequency_ratio(double lambda_squared) {
  TWINDECK_ASSERT(lambda_squared >= 0.0);
  // lambda² grows with the ratio without bound as half -> the root of tan(h) = h near 1.43 pi: bisection.
  double low = 1.0, high = 2.0 * 4.493409457909064 / pi;
  for (int i = 0; i < 200 && high - low > 1e-15; ++i) {
    const double middle = 0.5 * (low + high);
    (lambda_squared_of(middle) < lambda_squared ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double frequency_ratio(int number, double lambda_squared) {
  TWINDECK_ASSERT(number >= 1 && lambda_squared >= 0.0);
  if (number % 2 == 0 || lambda_squared == 0.0) return 1.0;
  if (number == 1) return first_frequency_ratio(lambda_squared);
  // lambda²(h) = 4 h³/(h - tan h), h = pi/2 times f_n/c, grows from 0 at h = n pi/2 on: bisection to the asymptote tan h = h.
  const double start = 0.5 * pi * number;
  double low = start, high = start + 0.5 * pi;
  for (int i = 0; i < 200 && high - low > 1e-15 * start; ++i) {
    const double middle = 0.5 * (low + high), tangent = std::tan(middle);
    const bool below = middle > tangent && 4.0 * std::pow(middle, 3) / (middle - tangent) < lambda_squared;
    (below ? low : high) = middle;
  }
  return 0.5 * (low + high) / start;
}

namespace {

constexpr double kGravity_m_s2 = 9.81;

void check(const std::vector<Harmonic>& harmonics) {
  std::set<int> numbers;
  for (const Harmonic& h : harmonics) {
    if (h.number < 1 || !(h.frequency_Hz > 0.0) || !(h.deviation_Hz > 0.0)) {
      throw InputError({"", 0, "stay"},
                       fmt::format("harmonic {} has {} Hz with a standard deviation of {}, expected positive numbers", h.number,
                                   h.frequency_Hz, h.deviation_Hz),
                       "give each harmonic a number from 1, a frequency and its standard deviation");
    }
    if (!numbers.insert(h.number).second)
      throw InputError({"", 0, "stay"}, fmt::format("has harmonic {} twice", h.number), "keep one of them");
  }
  if (harmonics.size() < 2 || *numbers.rbegin() < 2) {
    throw InputError({"", 0, "stay"},
                     fmt::format("has {} harmonics, expected at least two, one of them above the first", harmonics.size()),
                     "identify higher modes of the stay");
  }
}

struct FittedString {
  double c = 0.0, deviation = 0.0, residual = 0.0;
};

/// f_n = c n over n >= 2.
FittedString taut_string(const std::vector<Harmonic>& harmonics) {
  double product = 0.0, square = 0.0, sum = 0.0;
  int count = 0;
  for (const Harmonic& h : harmonics) {
    if (h.number < 2) continue;
    const double w = 1.0 / (h.deviation_Hz * h.deviation_Hz);
    product += w * h.number * h.frequency_Hz;
    square += w * h.number * h.number;
    ++count;
  }
  FittedString line{product / square, std::sqrt(1.0 / square), 0.0};
  for (const Harmonic& h : harmonics) {
    if (h.number >= 2) sum += std::pow((h.frequency_Hz - line.c * h.number) / h.deviation_Hz, 2);
  }
  line.residual = std::sqrt(sum / count);
  // Residuals beyond the deviations say that the string is not all there is: c is then no better than they allow.
  if (count > 1) line.deviation *= std::max(1.0, std::sqrt(sum / (count - 1)));
  return line;
}

/// f_n² / n² = c² + c² b n² over n >= 2: c, b and their deviations.
struct Stiff {
  double c = 0.0, c_deviation = 0.0, b = 0.0, b_deviation = 0.0;
};
Stiff stiff_string(const std::vector<Harmonic>& harmonics) {
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, y0 = 0.0, y1 = 0.0;
  for (const Harmonic& h : harmonics) {
    if (h.number < 2) continue;
    const double n2 = static_cast<double>(h.number) * h.number, y = h.frequency_Hz * h.frequency_Hz / n2;
    const double sigma = 2.0 * h.frequency_Hz * h.deviation_Hz / n2, w = 1.0 / (sigma * sigma);
    s0 += w;
    s1 += w * n2;
    s2 += w * n2 * n2;
    y0 += w * y;
    y1 += w * n2 * y;
  }
  const double d = s0 * s2 - s1 * s1, a = (s2 * y0 - s1 * y1) / d, e = (s0 * y1 - s1 * y0) / d;
  Stiff fit;
  fit.c = std::sqrt(std::max(a, 1e-300));
  fit.c_deviation = std::sqrt(s2 / d) / (2.0 * fit.c);
  fit.b = e / a;
  fit.b_deviation = std::sqrt(s0 / d) / a;
  return fit;
}

Bounded symmetric(double value, double half) { return {value, value - half, value + half}; }

}  // namespace

namespace {

StayFit fit_straightened(const std::vector<Harmonic>& harmonics, double length_m, double quantile, const StayModel& model) {
  StayFit fit;
  fit.harmonics = static_cast<int>(harmonics.size());
  const FittedString line = taut_string(harmonics);
  fit.residual = line.residual;
  double c = line.c, c_deviation = line.deviation;
  const auto above = std::count_if(harmonics.begin(), harmonics.end(), [](const Harmonic& h) { return h.number >= 2; });
  if (model.bending && above >= 5) {
    const Stiff stiff = stiff_string(harmonics);
    fit.bending = stiff.b;
    fit.bending_deviation = stiff.b_deviation;
    fit.bending_seen = stiff.b > 3.0 * stiff.b_deviation;
    if (fit.bending_seen) {
      c = stiff.c;
      c_deviation = stiff.c_deviation;
    }
  }
  const double weight = kGravity_m_s2 / (4.0 * length_m * c * c);  // g L/(T/m)
  if (model.known_length) c_deviation = std::hypot(c_deviation, c * weight * weight / 24.0);
  fit.c_Hz = symmetric(c, quantile * c_deviation);
  const auto tension = [&](double string_Hz) { return std::pow(2.0 * length_m * string_Hz, 2); };
  fit.tension_per_mass = {tension(c), tension(std::max(0.0, fit.c_Hz.low)), tension(fit.c_Hz.high)};
  for (const Harmonic& h : harmonics) {
    if (h.number != 1) continue;
    // Bending raises the first harmonic too; what is left above it is sag.
    const double first = fit.bending_seen ? h.frequency_Hz / std::sqrt(1.0 + fit.bending) : h.frequency_Hz;
    const double ratio = first / c, deviation = ratio * std::hypot(h.deviation_Hz / h.frequency_Hz, c_deviation / c);
    const double most = 2.0 * 4.493409457909064 / pi * (1.0 - 1e-9);
    const auto mapped = [&](double r) { return lambda_squared_of(std::clamp(r, 0.0, most)); };
    fit.lambda_squared = {mapped(ratio), mapped(ratio - quantile * deviation), mapped(ratio + quantile * deviation)};
  }
  return fit;
}

}  // namespace

StayFit fit_stay(const std::vector<Harmonic>& harmonics, double length_m, double quantile, StayModel model) {
  check(harmonics);
  if (!(length_m > 0.0))
    throw InputError({"", 0, "length_m"}, fmt::format("is {}, expected a length above 0", length_m), "give the stay's length");
  StayFit fit = fit_straightened(harmonics, length_m, quantile, model);
  if (!model.sag_of_higher) return fit;
  // Each turn changes c by less than a hundredth of what the last one did: a third harmonic hardly feels lambda².
  for (int turn = 0; turn < 10; ++turn) {
    std::vector<Harmonic> straightened = harmonics;
    for (Harmonic& h : straightened) {
      if (h.number >= 2) h.frequency_Hz /= frequency_ratio(h.number, fit.lambda_squared.value);
    }
    fit = fit_straightened(straightened, length_m, quantile, model);
  }
  return fit;
}

std::vector<std::pair<std::size_t, int>> number_harmonics(const std::vector<double>& frequencies_Hz, double lowest_Hz,
                                                          double highest_Hz, double tolerance) {
  const auto numbered = [&](double c) {
    std::map<int, std::size_t> best;
    for (std::size_t i = 0; i < frequencies_Hz.size(); ++i) {
      const double ratio = frequencies_Hz[i] / c;
      const int n = std::max(1, static_cast<int>(std::lround(ratio)));
      const double off = ratio - n;
      const bool fits = n == 1 ? off > -0.01 && off < 0.5 : std::abs(off) < tolerance;
      if (!fits) continue;
      const auto [at, is_new] = best.try_emplace(n, i);
      if (!is_new && std::abs(off) < std::abs(frequencies_Hz[at->second] / c - n)) at->second = i;
    }
    return best;
  };
  // Each frequency, divided by a small number, may be the spacing: few candidates, each refined by its own harmonics.
  std::map<int, std::size_t> chosen;
  double best_score = 0.0;
  for (const double f : frequencies_Hz) {
    for (int n = 1; n <= 8; ++n) {
      double c = f / n;
      if (c < lowest_Hz || c > highest_Hz) continue;
      auto found = numbered(c);
      double product = 0.0, square = 0.0;
      for (const auto& [number, at] : found) {
        if (number < 2) continue;
        product += number * frequencies_Hz[at];
        square += static_cast<double>(number) * number;
      }
      if (square > 0.0) found = numbered(c = product / square);
      // Of two spacings that explain as many, the larger: half of it explains them too.
      const double score = static_cast<double>(found.size()) + (found.contains(1) ? 0.5 : 0.0) + 1e-3 * c / highest_Hz;
      if (found.size() >= 2 && score > best_score) {
        best_score = score;
        chosen = found;
      }
    }
  }
  std::vector<std::pair<std::size_t, int>> result;
  for (const auto& [number, at] : chosen) result.emplace_back(at, number);
  return result;
}

}  // namespace twindeck::sysid
