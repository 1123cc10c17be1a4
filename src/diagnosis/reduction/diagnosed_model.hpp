#pragma once

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/reduction/structure.hpp"
#include "dynamics/loaded_model.hpp"
#include "matching/measured.hpp"

namespace twindeck::diagnosis {

/// A model made ready for diagnosis. Supports that are fixed become springs four orders stiffer than what they hold, so that a
/// soft bearing or a rocking foundation is a factor on them; frequencies move by less than 0.01 %.
struct DiagnosedModel {
  dynamics::LoadedModel loaded;
  std::vector<std::string> rigid_supports;
  std::vector<matching::Channel> channels;
  double sensor_tolerance_m = 0.5;
  [[nodiscard]] Structure structure() const;  ///< borrows from this
};

/// The channels that show the motion of a point, as measured degrees of freedom in their order; gauges are left out.
[[nodiscard]] matching::Measured channels_at_points(const std::vector<matching::Channel>& channels);

/// @param loaded  a model of finite elements, whose supports are released into springs, or of matrices, which is taken as it is
/// @param sensor_tolerance_m  farthest that a channel may lie from the node that stands for it [m]
[[nodiscard]] std::shared_ptr<DiagnosedModel> prepare_model(const dynamics::LoadedModel& loaded,
                                                            const std::vector<matching::Channel>& channels,
                                                            double sensor_tolerance_m);

}  // namespace twindeck::diagnosis
