#include "buffeting/interval.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace twindeck::buffeting {
namespace {

/// Probability that |T| <= t.
double two_sided(double t, int degrees) {
  const double angle = std::atan(t / std::sqrt(static_cast<double>(degrees))), cosine = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double sum = 0.0, term = odd ? cosine : 1.0;
  for (int i = odd ? 1 : 0; i <= degrees - 2; i += 2) {
    sum += term;
    term *= cosine * cosine * static_cast<double>(i + 1) / static_cast<double>(i + 2);
  }
  return odd ? 2.0 / std::numbers::pi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
}

}  // namespace

double student_quantile(int degrees, double share) {
  TWINDECK_ASSERT(degrees >= 1 && share > 0.5 && share < 1.0);
  double low = 0.0, high = 1.0;
  while (two_sided(high, degrees) < 2.0 * share - 1.0) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (two_sided(middle, degrees) < 2.0 * share - 1.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Interval confidence_interval(const Eigen::Ref<const Eigen::VectorXd>& replicates, double level) {
  const Eigen::Index n = replicates.size();
  if (n < 2) {
    throw InputError({"", 0, "replicates"}, fmt::format("are {}, expected at least two for an interval", n),
                     "ask for more seeds");
  }
  Interval out;
  out.mean = replicates.mean();
  out.deviation = std::sqrt((replicates.array() - out.mean).square().sum() / static_cast<double>(n - 1));
  const double half =
      student_quantile(static_cast<int>(n) - 1, 0.5 * (1.0 + level)) * out.deviation / std::sqrt(static_cast<double>(n));
  out.low = out.mean - half;
  out.high = out.mean + half;
  return out;
}

}  // namespace twindeck::buffeting
