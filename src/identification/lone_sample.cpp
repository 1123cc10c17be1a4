#include "identification/lone_sample.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr double kLeastDeviations = 10.0;  // what lies nearer belongs to the record's own distribution
constexpr Index kLongest = 3;              // samples in a row
constexpr Index kAround = 10;              // samples on each side that are looked at
constexpr double kQuiet = 1.0 / 20.0;      // of the distance: a filtered pulse leaves more; jerks of a shaking table a tenth
constexpr double kSame = 0.5;              // of the distance: a sample that belongs to the same group
constexpr Index kDrawn = 65536;            // samples that a median is taken of
constexpr double kNormal = 1.4826;         // deviation of a normal distribution over its median absolute deviation

/// @param values  not empty; their order is lost
double median(std::vector<double>& values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The samples that are there; of a long record, as many as give the median within a hundredth of a deviation. They are drawn
/// from a fixed seed: evenly spaced ones could keep step with a sine.
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
    middle_ = median(values);
    for (double& value : values) value = std::abs(value - middle_);
    deviation_ = kNormal * median(values);
    if (deviation_ > 0.0) return;
    for (Index t = 0; t < size(); ++t) {  // most samples are one count: the next count is the unit
      const double d = at(t);
      if (d > 0.0 && (deviation_ == 0.0 || d < deviation_)) deviation_ = d;
    }
  }
  [[nodiscard]] Index size() const { return x_.size(); }
  [[nodiscard]] double at(Index t) const { return std::abs(x_[t] - middle_); }  // NaN or infinite where missing
  [[nodiscard]] double deviation() const { return deviation_; }

 private:
  Eigen::Ref<const Eigen::VectorXd> x_;
  double middle_ = 0.0, deviation_ = 0.0;
};

/// Whether the samples on one side are quiet beside a distance. @param first  next to the group @param step  1 or -1
bool is_quiet(const Distance& distance, Index first, Index step, double large) {
  std::vector<double> side;
  for (Index k = 0, t = first; k < kAround && t >= 0 && t < distance.size(); ++k, t += step) {
    if (std::isfinite(distance.at(t))) side.push_back(distance.at(t));
  }
  return side.empty() || (side.front() < kQuiet * large && median(side) < kQuiet * large);
}

bool stands_alone(const Distance& distance, Index t) {
  const double large = distance.at(t);
  Index begin = t, end = t + 1;
  while (begin > 0 && end - begin <= kLongest && distance.at(begin - 1) >= kSame * large) --begin;
  while (end < distance.size() && end - begin <= kLongest && distance.at(end) >= kSame * large) ++end;
  return end - begin <= kLongest && is_quiet(distance, begin - 1, -1, large) && is_quiet(distance, end, 1, large);
}

}  // namespace

std::optional<LoneSample> lone_sample(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() < 2 * kAround + kLongest) return {};
  const Distance distance(x);
  std::optional<LoneSample> found;
  double least = kLeastDeviations * distance.deviation();
  for (Index t = 0; t < x.size(); ++t) {
    const double d = distance.at(t);
    if (!(d > least) || !std::isfinite(d) || !stands_alone(distance, t)) continue;
    found = LoneSample{t, x[t], d / distance.deviation()};
    least = d;
  }
  return found;
}

}  // namespace twindeck::identification
