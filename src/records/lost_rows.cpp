#include "records/lost_rows.hpp"

#include <algorithm>
#include <cmath>

namespace twindeck::records {

std::optional<FullStretches> full_stretches(const std::vector<double>& time, const std::vector<double>& place, double step,
                                            double deviation, double packet) {
  constexpr double highest = 0.01;  // of the stretches: most windows that single repeats or wrong stamps may touch
  constexpr double certain = 3.0;   // deviations
  constexpr double clear = 1.5;     // constant parts: least fall of a stretch that is more than a constant part
  constexpr double same = 1e-6;     // [-] difference of equal steps between stamps
  constexpr double mostly = 0.8;    // of the steps are equal to the one before where stamps are coarse: gaps lie between
  constexpr double half = 0.5;      // most share of the rows that are lost
  constexpr double near = 0.75;     // of the largest share
  struct Stretch {
    std::size_t stamps;
    double fall, length;
  };
  std::vector<Stretch> stretches;
  const std::size_t n = place.size();
  std::size_t even = 0;
  for (std::size_t k = 1; k + 1 < n; ++k)
    even += std::abs((time[k + 1] - time[k]) / (time[k] - time[k - 1]) - 1.0) < same ? 1 : 0;
  if (static_cast<double>(even) < mostly * static_cast<double>(n)) return {};
  for (std::size_t lag = 1; 2 * lag < n; lag *= 2) {
    std::vector<double> falls;
    for (std::size_t k = 0; k + lag < n; ++k) falls.push_back(step * (place[k + lag] - place[k]) - (time[k + lag] - time[k]));
    const auto at = falls.begin() + static_cast<long>((1.0 - highest) * static_cast<double>(falls.size() - 1));
    std::nth_element(falls.begin(), at, falls.end());
    stretches.push_back({lag, *at, (time[n - 1] - time[0]) / static_cast<double>(n - 1) * static_cast<double>(lag)});
  }
  const double constant = std::max(stretches.empty() ? 0.0 : stretches.front().fall, packet * step);
  double least = 0.0;  // share
  for (const Stretch& stretch : stretches)
    if (stretch.fall >= clear * constant) least = std::max(least, (stretch.fall - constant) / stretch.length);
  if (stretches.empty() || least <= certain * deviation / step) return {};
  const auto full = std::ranges::find_if(  // the shortest such stretch is the least likely to contain a loss
      stretches, [&](const Stretch& stretch) { return stretch.fall - constant >= near * least * stretch.length; });
  const double most = std::max(full->fall / full->length, least);
  if (most > half) return {};
  return FullStretches{step * (1.0 - (least + most) / 2.0), step * (most - least) / 2.0, constant, full->stamps};
}

}  // namespace twindeck::records
