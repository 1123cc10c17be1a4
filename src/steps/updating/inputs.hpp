#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/loaded_model.hpp"
#include "io/config.hpp"
#include "matching/measured.hpp"
#include "runner/run_step.hpp"
#include "updating/updating_settings.hpp"

namespace twindeck::steps {

/// Configuration of s6_updating.
struct UpdatingConfig : updating::UpdatingSettings {
  [[nodiscard]] io::FieldTable fields();
  /// The configuration with as many modes as pairing by shape needs.
  [[nodiscard]] UpdatingConfig for_band_of(const matching::Measured& measured, const dynamics::LoadedModel& model) const;
};

/// What the step reads.
struct UpdatingInputs {
  dynamics::ReadModel model;  ///< the refined one
  matching::Measured measured;
  std::vector<int>
      active;  ///< positions of the parameters to update: as listed, as s5_sensitivity selected them, or all with a range
  std::vector<int> selected;               ///< with beside_selection: positions of those that s5_sensitivity selected
  std::vector<Eigen::VectorXd> published;  ///< values of the updated parameters in another updating's result, if one is given
};
/// @throws InputError  where no modes were measured; for a name that is no parameter, is listed twice or has no range
[[nodiscard]] UpdatingInputs read_updating(const UpdatingConfig& config, runner::StepContext& context);

}  // namespace twindeck::steps
