#pragma once

#include <vector>

namespace twindeck::reliability {

/// A quantity at some mean speeds, in ascending order of speed.
struct OverSpeed {
  std::vector<double> speed_m_s, value;

  /// A probability between its points: linear, from 0 in calm air on; above the last point it is `beyond`.
  [[nodiscard]] double probability(double speed_m_s, double beyond) const;
  /// A damage between its points: a power of the speed from each point to the next, continued beyond both ends.
  /// @pre two points or more
  [[nodiscard]] double damage(double speed_m_s) const;
};

}  // namespace twindeck::reliability
