#pragma once

#include <string>
#include <vector>

#include "identification/condition.hpp"

namespace twindeck::identification {

/// Merges neighbouring modes that the records do not tell apart: frequencies within three standard deviations of their
/// difference, and shapes alike (MAC of 0.9 or more over the channels that both know). Frequency and damping become the means
/// weighted by 1/variance. Their variances become those of the surer mode and the squared distance to the other, so that the
/// interval holds both. The shape is the surer mode's; the other's, scaled to it over the channels that both know, fills
/// channels that it lacks. Campaigns of one channel have no shapes: nothing is merged.
/// @param result  modes ascending in frequency; `checks` follow
/// @return one line for each merger, which names both modes
[[nodiscard]] std::vector<std::string> merge_modes_that_are_one(ConditionResult& result);

}  // namespace twindeck::identification
