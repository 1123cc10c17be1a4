#pragma once

#include <string>
#include <vector>

#include "diagnosis/inference.hpp"

namespace twindeck::diagnosis {

/// How strongly the rows ask for a change at a location, in standard deviations of what chance would ask.
struct LocationScore {
  std::string location;
  double score;
};

/// Where the rows ask for a change: scores of every parameter, of element scatter and of the screened entries' locations, the
/// strongest first.
[[nodiscard]] std::vector<LocationScore> location_map(const Inference& inference, const Fit& fit,
                                                      const std::vector<Scored>& ranking);

}  // namespace twindeck::diagnosis
