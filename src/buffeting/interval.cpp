#include "buffeting/interval.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/distributions.hpp"
#include "core/error.hpp"

namespace twindeck::buffeting {
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
      student_quantile(static_cast<double>(n - 1), 0.5 * (1.0 + level)) * out.deviation / std::sqrt(static_cast<double>(n));
  out.low = out.mean - half;
  out.high = out.mean + half;
  return out;
}

}  // namespace twindeck::buffeting
