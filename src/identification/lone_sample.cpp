#include "identification/lone_sample.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr double kLeastDeviations = 10.0;  // what lies nearer belongs to the record's own distribution
constexpr Index kLongest = 3;              // samples in a row
constexpr Index kAround = 10;              // samples on each side that are looked at
constexpr double kQuiet = 1.0 / 20.0;      // of the distance: a filtered pulse leaves more; jerks of a shaking table a tenth
constexpr double kSame = 0.5;              // of the distance: a sample that belongs to the same group
constexpr double kNormal = 1.4826;         // deviation of a normal distribution over its median absolute deviation

/// @param values  not empty; their order is lost
double median(std::vector<double>& values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Distances from the median, NaN where missing, and their robust deviation.
struct Distances {
  Eigen::VectorXd from_median;
  double deviation = 0.0;
};

Distances distances(const Eigen::Ref<const Eigen::VectorXd>& x) {
  std::vector<double> there;
  for (Index t = 0; t < x.size(); ++t) {
    if (std::isfinite(x[t])) there.push_back(x[t]);
  }
  if (there.empty()) return {};
  const double middle = median(there);
  for (double& value : there) value = std::abs(value - middle);
  double deviation = kNormal * median(there);
  if (deviation == 0.0) {  // most samples are one count: the next count is the unit
    for (const double d : there) deviation = d > 0.0 && (deviation == 0.0 || d < deviation) ? d : deviation;
  }
  return {(x.array() - middle).abs(), deviation};
}

/// Whether the samples on one side are quiet beside a distance. @param first  next to the group @param step  1 or -1
bool is_quiet(const Eigen::VectorXd& distance, Index first, Index step, double large) {
  std::vector<double> side;
  for (Index k = 0, t = first; k < kAround && t >= 0 && t < distance.size(); ++k, t += step) {
    if (std::isfinite(distance[t])) side.push_back(distance[t]);
  }
  return side.empty() || (side.front() < kQuiet * large && median(side) < kQuiet * large);
}

bool stands_alone(const Eigen::VectorXd& distance, Index t) {
  const double large = distance[t];
  Index begin = t, end = t + 1;
  while (begin > 0 && end - begin <= kLongest && distance[begin - 1] >= kSame * large) --begin;
  while (end < distance.size() && end - begin <= kLongest && distance[end] >= kSame * large) ++end;
  return end - begin <= kLongest && is_quiet(distance, begin - 1, -1, large) && is_quiet(distance, end, 1, large);
}

}  // namespace

std::optional<LoneSample> lone_sample(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() < 2 * kAround + kLongest) return {};
  const Distances all = distances(x);
  std::optional<LoneSample> found;
  for (Index t = 0; t < all.from_median.size(); ++t) {
    const double deviations = all.from_median[t] / all.deviation;
    if (!std::isfinite(x[t]) || !(deviations > std::max(kLeastDeviations, found ? found->deviations : 0.0))) continue;
    if (stands_alone(all.from_median, t)) found = LoneSample{t, x[t], deviations};
  }
  return found;
}

}  // namespace twindeck::identification
