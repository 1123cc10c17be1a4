#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/structure.hpp"
#include "steps/measured/measured_input.hpp"
#include "steps/shared/model_source.hpp"

namespace twindeck::steps {

/// A model made ready for diagnosis. Supports that are fixed become springs four orders stiffer than what they hold, so that a
/// soft bearing or a rocking foundation is a factor on them; frequencies move by less than 0.01 %.
struct DiagnosedModel {
  LoadedModel loaded;
  std::vector<std::string> rigid_supports;
  std::vector<Channel> channels;
  double sensor_tolerance_m = 0.5;
  [[nodiscard]] diagnosis::Structure structure() const;  ///< borrows from this
};

/// The channels that show the motion of a point, as measured degrees of freedom in their order; gauges are left out.
[[nodiscard]] Measured channels_at_points(const std::vector<Channel>& channels);

[[nodiscard]] std::shared_ptr<DiagnosedModel> prepare_model(const LoadedModel& loaded, const std::vector<Channel>& channels,
                                                            double sensor_tolerance_m);

}  // namespace twindeck::steps
