#pragma once

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/reduction/structure.hpp"
#include "dynamics/loaded_model.hpp"
#include "matching/measured.hpp"

namespace twindeck::diagnosis {

/// A model made ready for diagnosis. Fixed supports become springs, four orders stiffer than the structure at their node. A
/// soft bearing or a rocking foundation is then a factor on them. Frequencies change by less than 0.01 %.
struct DiagnosedModel {
  dynamics::LoadedModel loaded;
  std::vector<std::string> rigid_supports;
  std::vector<matching::Channel> channels;
  double sensor_tolerance_m = 0.5;
  [[nodiscard]] Structure structure() const;  ///< borrows from this
};

/// Channels that measure the motion of a point, as measured degrees of freedom in their order; gauges are left out.
[[nodiscard]] matching::Measured channels_at_points(const std::vector<matching::Channel>& channels);

/// @param loaded  a finite element model, whose supports become springs, or a matrix model, which is kept
/// @param sensor_tolerance_m  largest distance of a channel from its node [m]
[[nodiscard]] std::shared_ptr<DiagnosedModel> prepare_model(const dynamics::LoadedModel& loaded,
                                                            const std::vector<matching::Channel>& channels,
                                                            double sensor_tolerance_m);

}  // namespace twindeck::diagnosis
