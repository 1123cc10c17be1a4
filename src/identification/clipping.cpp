#include "identification/clipping.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace twindeck::identification {

using Eigen::Index;

namespace {

constexpr long kRun = 3;             // samples in a row that no motion leaves at one extreme value
constexpr long kFewestAtRail = 10;   // fewer equal extremes are left to chance: 0.03 % of a short record of 30,000 samples
constexpr std::size_t kNearby = 10;  // values next to the extreme one that it is held against
constexpr double kPile = 5.0;        // times their samples: twice what the crest of a sine has
constexpr double kRounding = 1e-9;   // [-] of the range: values closer than this are one value

/// Whether a value at one end holds far more samples than those next to it. @param sign  1: the largest, -1: the smallest
bool is_rail(const Eigen::Ref<const Eigen::VectorXd>& x, double extreme, double sign, double range) {
  std::vector<double> below;
  for (Index t = 0; t < x.size(); ++t) {
    if (std::isfinite(x[t])) below.push_back(sign * (extreme - x[t]));
  }
  std::sort(below.begin(), below.end());
  std::vector<long> samples;  // of the extreme value and of those next to it
  auto from = below.begin();
  while (from != below.end() && samples.size() <= kNearby) {
    const auto to = std::upper_bound(from, below.end(), *from + kRounding * range);
    samples.push_back(static_cast<long>(to - from));
    from = to;
  }
  if (from == below.end()) return false;  // the other end is among them, or few values are there
  return static_cast<double>(samples.front()) >
         kPile * static_cast<double>(*std::max_element(samples.begin() + 1, samples.end()));
}

}  // namespace

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
