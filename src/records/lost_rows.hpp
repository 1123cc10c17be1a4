#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace twindeck::records {

/// Step of a record between the losses of few rows, which are too short to be seen one by one under shared stamps.
struct FullStretches {
  double step = 0.0;       ///< between samples, in the unit of the stamps
  double deviation = 0.0;  ///< of the step
  double constant = 0.0;   ///< largest change of a residual without a loss, in the unit of the stamps
  std::size_t stamps = 0;  ///< of a full stretch
};

/// Rows can be lost, but none can appear. So a line through all stamps is too slow if rows were lost here and there, and the
/// residuals fall along every stretch without a loss. G(L) is the largest such fall over L stamps (that of the highest
/// hundredth of the stretches). It is a share of the length plus the constant part that lateness and the unknown position of a
/// row in a shared stamp leave, at most G(1). The share is at least the largest (G(L) - constant) / length
/// and at most G(L) / length of the shortest stretch that says nearly as much.
/// @param time, place  of each stamp, and samples before it; none: no answer @param step  of the line @param deviation  of that
/// step
/// @param packet  [samples] rows that share a stamp by chance
/// @return none where the stamps are not even, as whole seconds are (packets with stamps of their own show each loss as a gap);
///         where that share is less than three deviations of the line, or more than half
[[nodiscard]] std::optional<FullStretches> full_stretches(const std::vector<double>& time, const std::vector<double>& place,
                                                          double step, double deviation, double packet);

}  // namespace twindeck::records
